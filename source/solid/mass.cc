#include <touchstone/scene/input_error.h>
#include <touchstone/solid/mass.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/numerics/vector_tools_interpolate.h>

#include <Epetra_Vector.h>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Mass, first and second moments of mass: the kinetic energy of all rigid
     * motions, as the form sum_ab M_ab (1, x_a) (1, x_b) in its upper triangle. */
    constexpr unsigned int n_moments = 10;
    using Moments                    = std::array<double, n_moments>;

    void
    add_moments(const double mass, const Point<dim> &x, const Point<dim> &y, Moments &sum)
    {
      const double left[] = {1., x[0], x[1], x[2]}, right[] = {1., y[0], y[1], y[2]};
      unsigned int k = 0;
      for (unsigned int i = 0; i < 4; ++i)
        for (unsigned int j = i; j < 4; ++j)
          sum[k++] += 0.5 * mass * (left[i] * right[j] + left[j] * right[i]);
    }

    Moments
    monomials(const Point<dim> &x)
    {
      Moments result = {};
      add_moments(1., x, x, result);
      return result;
    }

    /** Distance between the centres of the faces across a direction. */
    double
    extent(const Triangulation<dim>::active_cell_iterator &cell, const unsigned int d)
    {
      return cell->face(2 * d)->center().distance(cell->face(2 * d + 1)->center());
    }

    /**
     * The rule of two points in each direction, at (1 +- xi)/2 with xi^2 = 2/3 (1 - C^2),
     * where C is the Courant number of the direction, at most 1.
     */
    Quadrature<dim>
    dispersion_corrected_rule(const MaterialParameters                       &material,
                              const Triangulation<dim>::active_cell_iterator &cell,
                              const double                                    step)
    {
      const double modulus = material.bulk_modulus() + 4. / 3. * material.shear_modulus();
      const double wave    = std::sqrt(modulus / material.density);
      Point<dim>   xi;
      for (unsigned int d = 0; d < dim; ++d)
        xi[d] = std::sqrt(2. / 3. * std::max(0., 1. - std::pow(wave * step / extent(cell, d), 2)));
      std::vector<Point<dim>> points;
      for (unsigned int corner = 0; corner < GeometryInfo<dim>::vertices_per_cell; ++corner)
        {
          const Point<dim> vertex = GeometryInfo<dim>::unit_cell_vertex(corner);
          Point<dim>       x;
          for (unsigned int d = 0; d < dim; ++d)
            x[d] = 0.5 * (1. + (2. * vertex[d] - 1.) * xi[d]);
          points.push_back(x);
        }
      return Quadrature<dim>(points, std::vector<double>(points.size(), 1. / points.size()));
    }

    /** Coordinates in which a body lies between about -1 and 1. */
    struct Frame
    {
      Point<dim> centre;
      double     size = 1.;

      Point<dim>
      operator()(const Vector &positions, const Index node) const
      {
        Point<dim> x;
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = (positions(node + d) - centre[d]) / size;
        return x;
      }
    };

    std::vector<Frame>
    frames(const Scene &scene, const Solid &solid)
    {
      std::vector<Frame> result(scene.bodies.size());
      for (unsigned int b = 0; b < result.size(); ++b)
        {
          Point<dim> low, high;
          for (unsigned int d = 0; d < dim; ++d)
            {
              low[d]  = std::numeric_limits<double>::max();
              high[d] = -low[d];
            }
          for (const auto &cell : solid.dof_handler.active_cell_iterators())
            if (cell->is_locally_owned() && cell->material_id() == b)
              for (const unsigned int v : cell->vertex_indices())
                for (unsigned int d = 0; d < dim; ++d)
                  {
                    low[d]  = std::min(low[d], cell->vertex(v)[d]);
                    high[d] = std::max(high[d], cell->vertex(v)[d]);
                  }
          for (unsigned int d = 0; d < dim; ++d)
            {
              low[d]              = Utilities::MPI::min(low[d], solid.communicator);
              high[d]             = Utilities::MPI::max(high[d], solid.communicator);
              result[b].centre[d] = 0.5 * (low[d] + high[d]);
            }
          result[b].size = 0.5 * (high - low).norm();
        }
      return result;
    }

    /** Add the products of @p factors and @p entries to the diagonal. */
    void
    add_to_diagonal(Matrix &matrix, const Vector &factors, const Vector &entries)
    {
      auto         &target = const_cast<Epetra_CrsMatrix &>(matrix.trilinos_matrix());
      Epetra_Vector sum(target.RowMap());
      target.ExtractDiagonalCopy(sum);
      for (int i = 0; i < sum.MyLength(); ++i)
        sum[i] += factors.begin()[i] * entries.begin()[i];
      target.ReplaceDiagonalValues(sum);
    }

    /** Coefficients c of the nodal masses w_a sum_k c_k p_k(x_a) that have the moments
     * @p missing, where @p gram = sum_a w_a p_k p_l. */
    dealii::Vector<double>
    solve_moments(const FullMatrix<double> &gram,
                  const Moments            &missing,
                  const BodyParameters     &body)
    {
      // Two layers of nodes bear mass and centre, but not all moments of inertia.
      for (const unsigned int n : {n_moments, 4U})
        {
          FullMatrix<double> part(n, n);
          part.fill(gram);
          LAPACKFullMatrix<double> inverse(n);
          inverse = part;
          dealii::Vector<double> wanted(missing.begin(), missing.begin() + n), result(n), got(n);
          inverse.compute_inverse_svd(1e-12);
          inverse.vmult(result, wanted);
          part.vmult(got, result);
          got -= wanted;
          if (got.l2_norm() <= 1e-8 * std::abs(gram(0, 0)))
            {
              result.grow_or_shrink(n_moments);
              return result;
            }
        }
      throw InputError(body.section(),
                       "Geometry",
                       "",
                       "too few nodes are left that could take the mass of the slave nodes: all of "
                       "them lie in a plane",
                       "take more cells through the thickness, make this body the master, or set "
                       "'Time integration/Scheme' to 'generalized_alpha'");
    }
  } // namespace



  Mass::Mass(const Scene           &scene,
             const Solid           &solid,
             const std::set<Index> &massless,
             const double           step)
    : nodal(solid.owned, solid.communicator)
    , diagonal(scene.time_integration.mass == "lumped")
  {
    const bool         corrected = (scene.time_integration.mass == "dispersion corrected");
    const FE_Q<dim>    scalar_fe(solid.fe.degree);
    FEValues<dim>      values(solid.mapping,
                         scalar_fe,
                         QGauss<dim>(solid.fe.degree + 1),
                         update_values | update_JxW_values);
    const unsigned int n = scalar_fe.n_dofs_per_cell();

    Vector flag(solid.owned, solid.communicator), coordinates(flag);
    for (const Index node : massless)
      flag(node) = 1.;
    flag.compress(VectorOperation::insert);
    VectorTools::get_position_vector(solid.mapping, solid.dof_handler, coordinates);
    const Vector             no_mass = solid.ghosted(flag), positions = solid.ghosted(coordinates);
    const std::vector<Frame> frame = frames(scene, solid);

    if (!diagonal)
      {
        matrix.reinit(solid.stiffness());
        matrix = 0.;
      }
    std::vector<Index>   dofs(solid.fe.n_dofs_per_cell()), nodes(n), rows(n);
    FullMatrix<double>   cell_mass(n, n);
    std::vector<double>  lumped(n), row(n);
    std::vector<Moments> missing(scene.bodies.size(), Moments{});
    const auto           add_cell_moments = [&](const double sign, const unsigned int body) {
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int b = 0; b < n; ++b)
          if (cell_mass(a, b) != 0.)
            add_moments(sign * cell_mass(a, b),
                        frame[body](positions, nodes[a]),
                        frame[body](positions, nodes[b]),
                        missing[body]);
    };
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int        body     = cell->material_id();
          const MaterialParameters &material = scene.bodies[body].material;
          values.reinit(Triangulation<dim>::active_cell_iterator(cell));
          cell->get_dof_indices(dofs);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if (solid.fe.system_to_component_index(i).first == 0)
              nodes[solid.fe.system_to_component_index(i).second] = dofs[i];
          cell_mass = 0.;
          std::fill(lumped.begin(), lumped.end(), 0.);
          for (const unsigned int q : values.quadrature_point_indices())
            for (unsigned int a = 0; a < n; ++a)
              {
                const double part = material.density * values.JxW(q) * values.shape_value(a, q);
                lumped[a] += part;
                if (diagonal)
                  cell_mass(a, a) += part;
                else if (!corrected)
                  for (unsigned int b = 0; b < n; ++b)
                    cell_mass(a, b) += part * values.shape_value(b, q);
              }
          if (corrected)
            {
              // The rule does not know the volume of a distorted cell.
              const double total = std::accumulate(lumped.begin(), lumped.end(), 0.);
              const auto   rule  = dispersion_corrected_rule(material, cell, step);
              for (const Point<dim> &x : rule.get_points())
                for (unsigned int a = 0; a < n; ++a)
                  for (unsigned int b = 0; b < n; ++b)
                    cell_mass(a, b) += total / rule.size() * scalar_fe.shape_value(a, x) *
                                       scalar_fe.shape_value(b, x);
            }

          // What massless nodes lose, the others of the cell take.
          double kept = 0., lost = 0.;
          for (unsigned int a = 0; a < n; ++a)
            if (no_mass(nodes[a]) == 0.)
              kept += lumped[a];
          const bool all_kept = std::all_of(nodes.begin(), nodes.end(), [&](const Index i) {
            return no_mass(i) == 0.;
          });
          if (!all_kept)
            {
              add_cell_moments(1., body);
              for (unsigned int a = 0; a < n; ++a)
                for (unsigned int b = 0; b < n; ++b)
                  if (no_mass(nodes[a]) > 0. || no_mass(nodes[b]) > 0.)
                    {
                      lost += cell_mass(a, b);
                      cell_mass(a, b) = 0.;
                    }
              for (unsigned int a = 0; a < n; ++a)
                if (no_mass(nodes[a]) == 0.)
                  cell_mass(a, a) += lost * lumped[a] / kept;
              add_cell_moments(-1., body);
            }
          for (unsigned int a = 0; a < n; ++a)
            for (unsigned int d = 0; d < dim; ++d)
              {
                if (diagonal)
                  nodal(nodes[a] + d) += cell_mass(a, a);
                else
                  {
                    for (unsigned int b = 0; b < n; ++b)
                      {
                        rows[b] = nodes[b] + d;
                        row[b]  = cell_mass(a, b);
                      }
                    matrix.add(nodes[a] + d, n, rows.data(), row.data());
                  }
              }
        }
    if (diagonal)
      nodal.compress(VectorOperation::add);
    else
      {
        matrix.compress(VectorOperation::add);
        Vector ones(nodal);
        ones = 1.;
        matrix.vmult(nodal, ones);
      }
    if (Utilities::MPI::max(massless.size(), solid.communicator) > 0)
      restore_moments(scene, solid, positions, missing);
  }



  void
  Mass::restore_moments(const Scene                &scene,
                        const Solid                &solid,
                        const Vector               &positions,
                        const std::vector<Moments> &missing)
  {
    // The first unknowns of the owned nodes of each body.
    std::vector<std::set<Index>> nodes(scene.bodies.size());
    std::vector<Index>           dofs(solid.fe.n_dofs_per_cell());
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        {
          cell->get_dof_indices(dofs);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if (solid.fe.system_to_component_index(i).first == 0 &&
                solid.owned.is_element(dofs[i]) && nodal(dofs[i]) > 0.)
              nodes[cell->material_id()].insert(dofs[i]);
        }
    const std::vector<Frame> frame = frames(scene, solid);
    Vector                   correction(nodal);
    correction = 0.;
    for (unsigned int body = 0; body < scene.bodies.size(); ++body)
      {
        Moments sum;
        Utilities::MPI::sum(ArrayView<const double>(missing[body].data(), n_moments),
                            solid.communicator,
                            ArrayView<double>(sum.data(), n_moments));
        FullMatrix<double> gram(n_moments, n_moments);
        for (const Index node : nodes[body])
          {
            const Moments p = monomials(frame[body](positions, node));
            for (unsigned int k = 0; k < n_moments; ++k)
              for (unsigned int l = 0; l < n_moments; ++l)
                gram(k, l) += nodal(node) * p[k] * p[l];
          }
        Utilities::MPI::sum(gram, solid.communicator, gram);
        const dealii::Vector<double> factors = solve_moments(gram, sum, scene.bodies[body]);
        for (const Index node : nodes[body])
          {
            const Moments p     = monomials(frame[body](positions, node));
            double        share = 0.;
            for (unsigned int k = 0; k < n_moments; ++k)
              share += factors(k) * p[k];
            for (unsigned int d = 0; d < dim; ++d)
              correction(node + d) = share * nodal(node);
          }
      }
    correction.compress(VectorOperation::insert);
    nodal += correction;
    if (!diagonal)
      {
        Vector ones(nodal);
        ones = 1.;
        add_to_diagonal(matrix, ones, correction);
      }
  }



  void
  Mass::multiply(const Vector &x, Vector &y) const
  {
    if (diagonal)
      {
        y = x;
        y.scale(nodal);
      }
    else
      matrix.vmult(y, x);
  }



  void
  Mass::add_to(Matrix &sum, const Vector &factors) const
  {
    if (diagonal)
      {
        add_to_diagonal(sum, factors, nodal);
        return;
      }
    const Epetra_CrsMatrix &target = sum.trilinos_matrix();
    for (int i = 0; i < target.NumMyRows(); ++i)
      {
        int     n, m, *columns;
        double *values, *added;
        target.ExtractMyRowView(i, n, values, columns);
        matrix.trilinos_matrix().ExtractMyRowView(i, m, added, columns);
        AssertThrow(n == m, ExcMessage("The matrices have different patterns."));
        for (int j = 0; j < n; ++j)
          values[j] += factors.begin()[i] * added[j];
      }
  }
} // namespace Touchstone

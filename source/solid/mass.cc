// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/solid/bodies.h>
#include <touchstone/solid/mass.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/numerics/vector_tools_interpolate.h>

#include <algorithm>
#include <cmath>
#include <numeric>

// The mass matrix: consistent, lumped, or integrated with points that depend on the Courant
// number. Contact nodes can be made massless, so that their contact forces do not oscillate in
// time; their mass goes to the other nodes of the cell, and factors on the densities of the cells
// restore the mass, centre and, as far as possible, the inertia of each body.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Mass, first and second moments of mass: the kinetic energy of all rigid
     * motions, as the form sum_ab M_ab (1, x_a) (1, x_b) in its upper triangle. */
    constexpr unsigned int n_moments = 10;
    using Moments                    = std::array<double, n_moments>;

    /** Add the moments of a mass between two nodes at x and y, symmetrised: entry (a, b) of a
     * consistent mass matrix couples two positions. */
    void
    add_moments(const double mass, const Point<dim> &x, const Point<dim> &y, Moments &sum)
    {
      const double left[] = {1., x[0], x[1], x[2]}, right[] = {1., y[0], y[1], y[2]};
      unsigned int k = 0;
      for (unsigned int i = 0; i < 4; ++i)
        for (unsigned int j = i; j < 4; ++j)
          sum[k++] += 0.5 * mass * (left[i] * right[j] + left[j] * right[i]);
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
      // The speed of plane longitudinal waves, sqrt((kappa + 4/3 mu) / rho), the fastest of the
      // material.
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

    /** Coordinates in which a body lies between -1 and 1 in each direction: what is thin
     * counts as much as what is long. */
    struct Frame
    {
      explicit Frame(const BoundingBox<dim> &box)
        : centre(box.center())
      {
        for (unsigned int d = 0; d < dim; ++d)
          size[d] = 0.5 * box.side_length(d);
      }

      Point<dim> centre, size;

      Point<dim>
      operator()(const Vector &positions, const Index node) const
      {
        Point<dim> x;
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = (positions(node + d) - centre[d]) / size[d];
        return x;
      }
    };

    /** The mass matrix of one component in a cell. */
    class CellMass
    {
    public:
      CellMass(const MassKind kind, const Solid &solid, const Vector &no_mass, const double step)
        : kind(kind)
        , solid(solid)
        , no_mass(no_mass)
        , step(step)
        , scalar_fe(solid.fe.degree)
        , values(solid.mapping,
                 scalar_fe,
                 QGauss<dim>(solid.fe.degree + 1),
                 update_values | update_JxW_values)
        , lumped(scalar_fe.n_dofs_per_cell())
        , dofs(solid.fe.n_dofs_per_cell())
      {
        nodes.resize(lumped.size());
        complete.reinit(lumped.size(), lumped.size());
      }

      /** First unknowns of the nodes. */
      std::vector<Index> nodes;
      /** As it is, and with the mass of massless nodes at the others. */
      FullMatrix<double> complete, moved;

      void
      reinit(const DoFHandler<dim>::active_cell_iterator &cell)
      {
        const MaterialParameters &material = solid.bodies[cell->material_id()].material;
        values.reinit(Triangulation<dim>::active_cell_iterator(cell));
        cell->get_dof_indices(dofs);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (solid.fe.system_to_component_index(i).first == 0)
            nodes[solid.fe.system_to_component_index(i).second] = dofs[i];
        const unsigned int n = nodes.size();
        // Row sums give the lumped mass. It is needed for every kind, as the key by which the
        // mass of massless nodes is distributed.
        complete = 0.;
        std::fill(lumped.begin(), lumped.end(), 0.);
        for (const unsigned int q : values.quadrature_point_indices())
          for (unsigned int a = 0; a < n; ++a)
            {
              const double part = material.density * values.JxW(q) * values.shape_value(a, q);
              lumped[a] += part;
              if (kind == MassKind::consistent)
                for (unsigned int b = 0; b < n; ++b)
                  complete(a, b) += part * values.shape_value(b, q);
            }
        if (kind == MassKind::lumped)
          for (unsigned int a = 0; a < n; ++a)
            complete(a, a) = lumped[a];
        if (kind == MassKind::dispersion_corrected)
          {
            // The rule does not know the volume of a distorted cell.
            const double total = std::accumulate(lumped.begin(), lumped.end(), 0.);
            const auto   rule  = dispersion_corrected_rule(material, cell, step);
            for (const Point<dim> &x : rule.get_points())
              for (unsigned int a = 0; a < n; ++a)
                for (unsigned int b = 0; b < n; ++b)
                  complete(a, b) +=
                    total / rule.size() * scalar_fe.shape_value(a, x) * scalar_fe.shape_value(b, x);
          }
        move();
      }

    private:
      const MassKind      kind;
      const Solid        &solid;
      const Vector       &no_mass;
      const double        step;
      const FE_Q<dim>     scalar_fe;
      FEValues<dim>       values;
      std::vector<double> lumped;
      std::vector<Index>  dofs;

      /** Move the mass of massless nodes to the other nodes of the cell. */
      void
      move()
      {
        // Entries between a massless node and another one vanish, too, for the matrix must not
        // couple a massless node to accelerations. Their sum is added to the diagonal of the
        // other nodes in proportion to their lumped mass, so that the mass of the cell is kept.
        moved       = complete;
        double kept = 0., lost = 0.;
        for (unsigned int a = 0; a < nodes.size(); ++a)
          for (unsigned int b = 0; b < nodes.size(); ++b)
            if (no_mass(nodes[a]) > 0. || no_mass(nodes[b]) > 0.)
              {
                lost += moved(a, b);
                moved(a, b) = 0.;
              }
            else if (a == b)
              kept += lumped[a];
        for (unsigned int a = 0; a < nodes.size() && lost > 0.; ++a)
          if (no_mass(nodes[a]) == 0.)
            moved(a, a) += lost * lumped[a] / kept;
      }
    };



    /**
     * Factors for the densities of a body's cells by which its moments change.
     *
     * They are 1 + s_e, with the smallest sum of m_e s_e^2 for masses m_e, and stay
     * at a half or more, so that waves hardly change and no motion has negative kinetic
     * energy: cells that would fall below are fixed to that bound.
     */
    class DensityFactors
    {
    public:
      /** The moments of all owned cells. */
      DensityFactors(const std::vector<Moments> &cells, const MPI_Comm communicator)
        : cells(cells)
        , communicator(communicator)
        , factors(cells.size(), 1.)
      {
      }

      /** @return whether there are such factors for the change @p wanted of the first @p n
       * moments. Collective. */
      bool
      find(const dealii::Vector<double> &wanted, const unsigned int n)
      {
        // Minimise sum_e m_e s_e^2 subject to sum_e s_e moments_e = wanted: s_e = sum_k c_k
        // moments_ek / m_e, with c from the Gram matrix of the moments. Cells below the bound are
        // fixed to it and the rest is solved again; the set of fixed cells only grows, so the
        // loop ends.
        constexpr double  least = 0.5;
        std::vector<bool> held(cells.size(), false);
        for (bool again = true; again;)
          {
            FullMatrix<double>     gram(n, n);
            dealii::Vector<double> rest(n);
            double                 total = 0.;
            for (std::size_t e = 0; e < cells.size(); ++e)
              {
                total += cells[e][0];
                for (unsigned int k = 0; k < n; ++k)
                  if (held[e])
                    rest(k) += (1. - least) * cells[e][k];
                  else if (cells[e][0] > 0.)
                    for (unsigned int l = 0; l < n; ++l)
                      gram(k, l) += cells[e][k] * cells[e][l] / cells[e][0];
              }
            Utilities::MPI::sum(gram, communicator, gram);
            Utilities::MPI::sum(rest, communicator, rest);
            total = Utilities::MPI::sum(total, communicator);
            for (unsigned int k = 0; k < n; ++k)
              rest(k) += wanted(k);
            const dealii::Vector<double> c = solve(gram, rest);
            // The residual shows whether the remaining cells can provide the moments at all; the
            // matrix may be singular, e.g. for a body of one layer of cells.
            if (rest.l2_norm() > 1e-10 * total)
              return false;
            again = false;
            for (std::size_t e = 0; e < cells.size(); ++e)
              {
                factors[e] = held[e] ? least : 1.;
                for (unsigned int k = 0; k < n && !held[e] && cells[e][0] > 0.; ++k)
                  factors[e] += c(k) * cells[e][k] / cells[e][0];
                held[e] = held[e] || factors[e] < least;
                again   = again || factors[e] < least;
              }
            again = Utilities::MPI::max(static_cast<int>(again), communicator) == 1;
          }
        return true;
      }

      const std::vector<Moments> &cells;
      const MPI_Comm              communicator;
      std::vector<double>         factors;

    private:
      /** Solve with a matrix that may be singular, by its pseudo-inverse with iterative
       * refinement, which removes the error that grows with the condition number. @p rhs becomes
       * the residual. */
      static dealii::Vector<double>
      solve(const FullMatrix<double> &matrix, dealii::Vector<double> &rhs)
      {
        dealii::Vector<double> result(rhs.size()), correction(rhs.size()), product(rhs.size());
        if (matrix.linfty_norm() == 0.)
          return result;
        LAPACKFullMatrix<double> inverse(rhs.size());
        inverse = matrix;
        inverse.compute_inverse_svd(1e-12);
        for (unsigned int refinement = 0; refinement < 3; ++refinement)
          {
            inverse.vmult(correction, rhs);
            result += correction;
            matrix.vmult(product, correction);
            rhs -= product;
          }
        return result;
      }
    };
  } // namespace



  Mass::Mass(const MassKind         kind,
             const Solid           &solid,
             const std::set<Index> &massless,
             const double           step)
    : nodal(solid.owned, solid.communicator)
    , diagonal(kind == MassKind::lumped)
  {
    Vector flag(solid.owned, solid.communicator);
    for (const Index node : massless)
      flag(node) = 1.;
    flag.compress(VectorOperation::insert);
    // Cells need the flags of their ghost nodes as well.
    const Vector              no_mass = solid.ghosted(flag);
    const std::vector<double> factors = density_factors(kind, solid, massless, no_mass, step);
    if (!diagonal)
      matrix.reinit(solid.stiffness());
    CellMass                  mass(kind, solid, no_mass, step);
    const unsigned int        n = mass.nodes.size();
    std::vector<int>          rows(n);
    std::vector<unsigned int> nodes(n);
    // Ghost cells are integrated by each rank that has rows of them, as for the stiffness;
    // densities of ghost cells were exchanged, so that ranks agree.
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        mass.reinit(cell);
        mass.moved *= factors[cell->active_cell_index()];
        bool any = false;
        for (unsigned int a = 0; a < n; ++a)
          {
            rows[a] = solid.stiffness().row(mass.nodes[a]);
            any     = any || rows[a] >= 0;
            if (diagonal && rows[a] >= 0)
              for (unsigned int d = 0; d < dim; ++d)
                nodal.begin()[rows[a] + d] += mass.moved(a, a);
          }
        if (diagonal || !any)
          continue;
        for (unsigned int a = 0; a < n; ++a)
          nodes[a] = matrix.node(mass.nodes[a]);
        matrix.add(n, rows.data(), nodes.data(), [&](const unsigned int i, const unsigned int j) {
          return i % dim == j % dim ? mass.moved(i / dim, j / dim) : 0.;
        });
      }
    if (!diagonal)
      {
        // Row sums by a product with ones: the mass of each node, which the sums over the cells
        // of other ranks include.
        Vector ones(nodal);
        ones = 1.;
        matrix.vmult(nodal, ones);
      }
  }



  std::vector<double>
  Mass::density_factors(const MassKind         kind,
                        const Solid           &solid,
                        const std::set<Index> &massless,
                        const Vector          &no_mass,
                        const double           step)
  {
    std::vector<double> result(solid.dof_handler.get_triangulation().n_active_cells(), 1.);
    // Factors are found per body from the moments that the move of mass inside cells has changed;
    // without massless nodes on any rank there is nothing to correct.
    if (Utilities::MPI::max(massless.size(), solid.communicator) == 0)
      return result;
    Vector coordinates(solid.owned, solid.communicator);
    VectorTools::get_position_vector(solid.mapping, solid.dof_handler, coordinates);
    const Vector positions = solid.ghosted(coordinates);
    const auto   boxes     = body_boxes(solid);
    CellMass     mass(kind, solid, no_mass, step);
    for (unsigned int body = 0; body < solid.n_bodies(); ++body)
      {
        const Frame               frame(boxes[body]);
        dealii::Vector<double>    missing(n_moments);
        std::vector<Moments>      moments;
        std::vector<unsigned int> numbers;
        for (const auto &cell : solid.dof_handler.active_cell_iterators())
          if (cell->is_locally_owned() && cell->material_id() == body)
            {
              mass.reinit(cell);
              Moments before = {}, after = {};
              for (unsigned int a = 0; a < mass.nodes.size(); ++a)
                for (unsigned int b = 0; b < mass.nodes.size(); ++b)
                  {
                    const Point<dim> x = frame(positions, mass.nodes[a]),
                                     y = frame(positions, mass.nodes[b]);
                    add_moments(mass.complete(a, b), x, y, before);
                    add_moments(mass.moved(a, b), x, y, after);
                  }
              for (unsigned int k = 0; k < n_moments; ++k)
                missing(k) += before[k] - after[k];
              moments.push_back(after);
              numbers.push_back(cell->active_cell_index());
            }
        Utilities::MPI::sum(missing, solid.communicator, missing);
        if (missing.linfty_norm() == 0.)
          continue;
        DensityFactors density(moments, solid.communicator);
        // The moments of inertia as far as such factors can keep them, mass and centre always.
        bool found = false;
        for (double part = 1.; part > 0.1 && !found; part -= 0.25)
          {
            dealii::Vector<double> wanted(missing);
            for (unsigned int k = 1 + dim; k < n_moments; ++k)
              wanted(k) *= part;
            found = density.find(wanted, n_moments);
          }
        found = found || density.find(missing, 1 + dim);
        if (!found)
          throw InputError(solid.bodies[body].section(),
                           "Geometry",
                           "",
                           "the nodes beside the slave nodes are too few to take their mass and "
                           "keep its centre",
                           "take more cells through the thickness, make this body the master, "
                           "or set 'Time integration/Scheme' to 'generalized_alpha'");
        for (std::size_t e = 0; e < numbers.size(); ++e)
          result[numbers[e]] = density.factors[e];
      }
    using Cell = Triangulation<dim>::active_cell_iterator;
    GridTools::exchange_cell_data_to_ghosts<double, Triangulation<dim>>(
      solid.dof_handler.get_triangulation(),
      [&](const Cell &cell) -> std_cxx17::optional<double> {
        return result[cell->active_cell_index()];
      },
      [&](const Cell &cell, const double factor) { result[cell->active_cell_index()] = factor; });
    return result;
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
        Vector entries(nodal);
        entries.scale(factors);
        sum.add_to_diagonal(entries);
        return;
      }
    sum.add(factors, matrix);
  }
} // namespace Touchstone

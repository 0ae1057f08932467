// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/solid/bodies.h>
#include <touchstone/solid/cell_mass.h>
#include <touchstone/solid/mass.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/vector_tools_interpolate.h>

#include <array>

// Factors on the densities of the cells of a body whose contact nodes are massless: they restore
// its mass, centre and, as far as possible, its moments of inertia.
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
    Vector coordinates(solid.zero_vector());
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
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later
// Mass of bodies: total, centre and moments of inertia against integrals over the cells,
// for each kind of mass, degree and shape of cells; massless nodes keep mass and centre;
// and no motion has negative kinetic energy.

#include <touchstone/base/input_error.h>
#include <touchstone/solid/mass.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/numerics/vector_tools_interpolate.h>

#include "contact_support.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  const std::string block = R"(
set Bodies = body
subsection Body body
  subsection Geometry
    set Type         = box
    set Lower corner = 1, 2, 3
    set Upper corner = 2, 2.5, 3.8
    set Cells        = 2, 2, 3
  end
  subsection Material
    set Young modulus = 200
    set Poisson ratio = 0.3
    set Density       = 7
  end
end
subsection Time integration
  set Scheme = newmark
end
)";

  const std::string long_block = R"(
set Bodies = body
subsection Body body
  subsection Geometry
    set Type         = box
    set Lower corner = 1, 2, 3
    set Upper corner = 2, 2.5, 7
    set Cells        = 2, 2, 12
  end
  subsection Material
    set Young modulus = 200
    set Poisson ratio = 0.3
    set Density       = 7
  end
end
subsection Time integration
  set Scheme = newmark
end
)";

  const std::string ball = R"(
set Bodies = body
subsection Body body
  subsection Geometry
    set Type   = ball
    set Centre = 1, 2, 3
    set Radius = 0.5
  end
  subsection Material
    set Young modulus = 200
    set Poisson ratio = 0.3
    set Density       = 7
  end
end
subsection Time integration
  set Scheme = newmark
end
)";

  /** Mass, first and second moments. */
  using Moments = std::array<double, 10>;

  /** Of a mass matrix, from the kinetic energy of motions 1, x, y, z along direction d. */
  Moments
  moments(const Solid &solid, const Mass &mass, const unsigned int d)
  {
    Touchstone::Vector x(solid.owned, solid.communicator);
    VectorTools::get_position_vector(solid.mapping, solid.dof_handler, x);
    std::vector<Touchstone::Vector> motion(4, x);
    for (unsigned int i = 0; i < 4; ++i)
      {
        motion[i] = 0.;
        for (std::size_t k = 0; k < x.locally_owned_size(); k += dim)
          motion[i].begin()[k + d] = i == 0 ? 1. : x.begin()[k + i - 1];
      }
    Moments            result;
    Touchstone::Vector product(x);
    unsigned int       n = 0;
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int j = i; j < 4; ++j)
        {
          mass.multiply(motion[i], product);
          result[n++] = product * motion[j];
        }
    return result;
  }



  /** Integrals of 1, x, y, z and their products over the cells. */
  Moments
  integrals(const Solid &solid, const double density)
  {
    FEValues<dim> values(solid.mapping,
                         solid.fe,
                         QGauss<dim>(6),
                         update_quadrature_points | update_JxW_values);
    Moments       result = {};
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          for (const unsigned int q : values.quadrature_point_indices())
            {
              const Point<dim> &p   = values.quadrature_point(q);
              const double      x[] = {1., p[0], p[1], p[2]};
              unsigned int      n   = 0;
              for (unsigned int i = 0; i < 4; ++i)
                for (unsigned int j = i; j < 4; ++j)
                  result[n++] += density * values.JxW(q) * x[i] * x[j];
            }
        }
    for (double &moment : result)
      moment = Utilities::MPI::sum(moment, solid.communicator);
    return result;
  }



  double
  difference(const Moments &a, const Moments &b, const unsigned int from, const unsigned int to)
  {
    double result = 0.;
    for (unsigned int k = from; k < to; ++k)
      result = std::max(result, std::abs(a[k] - b[k]) / std::abs(b[k]));
    return result;
  }



  /** The first unknowns of the owned nodes that a criterion chooses. */
  std::set<Index>
  nodes_where(const Solid &solid, const std::function<bool(const Point<dim> &)> &chosen)
  {
    Touchstone::Vector x(solid.owned, solid.communicator);
    VectorTools::get_position_vector(solid.mapping, solid.dof_handler, x);
    std::set<Index> result;
    for (std::size_t k = 0; k < x.locally_owned_size(); k += dim)
      if (chosen(Point<dim>(x.begin()[k], x.begin()[k + 1], x.begin()[k + 2])))
        result.insert(solid.owned.nth_index_in_set(k));
    return result;
  }



  /** Smallest and largest eigenvalue of a direction's mass on the nodes that have some. */
  std::pair<double, double>
  extreme_eigenvalues(const Solid &solid, const Mass &mass, const std::set<Index> &massless)
  {
    const Index        n = solid.dof_handler.n_dofs() / dim;
    FullMatrix<double> all(n, n);
    std::vector<int>   without(n, 0);
    for (const Index node : massless)
      without[node / dim] = 1;
    for (int &flag : without)
      flag = Utilities::MPI::sum(flag, solid.communicator);
    Touchstone::Vector unit(solid.owned, solid.communicator), column(unit);
    for (Index j = 0; j < n; ++j)
      {
        unit = 0.;
        if (solid.owned.is_element(dim * j))
          unit(dim * j) = 1.;
        unit.compress(VectorOperation::insert);
        mass.multiply(unit, column);
        for (std::size_t k = 0; k < column.locally_owned_size(); k += dim)
          all(solid.owned.nth_index_in_set(k) / dim, j) = column.begin()[k];
      }
    Utilities::MPI::sum(all, solid.communicator, all);
    std::vector<Index> kept;
    double             left = 0.;
    for (Index i = 0; i < n; ++i)
      if (without[i] == 0)
        kept.push_back(i);
      else
        for (Index j = 0; j < n; ++j)
          left = std::max({left, std::abs(all(i, j)), std::abs(all(j, i))});
    if (left > 0.)
      std::cout << "massless nodes have mass " << left << std::endl;
    LAPACKFullMatrix<double> matrix(kept.size());
    for (unsigned int i = 0; i < kept.size(); ++i)
      for (unsigned int j = 0; j < kept.size(); ++j)
        matrix(i, j) = all(kept[i], kept[j]);
    matrix.compute_eigenvalues();
    std::pair<double, double> result(1e300, -1e300);
    for (unsigned int i = 0; i < kept.size(); ++i)
      {
        result.first  = std::min(result.first, matrix.eigenvalue(i).real());
        result.second = std::max(result.second, matrix.eigenvalue(i).real());
      }
    return result;
  }



  void
  check(const std::string                             &name,
        const std::string                             &text,
        const std::string                             &kind,
        const std::string                             &degree,
        const double                                   step,
        const std::function<bool(const Point<dim> &)> &chosen)
  {
    const Scene           scene(text,
                      "scene.prm",
                      {"Time integration/Mass=" + kind, "Discretisation/Degree=" + degree});
    const Forest          forest(scene.forest_input(), "", MPI_COMM_WORLD);
    Solid                 solid(scene.bodies, scene.discretisation.degree, forest, MPI_COMM_WORLD);
    const std::set<Index> chosen_nodes = nodes_where(solid, chosen);
    solid.assemble();
    const Mass full(scene.time_integration.mass, solid, {}, step),
      part(scene.time_integration.mass, solid, chosen_nodes, step);
    const Moments exact = integrals(solid, 7.), of_full = moments(solid, full, 0);
    double        moved = 0., inertia = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const Moments now = moments(solid, part, d);
        moved             = std::max(moved, difference(now, of_full, 0, 4));
        inertia           = std::max(inertia, difference(now, of_full, 4, 10));
      }
    const auto before = extreme_eigenvalues(solid, full, {}),
               after  = extreme_eigenvalues(solid, part, chosen_nodes);
    // x^2, xy, ... of lumped mass are those of the nodes.
    const std::array<unsigned int, 6> second = {{4, 5, 6, 7, 8, 9}};
    double                            error  = 0.;
    for (const unsigned int k : second)
      error = std::max(error, std::abs(of_full[k] - exact[k]) / std::abs(exact[k]));
    const unsigned int massless = Utilities::MPI::sum(chosen_nodes.size(), MPI_COMM_WORLD);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << name << ", degree " << degree << ", " << kind << ": mass "
                << small(std::abs(of_full[0] / exact[0] - 1.), 1e-12) << ", centre "
                << small(difference(of_full, exact, 1, 4), 1e-12) << ", moments of inertia "
                << (error < 1e-12  ? "exact"
                    : error < 1e-3 ? "near"
                    : error < 0.05 ? "rough"
                                   : "WRONG")
                << (before.first > -1e-14 * before.second ? "" : ", NEGATIVE") << "; " << massless
                << " massless nodes: mass and centre moved by " << small(moved, 1e-12)
                << ", moments of inertia "
                << (inertia < 1e-12  ? "kept"
                    : inertia < 0.02 ? "nearly kept"
                                     : "LOST")
                << (after.first > -1e-14 * after.second ? "" : ", NEGATIVE") << std::endl;
    if (std::getenv("MASS_VERBOSE"))
      std::cout << "   " << error << ' ' << inertia << ' ' << before.first << ' ' << before.second
                << ' ' << after.first << ' ' << after.second << std::endl;
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const auto                       bottom = [](const Point<dim> &p) { return p[2] < 3. + 1e-6; };
  const auto                       corner = [](const Point<dim> &p) {
    return p[2] < 3. + 1e-6 && p[0] + p[1] < 4. - 1e-6;
  };
  const auto pole = [](const Point<dim> &p) { return p[2] < 2.6; };
  for (const std::string degree : {"1", "2"})
    for (const std::string kind : {"consistent", "lumped", "dispersion corrected"})
      {
        if (degree == "2" && kind == "dispersion corrected")
          continue;
        // The second step is that of a Courant number of one, and more.
        for (const double step : {1e-3, 1.})
          {
            if (step == 1. && kind != "dispersion corrected")
              continue;
            check("block", block, kind, degree, step, bottom);
            check("block", block, kind, degree, step, corner);
            check("ball", ball, kind, degree, step, pole);
            if (degree == "1")
              check("long block", long_block, kind, degree, step, bottom);
          }
      }
  return 0;
}

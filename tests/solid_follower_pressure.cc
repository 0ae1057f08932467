// SPDX-License-Identifier: LGPL-2.1-or-later
// Pressure that follows the deformed surface: a closed surface has neither a net force
// nor a moment, the stiffness is the derivative of the forces, and two exact solutions at
// large strain.

#include "contact_support.h"
#include "drive_support.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  const std::string ball = R"(
set Bodies = ball
subsection Body ball
  set Boundary conditions = surface
  subsection Geometry
    set Type   = ball
    set Radius = 1
  end
  subsection Material
    set Law           = neo-Hookean
    set Young modulus = 200
    set Poisson ratio = 0.3
  end
  subsection Boundary surface
    set Pressure = 3 * t
  end
end
)";

  bool
  first_rank()
  {
    return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }



  /** Visit the owned unknowns with their reference positions. */
  template <typename Visitor>
  void
  for_each_unknown(const Solid &solid, const Visitor &visit)
  {
    std::vector<Index> dofs(solid.fe.n_dofs_per_cell());
    std::set<Index>    seen;
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        {
          cell->get_dof_indices(dofs);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if (solid.owned.is_element(dofs[i]) && seen.insert(dofs[i]).second)
              visit(dofs[i],
                    solid.fe.system_to_component_index(i).first,
                    solid.mapping.transform_unit_to_real_cell(cell,
                                                              solid.fe.unit_support_point(i)));
        }
  }



  /** A scattered displacement of all nodes. */
  Touchstone::Vector
  displacement(const Solid &solid, const double size, const unsigned int seed)
  {
    Touchstone::Vector u(solid.owned, solid.communicator);
    for_each_unknown(solid, [&](const Index i, const unsigned int d, const Point<dim> &x) {
      u(i) = size * scattered(x, seed)[d];
    });
    u.compress(VectorOperation::insert);
    return u;
  }



  Touchstone::Vector
  product(const Solid &solid, const std::vector<RankOneTerm> &terms, const Touchstone::Vector &v)
  {
    Touchstone::Vector ghosted(solid.owned, solid.relevant, solid.communicator);
    ghosted = v;
    Touchstone::Vector result(solid.owned, solid.communicator);
    for (const RankOneTerm &term : terms)
      {
        double change = 0.;
        for (const auto &[column, value] : term.right)
          change += value * ghosted(column);
        for (const auto &[row, value] : term.left)
          result(row) += value * change;
      }
    result.compress(VectorOperation::add);
    return result;
  }



  void
  closed_surface(const std::string &degree, const std::string &pressure)
  {
    const Scene  scene(ball,
                      "scene.prm",
                      {"Discretisation/Degree=" + degree,
                        "Body ball/Boundary surface/Pressure=" + pressure});
    const Forest forest(scene.forest_input(), "", MPI_COMM_WORLD);
    const Solid  solid(scene.bodies, scene.discretisation.degree, forest, MPI_COMM_WORLD);
    const BoundaryConditions conditions(forest, solid);
    const Touchstone::Vector u = displacement(solid, 0.05, 1), v = displacement(solid, 1., 2),
                             w = displacement(solid, 1., 3);
    Touchstone::Vector force(u), after(u), before(u);
    conditions.external_force(1., u, force);

    Tensor<1, dim>                                             sum, moment;
    std::map<Index, std::pair<Tensor<1, dim>, Tensor<1, dim>>> nodes;
    for_each_unknown(solid, [&](const Index i, const unsigned int d, const Point<dim> &x) {
      nodes[i / dim].first[d]  = x[d] + u(i);
      nodes[i / dim].second[d] = force(i);
    });
    for (const auto &[node, entry] : nodes)
      {
        sum += entry.second;
        moment += cross_product_3d(entry.first, entry.second);
      }
    sum    = Utilities::MPI::sum(sum, MPI_COMM_WORLD);
    moment = Utilities::MPI::sum(moment, MPI_COMM_WORLD);

    std::vector<RankOneTerm> terms, symmetric;
    conditions.follower_pressure().add_stiffness(1., u, false, terms);
    conditions.follower_pressure().add_stiffness(1., u, true, symmetric);
    // The force is quadratic in u but for the pressure, which is fixed to the reference.
    const double       step = 1e-3;
    Touchstone::Vector moved(u);
    moved.add(step, v);
    conditions.external_force(1., moved, after);
    moved.add(-2. * step, v);
    conditions.external_force(1., moved, before);
    after -= before;
    after /= -2. * step;
    const Touchstone::Vector by_stiffness = product(solid, terms, v);
    after -= by_stiffness;
    const double scale      = by_stiffness.l2_norm();
    const double derivative = after.l2_norm() / scale;
    const double a = product(solid, terms, v) * w, b = product(solid, terms, w) * v,
                 c       = product(solid, symmetric, v) * w;
    const double norms   = scale * w.l2_norm();
    const double largest = force.l2_norm(), net = sum.norm() / largest,
                 turn = moment.norm() / largest;
    if (first_rank())
      std::cout << "ball, degree " << degree << ", pressure " << pressure << ": net force "
                << (net < 1e-12 ? "0" : "not 0") << ", moment " << (turn < 1e-12 ? "0" : "not 0")
                << ", derivative " << small(derivative, 1e-9)
                << (pressure != "3"                   ? ""
                    : std::abs(a - b) < 1e-12 * norms ? ", stiffness symmetric"
                                                      : ", stiffness unsymmetric FAILED")
                << ", its symmetric part " << small((c - 0.5 * (a + b)) / norms, 1e-12)
                << std::endl;
  }



  /** A scene whose steps are solved. */
  struct SolvedRun : Run
  {
    bool quadratic = true;

    SolvedRun(const std::string &text, const std::vector<std::string> &overrides)
      : Run(text, overrides, MPI_COMM_WORLD)
    {
      for (const std::vector<double> &residuals : solve_steps())
        for (unsigned int i = 2; i < residuals.size(); ++i)
          quadratic =
            quadratic && residuals[i] < std::max(200. * std::pow(residuals[i - 1], 2), 1e-12);
    }

    /** Largest of a function of displacement component, its number and place. */
    template <typename Function>
    double
    largest(const Function &function)
    {
      const Touchstone::Vector u      = problem.state().ghosted_displacement();
      double                   result = 0.;
      for_each_unknown(solid, [&](const Index i, const unsigned int d, const Point<dim> &x) {
        result = std::max(result, function(u(i), d, x));
      });
      return Utilities::MPI::max(result, MPI_COMM_WORLD);
    }
  };



  /** A block under pressure from all sides: sigma = kappa/2 (J - 1/J) = -p. */
  void
  block(const std::string &degree, const std::string &solver)
  {
    const double E = 200., nu = 0.3, kappa = E / (3. * (1. - 2. * nu)), p = 80.;
    SolvedRun    run(R"(
set Bodies = block
subsection Body block
  set Symmetry            = left, front, bottom
  set Boundary conditions = right, back, top
  subsection Geometry
    set Type  = box
    set Cells = 2, 1, 3
  end
  subsection Material
    set Law           = neo-Hookean
    set Young modulus = 200
    set Poisson ratio = 0.3
  end
  subsection Boundary right
    set Pressure = 80 * t
  end
  subsection Boundary back
    set Pressure = 80 * t
  end
  subsection Boundary top
    set Pressure = 80 * t
  end
end
subsection Load stepping
  set Steps = 4
end
subsection Newton
  set Residual tolerance = 1e-12
end
)",
                  {"Discretisation/Degree=" + degree, "Linear solver/Type=" + solver});
    const double J       = -p / kappa + std::sqrt(1. + p * p / (kappa * kappa));
    const double stretch = std::cbrt(J);
    const double place =
      run.largest([&](const double u, const unsigned int d, const Point<dim> &x) {
        return std::abs(u - (stretch - 1.) * x[d]);
      });
    const double reaction =
      run.problem.state().reactions()[0].force.norm() / (p * stretch * stretch) - 1.;
    if (first_rank())
      std::cout << "block, degree " << degree << ", " << solver << ": stretch " << stretch
                << ", places " << small(place, 1e-9) << ", reaction " << small(reaction, 1e-9)
                << (solver != "MUMPS" ? ""
                    : run.quadratic   ? ", quadratic"
                                      : ", not quadratic FAILED")
                << std::endl;
  }



  /** A thick tube in plane strain, inflated until its bore is half as wide again: with
   * stretches l = r/R, p = int mu (l^2 - 1/l^2) dr / r. */
  void
  tube(const unsigned int cells)
  {
    const double E = 200., nu = 0.4999, mu = E / (2. * (1. + nu)), a = 1.5, b = std::sqrt(5.25);
    double       p = 0.;
    for (unsigned int i = 0; i < 1000; ++i)
      {
        const double r = a + (i + 0.5) * (b - a) / 1000., l = r / std::sqrt(r * r - 1.25);
        p += mu * (l * l - 1. / (l * l)) * (b - a) / 1000. / r;
      }
    const std::string n = std::to_string(cells);
    SolvedRun         run(R"(
set Bodies = tube
subsection Body tube
  set Symmetry            = first cut, second cut, start, end
  set Boundary conditions = inner
  subsection Geometry
    set Type         = tube
    set Inner radius = 1
    set Outer radius = 2
    set End          = 0.1
    set Angle        = 90
  end
  subsection Material
    set Law           = neo-Hookean
    set Young modulus = 200
    set Poisson ratio = 0.4999
  end
  subsection Boundary inner
  end
end
subsection Load stepping
  set Steps = 10
end
)",
                  {"Body tube/Geometry/Cells=" + n + ", " + std::to_string(2 * cells) + ", 1",
                           "Body tube/Boundary inner/Pressure=" + std::to_string(p) + " * t"});
    const double      moved =
      run.largest([&](const double u, const unsigned int d, const Point<dim> &x) {
        return d == 0 && x[1] < 1e-9 && x[0] < 1. + 1e-9 ? u : 0.;
      });
    if (first_rank())
      std::cout << "tube, " << cells << " cells: the bore moves by " << moved << ", exact 0.5"
                << (std::abs(moved - 0.5) < 0.5 * 0.16 / (cells * cells) * 4. ? "" : " FAILED")
                << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string degree : {"1", "2"})
    {
      closed_surface(degree, "3");
      closed_surface(degree, "3 + x - 2 * y");
    }
  block("1", "MUMPS");
  block("2", "MUMPS");
  block("1", "Belos CG");
  tube(4);
  tube(8);
  return 0;
}

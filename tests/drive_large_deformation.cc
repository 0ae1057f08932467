// SPDX-License-Identifier: LGPL-2.1-or-later
// Large deformations with exact solutions, on one rank and two: uniaxial tension to
// twice the length, with quadratic convergence; a rotation by 90 degrees and a
// homogeneous deformation of a distorted mesh; the stiffness at rest; a linear body
// beside a nonlinear one.

#include <touchstone/solid/hyperelastic_law.h>

#include <deal.II/dofs/dof_tools.h>

#include "drive_support.h"
#include "mesh_common.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  const std::string block = R"(
set Bodies = block
subsection Body block
  set Symmetry            = left, front, bottom
  set Boundary conditions = right
  subsection Geometry
    set Type  = box
    set Cells = 2, 1, 3
  end
  subsection Material
    set Young modulus = 200
    set Poisson ratio = 0.3
  end
  subsection Boundary right
    set Displacement x = t
  end
end
subsection Load stepping
  set Steps = 4
end
subsection Newton
  set Residual tolerance = 1e-12
end
)";

  const std::string rod = R"(
set Bodies = rod
subsection Body rod
  set Boundary conditions = side, start, end
  subsection Geometry
    set Type  = cylinder
    set End   = 2
    set Cells = 1, 1, 3
  end
  subsection Material
    set Young modulus = 200
    set Poisson ratio = 0.3
  end
  subsection Boundary side
  end
  subsection Boundary start
  end
  subsection Boundary end
  end
end
subsection Newton
  set Residual tolerance = 1e-12
end
)";

  /** Stretches along the load and across, and the nominal stress along it. */
  struct Tension
  {
    double along, across, stress;
  };



  /** What the equation "no stress across" gives, by bisection. */
  Tension
  exact_tension(const std::string &law, const double stretch)
  {
    const double E = 200., nu = 0.3, mu = E / (2. * (1. + nu)), kappa = E / (3. * (1. - 2. * nu));
    if (law == "St. Venant-Kirchhoff")
      {
        const double strain = 0.5 * (stretch * stretch - 1.);
        return {stretch, std::sqrt(1. - 2. * nu * strain), stretch * E * strain};
      }
    // Kirchhoff stresses: deviator mu J^{-2/3} dev b, mean kappa/2 (J^2 - 1).
    const auto kirchhoff = [&](const double s, const bool along) {
      const double J = stretch * s * s, first = stretch * stretch + 2. * s * s;
      const double b = along ? stretch * stretch : s * s;
      return mu * std::pow(J, -2. / 3.) * (b - first / 3.) + 0.5 * kappa * (J * J - 1.);
    };
    double low = 0.1, high = 1.;
    for (unsigned int i = 0; i < 100; ++i)
      (kirchhoff(0.5 * (low + high), false) > 0. ? high : low) = 0.5 * (low + high);
    return {stretch, low, kirchhoff(low, true) / stretch};
  }



  /** A scene whose steps are solved, with the residuals of the last one. */
  struct SolvedRun : Run
  {
    const std::vector<double> residuals;

    SolvedRun(const std::string &text, const std::vector<std::string> &overrides)
      : Run(text, overrides, MPI_COMM_WORLD)
      , residuals(solve_steps().back())
    {
    }

    /** Largest deviation of a node of a body from the place F X + c. */
    double
    deviation(const unsigned int    body,
              const Tensor<2, dim> &F,
              const Tensor<1, dim> &c = Tensor<1, dim>())
    {
      const Touchstone::Vector u       = problem.state().ghosted_displacement();
      double                   largest = 0.;
      std::vector<Index>       dofs(solid.fe.n_dofs_per_cell());
      for (const auto &cell : solid.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned() && cell->material_id() == body)
          {
            cell->get_dof_indices(dofs);
            for (unsigned int i = 0; i < dofs.size(); ++i)
              {
                const unsigned int   d = solid.fe.system_to_component_index(i).first;
                const Tensor<1, dim> X =
                  solid.mapping.transform_unit_to_real_cell(cell, solid.fe.unit_support_point(i));
                largest = std::max(largest, std::abs(u(dofs[i]) - (F[d] * X + c[d] - X[d])));
              }
          }
      return Utilities::MPI::max(largest, MPI_COMM_WORLD);
    }

    /** Largest deviation of a stress of a body. */
    double
    deviation(const unsigned int body, const SymmetricTensor<2, dim> &exact)
    {
      double largest = 0.;
      solid.for_each_stress(problem.state().ghosted_displacement(),
                            [&](const unsigned int b,
                                const Point<dim> &,
                                const SymmetricTensor<2, dim> &stress,
                                const double) {
                              if (b == body)
                                largest = std::max(largest, (stress - exact).norm());
                            });
      return Utilities::MPI::max(largest, MPI_COMM_WORLD);
    }

    /** Present volume of all bodies. */
    double
    volume()
    {
      double sum = 0.;
      solid.for_each_stress(problem.state().ghosted_displacement(),
                            [&](unsigned int,
                                const Point<dim> &,
                                const SymmetricTensor<2, dim> &,
                                const double v) { sum += v; });
      return Utilities::MPI::sum(sum, MPI_COMM_WORLD);
    }
  };



  bool
  first_rank()
  {
    return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }



  void
  tension(const std::string &law, const std::string &element, const std::string &degree)
  {
    SolvedRun     run(block,
                  {"Body block/Material/Law=" + law,
                       "Body block/Element=" + element,
                       "Discretisation/Degree=" + degree});
    const Tension exact = exact_tension(law, 2.);

    Tensor<2, dim>          F;
    SymmetricTensor<2, dim> stress;
    F[0][0] = exact.along;
    F[1][1] = F[2][2]      = exact.across;
    stress[0][0]           = exact.stress / (exact.across * exact.across);
    const auto   reactions = run.problem.state().reactions();
    const auto  &made      = HyperelasticRegistry::make(law, run.scene.bodies[0].material);
    const double energy    = run.problem.state().strain_energy() / made->energy(F) - 1.;
    const double place     = run.deviation(0, F);
    const double cauchy    = run.deviation(0, stress) / stress.norm();
    const double reaction  = reactions.back().force[0] / exact.stress - 1.;
    const double volume    = run.volume() / determinant(F) - 1.;
    // Each residual is about the square of the one before, down to round-off.
    bool quadratic = run.residuals.size() > 2;
    for (unsigned int i = 1; i < run.residuals.size(); ++i)
      quadratic =
        quadratic && run.residuals[i] < std::max(200. * std::pow(run.residuals[i - 1], 2), 1e-12);
    if (first_rank())
      std::cout << "tension, " << law << ", " << run.scene.bodies[0].element_type.word()
                << ", degree " << degree << ": nominal stress " << exact.stress << ", places "
                << small(place, 1e-10) << ", Cauchy stress " << small(cauchy, 1e-10)
                << ", reaction " << small(reaction, 1e-10) << ", energy " << small(energy, 1e-10)
                << ", volume " << small(volume, 1e-10)
                << (quadratic ? ", quadratic" : ", not quadratic FAILED") << std::endl;
  }



  /** All of the boundary is moved by x = F X + c at the end. */
  void
  homogeneous(const std::string    &what,
              const std::string    &law,
              const std::string    &element,
              const std::string    &degree,
              const std::string     formulas[dim],
              const Tensor<2, dim> &F)
  {
    std::vector<std::string> overrides = {"Body rod/Material/Law=" + law,
                                          "Body rod/Element=" + element,
                                          "Discretisation/Degree=" + degree};
    for (const std::string boundary : {"side", "start", "end"})
      for (unsigned int d = 0; d < dim; ++d)
        overrides.push_back("Body rod/Boundary " + boundary + "/Displacement " + "xyz"[d] + "=" +
                            formulas[d]);
    SolvedRun  run(rod, overrides);
    const auto made = HyperelasticRegistry::make(law, run.scene.bodies[0].material);
    const SymmetricTensor<2, dim> exact =
      symmetrize(made->stress(F) * transpose(F)) / determinant(F);
    const double stress = run.deviation(0, exact) / 200., place = run.deviation(0, F);
    if (first_rank())
      std::cout << what << ", " << law << ", " << run.scene.bodies[0].element_type.word()
                << ", degree " << degree << ": stress "
                << (exact.norm() < 1e-10 ? 0. : exact.norm()) << ", deviation "
                << small(stress, 1e-10) << ", places " << small(place, 1e-10) << std::endl;
  }



  /** Without displacement the laws are linear elasticity, and F-bar is B-bar. */
  void
  undeformed(const std::string &law,
             const std::string &element,
             const std::string &linear_element,
             const std::string &degree)
  {
    const auto make = [&](const std::string &l, const std::string &e) {
      const Scene  scene(rod,
                        "scene.prm",
                        {"Body rod/Material/Law=" + l,
                          "Body rod/Element=" + e,
                          "Discretisation/Degree=" + degree});
      const Forest forest(scene.forest_input(), "", MPI_COMM_WORLD);
      Solid        solid(scene.bodies, scene.discretisation.degree, forest, MPI_COMM_WORLD);
      solid.assemble();
      auto matrix = std::make_unique<Matrix>();
      matrix->copy_from(solid.stiffness());
      return matrix;
    };
    const auto   nonlinear = make(law, element), linear = make("linear elastic", linear_element);
    const double scale = linear->frobenius_norm();
    Touchstone::Vector ones(IndexSet(linear->rows()), MPI_COMM_WORLD);
    ones = 1.;
    *nonlinear *= -1.;
    nonlinear->add(ones, *linear);
    const double difference = nonlinear->frobenius_norm() / scale;
    if (first_rank())
      std::cout << "stiffness at rest, " << law << ", " << element << " and " << linear_element
                << ", degree " << degree << ": difference " << small(difference, 1e-13)
                << std::endl;
  }



  /** A linear and a nonlinear block side by side do not know each other. */
  void
  mixed()
  {
    std::string second = block.substr(block.find("subsection Body"));
    second             = second.substr(0, second.find("subsection Load"));
    for (std::size_t at = second.find("block"); at != std::string::npos; at = second.find("block"))
      second.replace(at, 5, "soft");
    std::string text = block + second;
    text.replace(text.find("Bodies = block"), 14, "Bodies = block, soft");
    SolvedRun     run(text,
                  {"Body soft/Material/Law=neo-Hookean",
                       "Body soft/Geometry/Lower corner=0, 5, 0",
                       "Body soft/Geometry/Upper corner=1, 6, 1"});
    const Tension exact = exact_tension("neo-Hookean", 2.);

    Tensor<2, dim>          F, linear;
    SymmetricTensor<2, dim> stress, linear_stress;
    Tensor<1, dim>          shift;
    F[0][0] = linear[0][0] = 2.;
    F[1][1] = F[2][2] = exact.across;
    linear[1][1] = linear[2][2] = 1. - 0.3;
    shift[1]                    = 5. * (1. - exact.across); // the front stays at y = 5
    linear_stress[0][0]         = 200.;
    stress[0][0]                = exact.stress / (exact.across * exact.across);
    const double place          = std::max(run.deviation(0, linear), run.deviation(1, F, shift));
    const double cauchy =
      std::max(run.deviation(0, linear_stress), run.deviation(1, stress)) / 200.;
    const double energy =
      run.problem.state().strain_energy() - 0.5 * 200. -
      HyperelasticRegistry::make("neo-Hookean", run.scene.bodies[1].material)->energy(F);
    if (first_rank())
      std::cout << "linear and neo-Hookean: places " << small(place, 1e-10) << ", stresses "
                << small(cauchy, 1e-10) << ", energy " << small(energy, 1e-8) << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  Tensor<2, dim> rotation, deformation;
  rotation[0][1] = -1.;
  rotation[1][0] = rotation[2][2] = 1.;
  // 90 degrees about z; then a stretch and a shear on top.
  deformation                   = rotation;
  deformation[0][0]             = 0.3;
  deformation[2][2]             = 1.5;
  const std::string turn[dim]   = {"t*(-y - x)", "t*(x - y)", "0"};
  const std::string deform[dim] = {"t*(-y - 0.7*x)", "t*(x - y)", "t*0.5*z"};
  for (const std::string law : {"neo-Hookean", "St. Venant-Kirchhoff"})
    for (const auto &[element, degree] :
         {std::make_pair("automatic", "1"), {"full", "1"}, {"automatic", "2"}})
      {
        tension(law, element, degree);
        homogeneous("rotation", law, element, degree, turn, rotation);
        homogeneous("patch test", law, element, degree, deform, deformation);
      }
  for (const std::string law : {"neo-Hookean", "St. Venant-Kirchhoff"})
    {
      undeformed(law, "F-bar", "b-bar", "1");
      undeformed(law, "full", "full", "1");
      undeformed(law, "full", "full", "2");
    }
  mixed();
  return 0;
}

// SPDX-License-Identifier: LGPL-2.1-or-later
// Plastic bodies in load steps: a step that fails and is rolled back leaves no trace in the
// plastic strain; without recovery of the back stress or with it, with a solver for
// symmetric systems only, the same result; one step of ten times the size gives the same
// under proportional load; evaluating forces again and again changes nothing; the external
// work is elastic energy and plastic work. A law without an answer fails on all ranks, and the
// step can be cut.

#include <touchstone/base/non_convergence.h>
#include <touchstone/solid/hardening_law.h>

#include "drive_support.h"
#include <limits>

using namespace Touchstone;
using namespace dealii;

namespace
{
  std::vector<std::string>
  plastic(const std::string &law, const bool recovery)
  {
    const std::string        material = "Body block/Material/";
    std::vector<std::string> result   = {material + "Law=" + law,
                                         material + "Plasticity/Hardening=Voce",
                                         material + "Plasticity/Yield stress=3",
                                         material + "Plasticity/Saturation stress=6",
                                         material + "Plasticity/Saturation rate=20",
                                         material + "Plasticity/Kinematic modulus=60"};
    if (recovery)
      result.push_back(material + "Plasticity/Kinematic recovery=15");
    return result;
  }

  std::vector<double>
  plastic_strains(const Solid &solid)
  {
    const auto          strain = solid.cell_plastic_strain();
    std::vector<double> result;
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        result.push_back(strain(cell->active_cell_index()));
    return result;
  }

  struct Steps : public Run
  {
    std::vector<double> record;
    unsigned int        failures = 0;

    Steps(const std::vector<std::string> &overrides, const bool fail)
      : Run(blocks, overrides, MPI_COMM_WORLD)
    {
      constexpr double size = 0.125;
      for (unsigned int step = 0; step < 6; ++step)
        {
          if (fail)
            {
              NewtonParameters hasty   = scene.newton;
              hasty.maximum_iterations = 2;
              try
                {
                  solve(hasty, size * (step + 2));
                }
              catch (const NonConvergence &)
                {
                  ++failures;
                }
              problem.rollback();
            }
          solve(scene.newton, size * (step + 1));
          problem.commit();
          const auto &u = problem.state().displacement;
          record.insert(record.end(), u.begin(), u.end());
          const auto p = plastic_strains(solid);
          record.insert(record.end(), p.begin(), p.end());
          record.push_back(problem.state().strain_energy());
          record.push_back(solid.dissipation());
        }
    }
  };

  double
  distance(const std::vector<double> &a, const std::vector<double> &b)
  {
    double result = a.size() == b.size() ? 0. : 1.;
    for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
      result = std::max(result, std::abs(a[k] - b[k]));
    return Utilities::MPI::max(result, MPI_COMM_WORLD);
  }

  void
  cut_steps(const std::string &law, const bool recovery)
  {
    std::vector<std::string> overrides = plastic(law, recovery);
    const Steps              straight(overrides, false), failing(overrides, true);
    overrides.push_back("Linear solver/Type=Belos CG");
    const Steps  lagged(overrides, false);
    const double largest   = straight.solid.largest_plastic_strain().at(1),
                 cut       = distance(straight.record, failing.record),
                 symmetric = distance(straight.record, lagged.record);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        std::cout << law << (recovery ? ", recovery: " : ": ")
                  << (straight.solid.symmetric() ? "symmetric" : "unsymmetric")
                  << ", largest plastic strain " << largest << ", " << failing.failures
                  << " steps failed";
        print_agreement(cut, 1e-9);
        std::cout << "  with Belos CG";
        print_agreement(symmetric, 1e-6);
      }
  }

  // A bar under uniaxial stress.
  const std::string bar = R"(
set Bodies = bar
subsection Body bar
  set Symmetry = left, front, bottom
  set Boundary conditions = top
  subsection Geometry
    set Type         = box
    set Upper corner = 1, 1, 2
    set Cells        = 2, 2, 3
  end
  subsection Material
    set Young modulus = 1000
    set Poisson ratio = 0.3
    subsection Plasticity
      set Hardening         = linear
      set Yield stress      = 2
      set Hardening modulus = 20
    end
  end
  subsection Boundary top
    set Displacement z = -0.2 * t
  end
end
)";

  /** Hardening that has no number for more than a quarter of the plastic strain that the
   * bar gets in one step. */
  struct Fragile : public HardeningLaw
  {
    void
    declare(ParameterHandler &) override
    {
    }
    void
    check(const std::string &) const override
    {
    }
    YieldStress
    at(const double p) const override
    {
      return {p > 0.025 ? std::numeric_limits<double>::quiet_NaN() : 2. + 20. * p,
              20.,
              (2. + 10. * p) * p};
    }
  };
  const HardeningLawRegistry::Entry<Fragile> entry("fragile", "for this test.");

  void
  failure(const std::string &law)
  {
    // Without the keys of linear hardening.
    std::string text = bar;
    for (const std::string key : {"set Yield stress      = 2", "set Hardening modulus = 20"})
      text.erase(text.find(key), key.size());
    Run run(text,
            {"Body bar/Material/Law=" + law, "Body bar/Material/Plasticity/Hardening=fragile"},
            MPI_COMM_WORLD);
    Run whole(bar, {"Body bar/Material/Law=" + law}, MPI_COMM_WORLD);
    int failures = 0;
    run.solve(run.scene.newton, 0.1);
    run.problem.commit();
    try
      {
        run.solve(run.scene.newton, 1.);
      }
    catch (const MaterialFailure &)
      {
        ++failures;
      }
    run.problem.rollback();
    run.solve(run.scene.newton, 0.2);
    run.problem.commit();
    whole.solve(whole.scene.newton, 0.2);
    Touchstone::Vector difference(run.problem.state().displacement);
    difference -= whole.problem.state().displacement;
    const double d    = difference.linfty_norm();
    const int    seen = Utilities::MPI::sum(failures, MPI_COMM_WORLD);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        std::cout << law << ", a law without an answer: "
                  << (seen == static_cast<int>(Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD))
                        ? "failure on all ranks"
                        : "NO FAILURE on some rank")
                  << "; a smaller step";
        print_agreement(d, 1e-8);
      }
  }

  void
  large_step(const std::string &law)
  {
    const std::vector<std::string> overrides = {"Body bar/Material/Law=" + law};
    Run one(bar, overrides, MPI_COMM_WORLD), ten(bar, overrides, MPI_COMM_WORLD);
    one.solve(one.scene.newton, 1.);
    // The state is a function of the displacement: look at others in between.
    Touchstone::Vector force(one.problem.state().displacement), other(force);
    other *= 1.5;
    one.solid.internal_force(other, force);
    one.solid.internal_force(other, force);
    one.solid.strain_energy(other);
    one.solid.assemble(other);
    one.solid.internal_force(one.problem.state().displacement, force);
    one.problem.commit();
    double work = 0., before = 0.;
    for (unsigned int step = 1; step <= 10; ++step)
      {
        ten.solve(ten.scene.newton, 0.1 * step);
        ten.problem.commit();
        double now = 0.;
        for (const Reaction &reaction : ten.problem.state().reactions())
          if (reaction.boundary == "top")
            now = reaction.force[2];
        // Trapezoidal rule, but for the step in which the bar yields.
        if (step > 1)
          work -= 0.5 * (before + now) * 0.02;
        else
          work = ten.problem.state().strain_energy() + ten.solid.dissipation();
        before = now;
      }
    const double       energy = ten.problem.state().strain_energy() + ten.solid.dissipation();
    Touchstone::Vector difference(one.problem.state().displacement);
    difference -= ten.problem.state().displacement;
    const double p1  = one.solid.largest_plastic_strain().at(0),
                 p10 = ten.solid.largest_plastic_strain().at(0), d = difference.linfty_norm(),
                 w = one.solid.dissipation() / ten.solid.dissipation() - 1.;
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        std::cout << law << ", fifty times the yield strain in one step and in ten: plastic strain "
                  << p1 << ", work less energies "
                  << (std::abs(work / energy - 1.) < 2e-3 ? "small" : "LARGE");
        print_agreement(std::max({d, std::abs(p1 - p10), std::abs(w)}), 1e-8);
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string law : {"small-strain von Mises", "finite-strain von Mises"})
    {
      cut_steps(law, false);
      cut_steps(law, true);
      large_step(law);
      failure(law);
    }
  return 0;
}

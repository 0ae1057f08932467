// SPDX-License-Identifier: LGPL-2.1-or-later
// A step that fails leaves no trace: a scene with friction whose every step is first tried
// at twice its size, with too few Newton iterations, rolled back and then made in
// halves gives what those halves give alone, for each enforcement: displacements,
// forces, slip, friction work and status of each node. Rolled back, contact has the bits that it
// had before.

#include <touchstone/base/non_convergence.h>

#include "drive_support.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  /** Makes the steps; can fail at each of them first. */
  struct StepRun : public Run
  {
    /** Attempts that failed, and numbers at the end of all steps. */
    unsigned int        failures = 0;
    std::vector<double> record;
    /** Nothing of the attempts that failed was left. */
    bool         clean    = true;
    unsigned int slipping = 0, sticking = 0;

    StepRun(const std::vector<std::string> &overrides, const bool fail)
      : Run(blocks, overrides, MPI_COMM_WORLD)
    {
      constexpr double size = 0.25;
      for (unsigned int step = 0; step < 6; ++step)
        {
          if (fail)
            try_in_vain(size * (step + 2));
          solve(scene.newton, size * (step + 1));
          problem.commit();
          note();
        }
    }

    void
    try_in_vain(const double time)
    {
      const std::vector<double> before = figures();
      NewtonParameters          hasty  = scene.newton;
      hasty.maximum_iterations         = 2;
      try
        {
          solve(hasty, time);
        }
      catch (const NonConvergence &)
        {
          ++failures;
        }
      problem.rollback();
      clean = clean && figures() == before;
    }

    /** Displacements, and what contact has at each node. */
    std::vector<double>
    figures()
    {
      const auto         &u = problem.state().displacement;
      std::vector<double> result(u.begin(), u.end());
      for (const ContactPoint &point : contact_points(problem.state().contact, u))
        {
          for (unsigned int d = 0; d < dim; ++d)
            {
              result.push_back(point.traction[d] / 1000.);
              result.push_back(point.slip[d]);
            }
          result.insert(result.end(),
                        {point.pressure / 1000.,
                         point.gap,
                         point.slip_length,
                         point.friction_work,
                         static_cast<double>(point.status)});
        }
      return result;
    }

    /** Take note of the committed state. */
    void
    note()
    {
      const std::vector<double> now = figures();
      record.insert(record.end(), now.begin(), now.end());
      for (const ContactPoint &point :
           contact_points(problem.state().contact, problem.state().displacement))
        {
          slipping += (point.status == ContactStatus::slip);
          sticking += (point.status == ContactStatus::stick);
        }
    }
  };



  void
  compare(const std::vector<std::string> &overrides)
  {
    const StepRun halves(overrides, false), cut(overrides, true);
    double        difference = halves.record.size() == cut.record.size() ? 0. : 1.;
    for (std::size_t k = 0; k < std::min(halves.record.size(), cut.record.size()); ++k)
      difference = std::max(difference, std::abs(halves.record[k] - cut.record[k]));
    difference       = Utilities::MPI::max(difference, MPI_COMM_WORLD);
    const bool clean = Utilities::MPI::min(static_cast<int>(cut.clean), MPI_COMM_WORLD) == 1;
    const bool both  = Utilities::MPI::sum(halves.slipping, MPI_COMM_WORLD) > 10 &&
                      Utilities::MPI::sum(halves.sticking, MPI_COMM_WORLD) > 10;
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        for (const std::string &text : overrides)
          std::cout << text.substr(text.find('=') + 1) << ", ";
        std::cout << cut.failures << " steps failed, slip and stick: " << (both ? "yes" : "NO")
                  << ", rolled back to the bit: " << (clean ? "yes" : "NO");
        print_agreement(difference, 1e-9);
      }
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string                pairing = "Contact pair contact/Pairing=";
  for (const std::string enforcement :
       {"elimination", "lagrange multipliers", "augmented lagrange", "penalty"})
    // A step that is tried again starts from another guess: what is converged must not show it.
    compare({"Contact/Enforcement=" + enforcement,
             pairing + "pointwise",
             "Newton/Residual tolerance=1e-12",
             "Newton/Gap tolerance=1e-10"});
  compare(
    {"Contact/Enforcement=elimination", pairing + "pointwise", "Contact/Friction=regularised"});
  compare({"Contact/Enforcement=elimination", pairing + "averaged"});
  compare(
    {"Contact/Enforcement=elimination", pairing + "pointwise", "Linear solver/Type=Belos CG"});
  return 0;
}

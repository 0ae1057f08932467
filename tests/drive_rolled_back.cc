// SPDX-License-Identifier: LGPL-2.1-or-later
// Rolled back, a step leaves nothing: after it results are those before, to the last bit, and the
// steps that follow are those that follow without it. Of each part with history a scene: contact
// and friction, points inside slave faces, plasticity, an obstacle that a force moves, pretension;
// and of explicit dynamics, where a signal or an error ends an interval: contact, damping,
// plasticity, general contact, an obstacle that moves freely; not springs of contact.

#include <touchstone/base/non_convergence.h>
#include <touchstone/drive/step.h>

#include "drive_support.h"
#include <fstream>
#include <sstream>

using namespace Touchstone;
using namespace dealii;

namespace
{
  std::string
  scene_file(const std::string &name)
  {
    std::ifstream      in(SOURCE_DIR "/" + name + ".prm");
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }



  /** All that is written of the present state, on this rank. */
  std::vector<double>
  figures(const StepState &state)
  {
    const auto         &u = state.displacement;
    std::vector<double> result(u.begin(), u.end());
    for (const ContactPoint &point : contact_points(state.contact, u))
      {
        for (unsigned int d = 0; d < dim; ++d)
          {
            result.push_back(point.traction[d]);
            result.push_back(point.slip[d]);
          }
        result.insert(result.end(),
                      {point.pressure,
                       point.gap,
                       point.slip_length,
                       point.friction_work,
                       static_cast<double>(point.status)});
      }
    for (unsigned int p = 0; p < state.contact.n_pairs(); ++p)
      if (state.contact.pair(p).takes_points())
        for (const MaterialPoint &point : state.contact.pair(p).points())
          result.insert(result.end(), {point.xi[0], point.xi[1], point.depth});
    const auto plastic = state.solid.cell_plastic_strain();
    result.insert(result.end(), plastic.begin(), plastic.end());
    result.push_back(state.solid.dissipation());
    for (const auto &[name, cut] : state.pretension)
      result.insert(result.end(), {cut.first, cut.second});
    for (const auto &[name, tool] : state.tools)
      for (unsigned int d = 0; d < dim; ++d)
        result.insert(result.end(), {tool.displacement[d], tool.rotation[d], tool.force[d]});
    return result;
  }



  double
  distance(const std::vector<double> &a, const std::vector<double> &b)
  {
    double result = a.size() == b.size() ? 0. : 1.;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
      result = std::max(result, std::abs(a[i] - b[i]));
    return result;
  }



  /** Steps to @p times but the last, then one that is taken back, and the last. */
  void
  test(const std::string              &name,
       const std::string              &text,
       const std::vector<double>      &times,
       const double                    in_vain,
       const std::vector<std::string> &overrides = {})
  {
    std::vector<std::vector<double>> ends;
    bool                             clean = true, moved = false;
    for (const bool fails : {false, true})
      {
        Run run(text, overrides, MPI_COMM_WORLD);
        for (const double time : times)
          {
            if (fails && time == times.back())
              {
                const std::vector<double> before = figures(run.problem.state());
                try
                  {
                    run.solve(run.scene.newton, in_vain);
                  }
                catch (const NonConvergence &)
                  {
                  }
                moved = distance(figures(run.problem.state()), before) > 0.;
                run.problem.rollback();
                clean = figures(run.problem.state()) == before;
              }
            run.solve(run.scene.newton, time);
            run.problem.commit();
          }
        ends.push_back(figures(run.problem.state()));
      }
    const double difference = Utilities::MPI::max(distance(ends[0], ends[1]), MPI_COMM_WORLD);
    clean                   = Utilities::MPI::min(clean ? 1 : 0, MPI_COMM_WORLD) == 1;
    moved                   = Utilities::MPI::max(moved ? 1 : 0, MPI_COMM_WORLD) == 1;
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        std::cout << name << ": " << (moved ? "" : "NOT MOVED, ")
                  << "rolled back to the bit: " << (clean ? "yes" : "NO");
        print_agreement(difference, 1e-6);
      }
  }



  /** The same of output intervals, of which a checkpoint has what is not written of the state. */
  void
  test_explicit(const std::string              &name,
                const std::string              &text,
                const std::vector<double>      &times,
                const double                    in_vain,
                const std::vector<std::string> &overrides)
  {
    std::vector<std::vector<double>> ends;
    for (const bool fails : {false, true})
      {
        std::vector<std::string> all = overrides;
        all.push_back("Time integration/Scheme=central_differences");
        const Scene  scene(text, "scene.prm", all);
        const Forest forest(scene.forest_input(), "", MPI_COMM_WORLD);
        Solid        solid(scene.bodies, scene.discretisation.degree, forest, MPI_COMM_WORLD);
        TimerOutput  timer(std::cout, TimerOutput::never, TimerOutput::wall_times);
        const std::unique_ptr<Step> step = Step::make(scene, forest, solid, timer);
        const auto                  go   = [&](const double time) {
          step->solve(time, scene.newton, [](unsigned int, const NewtonState &, int) {});
        };
        step->start();
        for (const double time : times)
          {
            if (fails && time == times.back())
              go(in_vain);
            // Of the other run nothing is taken back but bounds of the stable step.
            if (time == times.back())
              step->rollback();
            go(time);
            step->try_commit(0.);
          }
        const StepState     state = step->state();
        const Energies     &of    = state.time_integration.committed_energies();
        std::vector<double> end   = figures(state);
        for (const auto *const rate : state.time_integration.rates())
          end.insert(end.end(), rate->begin(), rate->end());
        for (const Reaction &reaction : state.reactions())
          for (unsigned int d = 0; d < dim; ++d)
            end.push_back(reaction.force[d]);
        end.insert(end.end(),
                   {of.kinetic,
                    of.strain,
                    of.plastic,
                    of.contact,
                    of.friction,
                    of.damping,
                    of.external,
                    of.viscous});
        ends.push_back(end);
      }
    const double difference = Utilities::MPI::max(distance(ends[0], ends[1]), MPI_COMM_WORLD);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        std::cout << "explicit, " << name;
        print_agreement(difference, std::numeric_limits<double>::min());
      }
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test("friction", blocks, {0.5, 1., 1.25}, 1.75);
  test("yielding",
       blocks,
       {0.5, 1., 1.25},
       1.75,
       {"Body block/Material/Law=small-strain von Mises",
        "Body block/Material/Plasticity/Hardening=linear",
        "Body block/Material/Plasticity/Yield stress=5",
        "Body block/Material/Plasticity/Hardening modulus=50"});
  test("points", scene_file("small_obstacle_in_face"), {0.5, 0.75}, 1.);
  test("moved by a force", scene_file("pressed_sphere"), {0.5, 0.75}, 1.);
  test("pretension", scene_file("bolted_pretension"), {0.5, 0.75}, 1.);

  const std::vector<std::string> moving = {"Body base/Material/Density=1",
                                           "Body block/Material/Density=1"};
  const auto                     with   = [&moving](std::vector<std::string> settings) {
    settings.insert(settings.end(), moving.begin(), moving.end());
    return settings;
  };
  const std::vector<double> times = {0.5, 0.75, 1.};
  test_explicit("impulses", blocks, times, 1.1, moving);
  test_explicit("damping", blocks, times, 1.1, with({"Body base/Material/Rayleigh mass=1"}));
  // Initial displacements make the block yield: what is lost is in the initial energy, but for what
  // the shock takes in long cycles.
  test_explicit("yielding",
                blocks,
                times,
                1.1,
                with({"Time integration/Courant factor=0.1",
                      "Body block/Material/Law=finite-strain von Mises",
                      "Body block/Material/Plasticity/Hardening=linear",
                      "Body block/Material/Plasticity/Yield stress=5",
                      "Body block/Material/Plasticity/Hardening modulus=50"}));
  test_explicit("general contact",
                blocks.substr(0, blocks.find("subsection Contact pair")),
                times,
                1.1,
                with({"Contact pairs=all"}));
  test_explicit("obstacle", scene_file("checks/falling_plate"), {0.01, 0.02}, 0.025, {});
  return 0;
}

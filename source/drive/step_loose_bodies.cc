// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/non_convergence.h>
#include <touchstone/contact/pressing_rows.h>
#include <touchstone/drive/step_problem.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

// What becomes in a static step of bodies that contact alone holds (doc/theory.md 9).
namespace Touchstone
{
  using namespace dealii;

  std::vector<unsigned int>
  StepProblem::active_rows() const
  {
    // Each row lives on the rank that owns its slave node: summed over the ranks.
    std::vector<unsigned int> result(contact.n_pairs(), 0);
    for (const ContactRow &row : contact.rows())
      result[row.pair] += contact.state(row).active();
    Utilities::MPI::sum(result, solid.communicator, result);
    return result;
  }



  std::vector<unsigned int>
  StepProblem::holding_rows() const
  {
    std::vector<unsigned int> result(contact.n_pairs(), 0);
    const PressingRows        pressing(contact);
    // Where all forces of the state are round-off none of them holds anything.
    const bool forces = force_scale > 0.;
    for (const ContactRow &row : contact.rows())
      result[row.pair] +=
        contact.state(row).active() && (row.tied || (forces && pressing.contain(row)));
    Utilities::MPI::sum(result, solid.communicator, result);
    return result;
  }



  void
  StepProblem::remember_contact()
  {
    committed_active = active_rows();
  }



  std::vector<std::string>
  StepProblem::check_loose_bodies() const
  {
    std::vector<std::string> result;
    // With inertia a body in free flight is a solution; without it has no equilibrium, or an
    // arbitrary one.
    if (integration->dynamic() || system->loose_bodies().empty())
      return result;

    // Upper bound for a credible motion in a step: in statics a body that has lost all contact was
    // pushed by supports or obstacles that move, and cannot have followed them much farther than
    // they moved; the size of a face is added for what contact and elasticity do. A body that has
    // gone beyond that was thrown off by Newton's method, through a nearly singular system.
    double     pushed = 0., size = 0.;
    const auto now    = boundary_conditions.displacements(time);
    const auto before = boundary_conditions.displacements(committed_time);
    for (std::size_t k = 0; k < now.size(); ++k)
      pushed = std::max(pushed, std::abs(now[k].value - before[k].value));
    for (const ContactRow &row : contact.rows())
      {
        size = std::max(size, row.size);
        pushed =
          std::max(pushed,
                   row.motion.since(contact.committed(row).motion, contact_point(row)).norm());
      }
    pushed             = Utilities::MPI::max(pushed, solid.communicator);
    size               = Utilities::MPI::max(size, solid.communicator);
    const double limit = size + 10. * pushed;

    const std::vector<unsigned int> active = active_rows(), holding = holding_rows();
    for (const auto &[b, moved] : largest_motions(system->loose_bodies(), solid, committed_u, u))
      {
        const std::string &name    = scene.bodies[b].name;
        unsigned int       touches = 0, touched = 0, holds = 0;
        for (unsigned int p = 0; p < scene.pairs.size(); ++p)
          if (scene.pairs[p].slave_body == name || scene.pairs[p].master_body == name)
            {
              touches += active[p];
              holds += holding[p];
              touched += committed_active[p];
            }
        if (touches > 0 && strayed.farthest(b) > moved + limit)
          {
            const std::string text = "body '" + name + "' " + strayed.in_words(b, pushed);
            // Only where another attempt does not cost a cut: the state is a balance, after all.
            if (strayed.first_attempt() && !next_attempt().empty())
              throw StrayedBody(text);
            result.push_back(
              text + ": where it is now may be another balance than that next to the start");
          }
        // Only bodies that had contact at the beginning of the step and have none now. The last
        // thing that a body touches which has been thrown off may carry round-off.
        if (holds > 0 || touched == 0)
          continue;
        if (moved > limit)
          {
            char text[200];
            std::snprintf(text,
                          sizeof(text),
                          "' was thrown off what it touched, by %.3g: nothing else holds it, and "
                          "nothing has pushed it that far",
                          moved);
            throw LostContact("body '" + name + text);
          }
        // Wedges push bodies farther than they move themselves, but seldom: made again, once.
        if (moved > size + 2. * pushed && strayed.first_attempt())
          throw StrayedBody("body '" + name + "', which has lost all contact, " +
                            strayed.in_words(b, pushed));
        if (touches > 0)
          continue;
        result.push_back("body '" + name +
                         "' has lost all contact, and nothing else holds it: statics does not "
                         "know where it goes");
      }
    return result;
  }
} // namespace Touchstone

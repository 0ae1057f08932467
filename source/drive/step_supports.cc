// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/base/reduction.h>
#include <touchstone/contact/enforcement/row_terms.h>
#include <touchstone/drive/step_system.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

// What holds the bodies in a static step, and what is done about motions that nothing holds
// (doc/theory.md 9).
namespace Touchstone
{
  using namespace dealii;

  // Only supports count here. A body that they leave free and that takes part in no contact pair
  // can never be held: an input error (doc/theory.md 9).
  void
  StepSystem::check_bodies_without_support(const Vector &u)
  {
    prescribe(0., u);
    std::vector<Condition>       held    = graph.accepted();
    const std::vector<Condition> springs = parts.boundary_conditions.ground_springs().conditions();
    held.insert(held.end(), springs.begin(), springs.end());
    left_free = modes.free_motion(held);
    for (const unsigned int body : left_free.bodies)
      {
        const std::string &name  = parts.scene.bodies[body].name;
        bool               meets = false;
        for (const ContactPairParameters &pair : parts.scene.pairs)
          meets = meets || pair.slave_body == name || pair.master_body == name;
        if (!meets)
          throw InputError("Body " + name,
                           "Fixed",
                           "",
                           "nothing holds the bodies in place: " + left_free.description,
                           "add to 'Fixed' or 'Symmetry', prescribe a displacement, or define a "
                           "contact pair.");
      }
    check_parts(held);
  }



  void
  StepSystem::hold_loosely_held(const State &state, std::vector<Condition> holding)
  {
    if (!state.springs.attached())
      return;
    // Where there is friction it decides, even if it leaves a motion free.
    std::vector<int> with_friction(parts.solid.n_bodies());
    bool             pressed = false;
    for (const ContactRow &row : parts.contact.rows())
      if (parts.contact.state(row).active())
        {
          pressed = true;
          if (row.friction || row.tied)
            {
              with_friction[row.body] = 1;
              if (!row.on_obstacle())
                with_friction[row.master_body] = 1;
            }
        }
    Utilities::MPI::max(with_friction, parts.solid.communicator, with_friction);
    for (unsigned int body = 0; body < with_friction.size(); ++body)
      if (with_friction[body] == 1)
        {
          const std::vector<Condition> fixed = modes.all_motions(body);
          holding.insert(holding.end(), fixed.begin(), fixed.end());
        }
    // Facets that strain has tilted against each other resist a motion along them a little.
    constexpr double little = 1e-3;
    state.springs.act_on(everywhere(!pressed) ? FreeMotion() : modes.free_motion(holding, little));
    if (state.springs.act())
      system->diagonal_shift = state.springs.stiffness();
  }



  // Bodies held by contact alone (doc/theory.md 9): where the accepted conditions leave rigid
  // motions free, a diagonal shift on these bodies keeps the increment finite. It is not in the
  // residual, so the equilibrium does not depend on it.
  void
  StepSystem::check_supports(const State &state)
  {
    std::vector<Condition> supports = parts.boundary_conditions.ground_springs().conditions();
    for (const std::vector<Condition> *conditions : {&graph.accepted(), &graph.met_by_springs()})
      supports.insert(supports.end(), conditions->begin(), conditions->end());
    for (const ContactRow &row : parts.contact.rows())
      {
        const auto springs = elastic_stick(row, parts.contact.state(row));
        // Springs of stick hold a body against sliding although they impose no condition.
        supports.insert(supports.end(), springs.begin(), springs.end());
      }
    hold_loosely_held(state, supports);
    const FreeMotion motion = modes.free_motion(supports);
    holding.clear();
    if (motion.n_modes == 0)
      return;
    holding = std::move(supports);
    // The shift is chosen by the distance that a body may move in one iteration. Before contact:
    // about the smallest open gap, so that the body does not pass through the surface that will
    // hold it. In contact the body can still slide: there the shift must outweigh the geometric
    // stiffness of the contact forces, relative to the stiffness about pressure over Young's
    // modulus, where the tangent lacks it; otherwise the iterates would oscillate about the
    // equilibrium. A consistent tangent has it: the shift vanishes with the residual, slowly enough
    // for motions that nothing resists, whose residual is of second order.
    double        distance = std::numeric_limits<double>::max();
    double        size     = 0.;
    std::uint64_t active   = 0;
    for (const ContactRow &row : parts.contact.rows())
      if (row.has_partner)
        {
          const bool is_active = parts.contact.state(row).active();
          size                 = std::max(size, row.size);
          active += is_active;
          if (!is_active && row.gap > 0.)
            distance = std::min(distance, row.gap);
        }
    distance = -distance; // its minimum
    Reduction all;
    all.max(distance);
    all.max(size);
    all.sum(active);
    all.over(parts.solid.communicator);
    distance = -distance;
    // No row has a partner yet.
    if (size == 0.)
      size = length;
    constexpr double before_contact = 1e-7, in_contact = 1e-3;
    double           smallest;
    if (active == 0)
      {
        distance = std::clamp(1.01 * distance, 1e-3 * size, size);
        smallest = before_contact;
      }
    else if (consistent(state))
      {
        distance = 1e-2 * size;
        smallest = std::clamp(in_contact * std::sqrt(state.residual), before_contact, in_contact);
      }
    else
      {
        distance = 1e-3 * size;
        smallest = in_contact;
      }
    const Vector shift = modes.stabilisation(motion, state.unbalanced, distance, smallest);
    if (system->diagonal_shift.size() == 0)
      system->diagonal_shift = shift;
    else
      system->diagonal_shift += shift;
    free_motions = motion.description;
    loose.insert(motion.bodies.begin(), motion.bodies.end());
  }



  FreeMotion
  StepSystem::undetermined_motion() const
  {
    // The same on all ranks but where the conditions are.
    if (everywhere(holding.empty()))
      return FreeMotion();
    std::vector<Condition> resisting(holding);
    for (const ContactRow &row : parts.contact.rows())
      {
        const auto directions = along_surface(row, parts.contact.state(row));
        resisting.insert(resisting.end(), directions.begin(), directions.end());
      }
    return modes.free_motion(resisting);
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact.h>
#include <touchstone/contact/enforcement/refused_conditions.h>
#include <touchstone/contact/velocity_constraints.h>

#include <array>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The motion of an obstacle towards the end of a step. */
    struct LastMotions
    {
      LastMotions(const Pairing &pairing, const double time, const double step)
        : span(0.01 * step)
      {
        for (unsigned int k = 0; k < motions.size(); ++k)
          motions[k] = pairing.motion(time - k * span);
      }

      double                     span;
      std::array<RigidMotion, 4> motions;

      /** Velocity and acceleration of its point at @p x: one-sided differences of second order, as
       * the motion may change at once when the step ends. Of the whole step means would do for the
       * velocity of a steady motion; of one that accelerates they lag behind by half a step, which
       * Newmark's formulas pay back with a multiple of the acceleration. */
      std::array<Tensor<1, dim>, 2>
      rates(const Point<dim> &x) const
      {
        std::array<Tensor<1, dim>, 4> since;
        for (unsigned int k = 1; k < motions.size(); ++k)
          // What has been turned and stands still would move by round-off.
          if (motions[k].shift != motions[0].shift || motions[k].turn != motions[0].turn)
            since[k] = motions[0].since(motions[k], x);
        return {{(4. * since[1] - since[2]) / (2. * span),
                 (5. * since[1] - 4. * since[2] + since[3]) / (span * span)}};
      }
    };
  } // namespace



  // At an impact without rebound the relative velocity of active nodes vanishes along the normal,
  // and along the surface where they stick. The graph starts from the supports and leaves out
  // conditions that they or earlier rows determine, which would make the impulses non-unique, but
  // for those that other nodes of the row have to meet, as where the slave node is driven.
  std::vector<VelocityConstraint>
  velocity_constraints(const Contact         &contact,
                       const ConstraintGraph &supports,
                       const double           time,
                       const double           step)
  {
    std::vector<LastMotions> obstacles;
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      obstacles.emplace_back(contact.pair(p).pairing(), time, step);
    ConstraintGraph                 graph(supports);
    RefusedConditions               refused(graph);
    std::vector<VelocityConstraint> of_refused;
    std::vector<VelocityConstraint> result;
    for (const ContactRow &row : contact.rows())
      {
        const RowState &state = contact.state(row);
        // A row without compression presses on nothing, so that its velocity is free.
        if (!state.active() || state.redundant || !(state.lambda > 0. || row.tied))
          continue;
        // An obstacle imposes its own motion; a master body moves with its nodes.
        const auto [velocity, acceleration] = obstacles[row.pair].rates(contact_point(row));
        VelocityConstraint constraint{{}, 0., row.share * velocity, true, row.index};
        constraint.condition.node    = row.slave;
        constraint.condition.stencil = row.stencil;
        const auto offer = [&](const Tensor<1, dim> &direction, const Tensor<1, dim> &force) {
          constraint.condition.direction       = direction;
          constraint.condition.force_direction = force;
          constraint.condition.value           = direction * constraint.of_obstacle;
          constraint.acceleration              = row.share * (direction * acceleration);
          if (graph.accept(constraint.condition, ConstraintGraph::Treatment::multiplier))
            result.push_back(constraint);
          else if (constraint.normal)
            {
              refused.add(row, constraint.condition);
              of_refused.push_back(constraint);
            }
        };
        const Tensor<1, dim> along_direction;
        if (row.tied)
          for (unsigned int d = 0; d < dim; ++d)
            offer(Point<dim>::unit_vector(d), along_direction);
        else
          {
            // In slip the friction impulse is proportional to the normal impulse: both act along
            // the present contact force, scaled to a unit normal component.
            const bool slides = state.status == ContactStatus::slip && row.friction;
            offer(row.normal, slides ? state.force / state.lambda : along_direction);
            constraint.normal = false;
            if (state.status == ContactStatus::stick)
              for (const Tensor<1, dim> &tangent : row.friction->kinematics.frame)
                offer(tangent, along_direction);
          }
      }
    const std::vector<bool> can_be_met =
      refused.can_be_met(graph, contact.solid_model().owned, contact.communicator());
    for (std::size_t k = 0; k < of_refused.size(); ++k)
      if (can_be_met[k])
        result.push_back(of_refused[k]);
    return result;
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/impulse_contact.h>
#include <touchstone/explicit/infeasible_contact.h>

#include <algorithm>
#include <cmath>
#include <tuple>

// Contact of explicit dynamics by springs (doc/explicit.md, section 9.3): forces follow from the
// gaps at the start of a cycle and act on the velocities like those of the bodies.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Bodies that are this deep within each other, relative to the size of a face, pass through
     * each other. */
    constexpr double too_deep = 0.5;
  } // namespace



  double
  ImpulseContact::square_frequency(const NodeField &u, const double time, const double step)
  {
    // Springs of the size f m / h^2 leave the step as it is.
    if (rule.method != ImpulseRule::Method::bulk_springs)
      return 0.;
    start_interval(u, time, step);
    for (unsigned int node = 0; node < local.size(); ++node)
      u_nodes[node] = u[local[node]];
    solver.nodes.forward(u_nodes);
    set_geometry(time, step);
    mobilities    = solver.mobilities();
    double square = 0.;
    for (std::size_t k = 0; k < kept.size(); ++k)
      {
        const double present = springs[contact.rows()[kept[k].index]].stiffness;
        square =
          std::max(square,
                   (present > 0. ? present : stiffness(k, step)) *
                     std::max(mobilities[k][0], parameters.tangential_factor * mobilities[k][1]));
      }
    return Utilities::MPI::max(square, nodes.communicator());
  }



  std::pair<double, double>
  ImpulseContact::stiffness_of_sides(const ImpulseRow &row) const
  {
    double sums[2] = {0., 0.}, weights[2] = {0., 0.};
    for (unsigned int i = 0; i < row.n_nodes; ++i)
      {
        const std::size_t s     = solver.slot(row, i);
        const double      value = stiffness_of_nodes[solver.nodes.node(s)],
                     part       = std::abs(solver.weights[s]);
        const unsigned int side = solver.weights[s] > 0. ? 0 : 1;
        if (value > 0.)
          {
            sums[side] += part * value;
            weights[side] += part;
          }
      }
    return {weights[0] > 0. ? sums[0] / weights[0] : 0.,
            weights[1] > 0. ? sums[1] / weights[1] : 0.};
  }



  double
  ImpulseContact::stiffness(const std::size_t k, const double step) const
  {
    const ImpulseRow &row = solver.rows[k];
    if (rule.method == ImpulseRule::Method::mass_springs)
      return mobilities[k][0] > 0. ? rule.factor / (mobilities[k][0] * step * step) : 0.;
    // K A / V of the softer side.
    const std::size_t own   = row.first;
    double            slave = 0., master = 0.;
    if (contact.rows()[kept[k].index].get().between_nodes)
      // Means over those nodes of either side that lie on its surface.
      std::tie(slave, master) = stiffness_of_sides(row);
    else
      for (unsigned int i = 0; i < row.n_nodes; ++i)
        {
          const std::size_t s     = solver.slot(row, i);
          const double      value = stiffness_of_nodes[solver.nodes.node(s)];
          if (s == own)
            slave = value;
          else
            master -= solver.weights[s] * value;
        }
    return rule.factor * row.area *
           (row.n_nodes > 1 && master > 0. ? std::min(slave, master) : slave);
  }



  ImpulseCounts
  ImpulseContact::push(const double time, const double step, const double acting)
  {
    // Masses, and which rows share them, decide how stiff springs may be.
    if (rule.method == ImpulseRule::Method::mass_springs)
      {
        int some = 0;
        for (std::size_t k = 0; k < kept.size(); ++k)
          some |= kept[k].at_start < 0. || solver.rows[k].tied;
        if (Utilities::MPI::max(some, nodes.communicator()) > 0)
          mobilities = solver.mobilities();
      }
    unsigned int deep = contact.n_pairs();
    for (std::size_t k = 0; k < kept.size(); ++k)
      {
        push_row(k, time, step, acting);
        const ContactRow &row = contact.rows()[kept[k].index];
        if (!row.tied && kept[k].at_start < -too_deep * row.size)
          deep = std::min(deep, row.pair);
      }
    deep = Utilities::MPI::min(deep, nodes.communicator());
    if (deep < contact.n_pairs())
      throw SoftContact(contact.pair(deep).parameters(), time);
    return solver.apply_given();
  }



  // The stiffness of a spring is that of when it closed: one that changes would do work. Only a
  // spring that would be too stiff for the present masses and step becomes softer.
  void
  ImpulseContact::push_row(const std::size_t k,
                           const double      time,
                           const double      step,
                           const double      acting)
  {
    ImpulseRow       &row    = solver.rows[k];
    RowHistory       &h      = history[kept[k].index];
    const ContactRow &of     = contact.rows()[kept[k].index];
    ImpulseSpring    &spring = springs[of];
    row.impulse              = Tensor<1, dim>();
    h.energy.stored          = 0.;
    const double before      = spring.stiffness * spring.gap * spring.gap;
    if (row.tied || kept[k].at_start < 0.)
      {
        const bool by_mass = rule.method == ImpulseRule::Method::mass_springs;
        if (!(spring.stiffness > 0.))
          spring.stiffness = stiffness(k, step);
        else if (by_mass)
          spring.stiffness = std::min(spring.stiffness, stiffness(k, step));
      }
    if (row.tied)
      {
        // row.allowed is the gap vector over the step.
        row.impulse = -spring.stiffness * step * acting * row.allowed;
        return;
      }
    const double gap = std::min(0., kept[k].at_start);
    // A gap that is another one since partners, weights or normals are, or one that bodies begin
    // with: the energy of the spring comes from outside.
    if (fresh)
      {
        const double supplied = 0.5 * (spring.stiffness * gap * gap - before);
        h.energy.obstacles += supplied;
        h.energy.normal -= supplied;
      }
    if (gap == 0.)
      {
        spring    = ImpulseSpring();
        h.sliding = row.sliding = false;
        return;
      }
    spring.gap         = gap;
    const double force = -spring.stiffness * gap;
    row.impulse        = force * acting * row.normal;
    if (row.friction)
      {
        push_friction(k, force, time, step);
        row.impulse += acting * spring.traction;
      }
  }



  // Elastic slip: a tangential spring whose force the law limits; the rest of the slip is
  // irreversible.
  void
  ImpulseContact::push_friction(const std::size_t k,
                                const double      normal_force,
                                const double      time,
                                const double      step)
  {
    ImpulseRow          &row       = solver.rows[k];
    RowHistory          &h         = history[kept[k].index];
    ImpulseSpring       &spring    = springs[contact.rows()[kept[k].index]];
    const double         stiffness = parameters.tangential_factor * spring.stiffness;
    const Tensor<1, dim> trial     = row.tangential * spring.traction;
    const double         size      = trial.norm();
    const auto           limit     = [&](const bool sliding, const double slip) {
      FrictionInput input;
      input.normal_force = normal_force;
      input.area         = row.area;
      input.slip_length  = row.slip_length + slip;
      input.slip_rate    = slip / step;
      input.time         = time;
      input.sliding      = sliding;
      return row.friction->law->limit(input).force;
    };
    row.sliding    = size > limit(row.sliding, 0.);
    double radius  = limit(row.sliding, 0.);
    double slipped = 0.;
    if (row.sliding)
      {
        // The law at the end of the slip; it changes little over the slip of a cycle.
        slipped = std::max(0., size - radius) / stiffness;
        radius  = std::min(size, limit(true, slipped));
        slipped = (size - radius) / stiffness;
      }
    spring.traction = size > radius ? (radius / size) * trial : trial;
    if (slipped > 0.)
      {
        h.slip -= (slipped / size) * trial;
        h.path += slipped;
        h.friction_work += radius * slipped;
        h.slipped = true;
      }
  }



  void
  ImpulseContact::keep_springs(const double step)
  {
    for (std::size_t k = 0; k < kept.size(); ++k)
      {
        const ImpulseRow &row    = solver.rows[k];
        ImpulseSpring    &spring = springs[contact.rows()[kept[k].index]];
        RowHistory       &h      = history[kept[k].index];
        if (row.tied || spring.stiffness == 0.)
          continue;
        const double gap = std::min(0., spring.gap + step * (row.velocity * row.normal));
        // With it the energy of a spring that stays closed is what it has taken to the last bits.
        h.energy.stored = 0.5 * spring.stiffness * spring.gap * gap;
        spring.gap      = gap;
        if (row.friction)
          spring.traction -= (parameters.tangential_factor * spring.stiffness * step) *
                             (row.tangential * row.velocity);
      }
  }
} // namespace Touchstone

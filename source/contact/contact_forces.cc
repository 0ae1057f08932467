// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

// Forces of all rows as nodal forces, the work that they do from outside, and impulses.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The force of a row along its present normal, or what is left of it, which is friction (and
     * shear of tied rows). */
    Tensor<1, dim>
    part_of_force(const ContactRow &row, const RowState &state, const ForcePart part)
    {
      const Tensor<1, dim> normal = (state.force * row.normal) * row.normal;
      switch (part)
        {
          case ForcePart::normal:
            return normal;
          case ForcePart::tangential:
            return state.force - normal;
          default:
            return state.force;
        }
    }
  } // namespace



  void
  Contact::add_forces(Vector &force, const ForcePart part) const
  {
    std::vector<Index>  dofs;
    std::vector<double> values;
    for (const ContactRow &row : all_rows)
      if (state(row).active())
        {
          // Nodal forces M^T f: f on the slave node and -w_m f on the master nodes, so that action
          // equals reaction (doc/theory.md 3). Master nodes may belong to other ranks, hence
          // compress().
          const Tensor<1, dim> f = part_of_force(row, state(row), part);
          for (unsigned int d = 0; d < dim; ++d)
            if (f[d] != 0.)
              {
                dofs.push_back(dim * row.slave + d);
                values.push_back(f[d]);
                for (const StencilEntry &entry : row.stencil)
                  {
                    dofs.push_back(dim * entry.node + d);
                    values.push_back(-entry.weight * f[d]);
                  }
              }
        }
    force.add(dofs, values);
    force.compress(VectorOperation::add);
    solid.condense(force); // master nodes can hang
  }



  template <class OfRow>
  auto
  Contact::over_step(const ContactRow &row, const double weight, const OfRow &of) const
  {
    auto result = decltype(of(row, state(row)))();
    if (state(row).active())
      result += weight * of(row, state(row));
    if (RowState before = method->states().of_committed(row); weight != 1. && before.active())
      {
        before.force += impulse_forces.of_committed(row).at_start;
        result += (1. - weight) * of(committed(row), before);
      }
    return result;
  }



  // An obstacle is rigid and driven from outside: the work that it does on the slave body enters
  // the energy balance of dynamics, whereas contact of two bodies does no work from outside.
  double
  Contact::work_of_obstacles(const ForcePart part, const double weight) const
  {
    double work = 0.;
    for (const ContactRow &row : all_rows)
      {
        const Tensor<1, dim> force =
          over_step(row, weight, [part](const ContactRow &at, const RowState &of) {
            return part_of_force(at, of, part);
          });
        if (force.norm_square() > 0.)
          work += row.share * force * row.motion.since(committed(row).motion, contact_point(row));
      }
    return Utilities::MPI::sum(work, solid.communicator);
  }



  double
  Contact::work_of_overlaps(const double weight, const double from) const
  {
    double work = 0.;
    for (const ContactRow &row : all_rows)
      {
        const ContactPair &of   = pair(row);
        const std::size_t  k    = &row - of.rows().data();
        const double       gone = of.entered_overlap(k, from);
        if (gone != 0.)
          work -= gone * over_step(row, weight, [](const ContactRow &at, const RowState &of) {
                    return part_of_force(at, of, ForcePart::normal) * at.normal;
                  });
      }
    return Utilities::MPI::sum(work, solid.communicator);
  }



  // Gaps are taken to change linearly over the step. Used to cut a step of dynamics at the first
  // impact; only rows that were open when it began can have one.
  double
  Contact::part_to_touch() const
  {
    double part = 1.;
    for (const ContactRow &row : all_rows)
      {
        const double before = committed(row).gap;
        if (method->states().of_committed(row).status == ContactStatus::open && row.has_partner &&
            before > 0. && row.gap < 0.)
          part = std::min(part, before / (before - row.gap));
      }
    return Utilities::MPI::min(part, solid.communicator);
  }



  void
  Contact::keep_impulses(const std::vector<VelocityConstraint> *const constraints,
                         const double                                 step,
                         const double                                 end_weight)
  {
    std::vector<Tensor<1, dim>> impulses(pairs.size());
    if (constraints != nullptr)
      for (const VelocityConstraint &constraint : *constraints)
        {
          // The impulse is taken from the velocity, see Impact, so the force on the slave node is
          // opposite; divided by the step it is the mean force of the impact. What the force at the
          // end of the step was too large by has acted with its weight.
          const ContactRow    &row     = all_rows[constraint.row];
          ImpulseForce        &of_row  = impulse_forces[row];
          const Tensor<1, dim> impulse = constraint.impulse / step * constraint.condition.force(),
                               excess  = constraint.excess_force * constraint.condition.force();
          of_row.at_start -= excess;
          of_row.force -= impulse + (1. - end_weight) * excess;
          impulses[row.pair] -= row.share * impulse;
        }
    for (const ContactRow &row : all_rows)
      impulses[row.pair] +=
        over_step(row, end_weight, [](const ContactRow &at, const RowState &of) {
          return at.share * of.force;
        });
    mean_forces = impulses;
    for (Tensor<1, dim> &force : mean_forces)
      force = Utilities::MPI::sum(force, solid.communicator);
  }
} // namespace Touchstone

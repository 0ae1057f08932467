// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact.h>
#include <touchstone/contact/enforcement/refused_conditions.h>
#include <touchstone/contact/enforcement/undetermined_stick.h>

#include <algorithm>
#include <map>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Up to round-off a tangent of unit length keeps its length if it is free. */
    constexpr double free_length = 1. - 1e-6;

    /** Coefficients below this part are none, as for the constraint graph (doc/theory.md 6):
     * supports determine the slip, and the row slides as soon as there is any. */
    constexpr double no_part = 1e-3;



    /** Number of rows of each slave node, over all pairs, that were open by less than near_face of
     * the size of a face when the step began: the formulation of friction must change neither with
     * the active set, or the active set of each formulation could lead to the other one, nor with
     * iterates, or it changes for ever where the gap of one is near the bound. */
    std::map<Index, unsigned int>
    near_rows(const Contact &contact)
    {
      // Not one: where meshes end at a wall, the next nodes are one face away.
      constexpr double              near_face = 0.7;
      std::map<Index, unsigned int> result;
      for (const ContactRow &row : contact.rows())
        {
          const ContactRow &before = contact.committed(row);
          result[row.slave] += (before.has_partner && before.gap < near_face * row.size);
        }
      return result;
    }
  } // namespace



  // Against an obstacle only the slave node can move. Where supports or other active rows determine
  // its tangential displacement, any force within the cone is in equilibrium, and how it is divided
  // would depend on the enforcement and on the path of the iteration. So it is where supports
  // determine the slave node and most of what it faces: the few nodes that are free follow the
  // bodies, which leaves a slip that is neither forced nor can be taken back.
  std::vector<bool>
  undetermined_stick(const Contact &contact, const ConstraintGraph &supports)
  {
    std::vector<bool>                   result(contact.rows().size(), false);
    const std::map<Index, unsigned int> n_near = near_rows(contact);
    RefusedConditions                   held(supports);
    for (const ContactRow &row : contact.rows())
      if (row.friction)
        {
          const bool on_obstacle = !contact.pair(row).master();
          result[row.index]      = on_obstacle && n_near.at(row.slave) > 1;
          for (const Tensor<1, dim> &tangent : row.friction->kinematics.tangents)
            if (supports.free_part(row.slave, tangent).norm() >= free_length)
              continue;
            else if (on_obstacle)
              result[row.index] = true;
            else if (row.has_partner)
              {
                Condition stick;
                stick.node      = row.slave;
                stick.direction = tangent;
                stick.stencil   = row.stencil;
                held.add(row, stick);
              }
        }
    const std::vector<RefusedConditions::FreeParts> free =
      held.free_parts(supports, contact.solid_model().owned, contact.communicator());
    for (std::size_t k = 0; k < free.size(); ++k)
      if (!free[k].can_meet() && std::max(free[k].slave, free[k].others) > no_part)
        result[held.all()[k].row->index] = true;
    return result;
  }
} // namespace Touchstone

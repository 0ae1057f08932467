// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/general/general_contact.h>

// Which candidates have to be looked at in a cycle, and the faces and nodes that these refer to: of
// others nothing is computed (doc/general_contact.md, section 2).
namespace Touchstone
{
  using namespace dealii;

  void
  GeneralContact::begin_near()
  {
    moving.clear();
    // Where these are is told to other ranks when there are new candidates.
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (last_impulses[k].epoch == epoch)
        for (const SurfaceRow::Side &side : rows[k].sides)
          for (unsigned int i = 0; i < side.n; ++i)
            moving.add_node(side.slots[i]);
    for (const std::size_t number : watched)
      {
        moving.add_face(candidates.edge_pairs[number].one / 4);
        moving.add_face(candidates.edge_pairs[number].other / 4);
      }
    std::size_t kept = 0;
    for (const std::size_t slot : pressing)
      if (presses_often(slot))
        {
          moving.add_node(slot);
          pressing[kept++] = slot;
        }
      else
        last_pressed[candidates.at_slots.node(slot)] = 0;
    pressing.resize(kept);
  }



  void
  GeneralContact::find_near()
  {
    near_pairs.clear();
    face_limits.for_each_reached(travelled + travels, [&](const std::size_t pair) {
      near_pairs.push_back(pair);
      moving.add_face(candidates.face_pairs[pair].one);
      moving.add_face(candidates.face_pairs[pair].other);
    });
  }
} // namespace Touchstone

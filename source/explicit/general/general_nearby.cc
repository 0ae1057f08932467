// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/general/general_contact.h>

// Which candidates have to be looked at in a cycle, and the faces and nodes that these refer to: of
// others nothing is computed (doc/general_contact.md, section 2).
namespace Touchstone
{
  using namespace dealii;

  void
  GeneralContact::add_near_node(const std::size_t slot)
  {
    const unsigned int node = candidates.at_slots.node(slot);
    if (node_is_near[node])
      return;
    node_is_near[node] = true;
    near_nodes.push_back(node);
  }



  void
  GeneralContact::add_near(const unsigned int face)
  {
    if (face_is_near[face])
      return;
    face_is_near[face] = true;
    near_faces.push_back(face);
    for (unsigned int a = 0; a < 4; ++a)
      add_near_node(corner(face, a).slot);
  }



  void
  GeneralContact::begin_near()
  {
    for (const unsigned int face : near_faces)
      face_is_near[face] = false;
    for (const unsigned int node : near_nodes)
      node_is_near[node] = false;
    near_faces.clear();
    near_nodes.clear();
    // Where these are is told to other ranks when there are new candidates.
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (last_impulses[k].epoch == epoch)
        for (const Side &side : rows[k].sides)
          for (unsigned int i = 0; i < side.n; ++i)
            add_near_node(side.slots[i]);
    for (const std::size_t number : watched)
      {
        add_near(candidates.edge_pairs[number].one / 4);
        add_near(candidates.edge_pairs[number].other / 4);
      }
    std::size_t kept = 0;
    for (const std::size_t slot : pressing)
      if (presses_often(slot))
        {
          add_near_node(slot);
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
      add_near(candidates.face_pairs[pair].one);
      add_near(candidates.face_pairs[pair].other);
    });
  }
} // namespace Touchstone

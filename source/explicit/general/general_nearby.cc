// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/general/general_contact.h>

// Which candidates have to be looked at in a cycle (doc/general_contact.md, section 3).
namespace Touchstone
{
  using namespace dealii;

  void
  GeneralContact::find_near(const double distance)
  {
    near_pairs.clear();
    near_nodes_and_faces.clear();
    near_faces.clear();
    near_nodes.clear();
    std::vector<char> face_is_near(candidates.faces.size()), node_is_near(motion.size()),
      is_near(apart_nodes.size());
    const double until = travelled + distance;
    const auto   add   = [&](const unsigned int face) {
      if (face_is_near[face])
        return;
      face_is_near[face] = true;
      near_faces.push_back(face);
      for (unsigned int a = 0; a < 4; ++a)
        if (const unsigned int node = candidates.at_slots.node(corner(face, a).slot);
            !node_is_near[node])
          {
            node_is_near[node] = true;
            near_nodes.push_back(node);
          }
    };
    const auto &[begin, numbers] = candidates.nodes_by_faces;
    for (unsigned int k = 0; k < apart_faces.size(); ++k)
      if (!(apart_faces[k].until > until))
        {
          near_pairs.push_back(k);
          add(candidates.face_pairs[k].one);
          add(candidates.face_pairs[k].other);
          // What touches at the start does so before anything has moved.
          for (unsigned int i = begin[k]; i < begin[k + 1]; ++i)
            is_near[numbers[i]] = !(apart_nodes[numbers[i]].until > travelled);
        }
    for (unsigned int i = 0; i < is_near.size(); ++i)
      if (is_near[i])
        near_nodes_and_faces.push_back(i);
  }
} // namespace Touchstone

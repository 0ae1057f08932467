// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/general/general_contact.h>

#include <algorithm>

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
    std::vector<bool> face_is_near(candidates.faces.size()), node_is_near(motion.size());
    const double      until = travelled + distance;
    for (unsigned int k = 0; k < apart_faces.size(); ++k)
      if (!(apart_faces[k].until > until))
        {
          near_pairs.push_back(k);
          const auto &of = candidates.nodes_by_faces;
          for (unsigned int i = of.begin[k]; i < of.begin[k + 1]; ++i)
            if (!(apart_nodes[of.numbers[i]].until > until))
              near_nodes_and_faces.push_back(of.numbers[i]);
          for (const unsigned int face :
               {candidates.face_pairs[k].one, candidates.face_pairs[k].other})
            if (!face_is_near[face])
              {
                face_is_near[face] = true;
                near_faces.push_back(face);
                for (unsigned int a = 0; a < 4; ++a)
                  if (const unsigned int node = candidates.at_slots.node(corner(face, a).slot);
                      !node_is_near[node])
                    {
                      node_is_near[node] = true;
                      near_nodes.push_back(node);
                    }
              }
        }
    std::sort(near_nodes_and_faces.begin(), near_nodes_and_faces.end());
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/face_area.h>
#include <touchstone/contact/pairing/averaged_face.h>

#include <algorithm>

namespace Touchstone
{
  AveragedFace::AveragedFace(const Face                           &face,
                             const TraceBasis                     *basis,
                             const std::unordered_map<Index, int> &row_of_node,
                             const bool                            tied)
    : face(&face)
    , basis(basis)
    , row{}
    , whole(whole_areas(face, basis, /*reference=*/true))
  {
    cover.fill(-1.);
    at_once.part.fill(tied ? 1. : 0.);
    at_once.gives = face.without_row;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      {
        const auto found = row_of_node.find(basis ? basis->nodes[m] : face.nodes[m]);
        row[m]           = found != row_of_node.end() ? found->second : -1;
      }
  }



  bool
  AveragedFace::has_rows() const
  {
    return std::any_of(row.begin(), row.begin() + face->n_nodes(), [](const int k) {
      return k >= 0;
    });
  }



  void
  AveragedFace::commit()
  {
    for (unsigned int m = 0; m < face->n_nodes(); ++m)
      at_once.before[m] = cover[m] < 0. ? -1 : static_cast<int>(CoverShares::keeps(cover[m], -1));
  }



  bool
  AveragedFace::set_cover_by_others(const Vector *const part)
  {
    bool changed = false;
    for (unsigned int m = 0; m < face->n_nodes(); ++m)
      {
        const Index dof = dim * (basis ? basis->nodes[m] : face->nodes[m]);
        // What hanging nodes follow may lie beyond what this rank sees.
        const bool known = part && part->trilinos_partitioner().MyGID(
                                     static_cast<dealii::TrilinosWrappers::types::int_type>(dof));
        const double value = known ? (*part)(dof) : 0.;
        const bool   gives = face->without_row[m] && !(known && (*part)(dof + 1) > 0.);
        changed            = changed || value != at_once.part[m] || gives != at_once.gives[m];
        at_once.part[m]    = value;
        at_once.gives[m]   = gives;
      }
    return changed;
  }



  std::vector<AveragedFace>
  averaged_faces(const Surface                        &slave,
                 const std::unordered_map<Index, int> &row_of_node,
                 const bool                            tied)
  {
    std::vector<AveragedFace> faces;
    for (const auto *list : {&slave.owned_faces(), &slave.neighbour_faces()})
      for (const Face &face : *list)
        {
          AveragedFace averaged(face, slave.trace(face), row_of_node, tied);
          // Others contribute to no row here.
          if (averaged.has_rows())
            faces.push_back(averaged);
        }
    std::sort(faces.begin(), faces.end(), [](const AveragedFace &a, const AveragedFace &b) {
      return a.face->key < b.face->key;
    });
    return faces;
  }
} // namespace Touchstone

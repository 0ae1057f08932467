// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_boundary_faces_h
#define touchstone_drive_boundary_faces_h

#include <touchstone/base/types.h>
#include <touchstone/solid/solid.h>

#include <set>
#include <vector>

// Faces of a body on boundaries, and their nodes, of which adaptive meshes take their marks.
namespace Touchstone
{
  /** Visit the faces of owned cells of one body that lie on some of its
   * boundaries. */
  template <class Visitor>
  void
  for_each_face(const Solid                                &solid,
                const unsigned int                          body,
                const std::set<dealii::types::boundary_id> &boundaries,
                const Visitor                              &visit)
  {
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && cell->material_id() == body)
        for (const unsigned int f : cell->face_indices())
          if (cell->at_boundary(f) && boundaries.count(cell->face(f)->boundary_id()) > 0)
            visit(cell, f);
  }

  /**
   * Index of the first component's dof of each node on a face; the other components follow it.
   */
  template <class Cell>
  std::vector<Index>
  face_nodes(const Solid &solid, const Cell &cell, const unsigned int f)
  {
    std::vector<Index> dofs(solid.fe.n_dofs_per_cell()), result;
    cell->get_dof_indices(dofs);
    for (unsigned int i = 0; i < dofs.size(); ++i)
      if (solid.fe.system_to_component_index(i).first == 0 && solid.fe.has_support_on_face(i, f))
        result.push_back(dofs[i]);
    return result;
  }
} // namespace Touchstone

#endif

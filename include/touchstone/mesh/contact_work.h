// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_contact_work_h
#define touchstone_mesh_contact_work_h

#include <touchstone/base/types.h>
#include <touchstone/mesh/geometry.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/grid/tria.h>
#include <deal.II/numerics/rtree.h>

#include <map>
#include <set>
#include <vector>

namespace Touchstone
{
  /**
   * @brief The work that contact makes for a cell, in whole numbers: 4 for each face that
   * is a slave, 1 for each that is a master.
   *
   * The nodes of a slave face search for master faces, are projected on several of them and get
   * contact rows; a master face has its normals averaged and is sent. A face that has no face of
   * the other side near it when the run begins counts nothing, unless all are such:
   * it is left out after one look at a box.
   */
  class ContactWork
  {
  public:
    /** @brief Units of the work that are one slave face. */
    static constexpr unsigned int slave_face = 4, master_face = 1;

    /** @brief Boundaries of a pair; @p masters empty: an obstacle that is no body.
     * @param mesh Of all bodies, before refinement. */
    void
    add_pair(const BodyMesh                             &mesh,
             const std::set<dealii::types::boundary_id> &slaves,
             const std::set<dealii::types::boundary_id> &masters);

    unsigned int
    operator()(const dealii::Triangulation<dim>::cell_iterator &cell) const;

  private:
    using Box = dealii::BoundingBox<dim>;

    /** Faces of one side of a pair. */
    struct Side
    {
      std::set<dealii::types::boundary_id> boundaries;
      unsigned int                         work;
      /** Of the coarse faces of the other side; empty: the other side is everywhere. */
      dealii::RTree<Box> others;
    };

    std::vector<Side> sides;
  };
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/contact_work.h>

#include <algorithm>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The bounding box of a face, extended by half of its diagonal on all sides, as surfaces may
     * be curved, and move. */
    BoundingBox<dim>
    wide_box(const std::vector<Point<dim>> &vertices)
    {
      BoundingBox<dim> box(vertices);
      const auto &[lower, upper] = box.get_boundary_points();
      const double length        = lower.distance(upper);
      box.extend(0.5 * length);
      return box;
    }

    /** The widened boxes of all coarse faces of the given boundaries. */
    std::vector<BoundingBox<dim>>
    boxes(const BodyMesh &mesh, const std::set<types::boundary_id> &boundaries)
    {
      std::vector<BoundingBox<dim>> result;
      for (const CellData<2> &face : mesh.subcells.boundary_quads)
        if (boundaries.count(face.boundary_id) > 0)
          {
            std::vector<Point<dim>> vertices;
            for (const unsigned int v : face.vertices)
              vertices.push_back(mesh.vertices[v]);
            result.push_back(wide_box(vertices));
          }
      return result;
    }
  } // namespace



  void
  ContactWork::add_pair(const BodyMesh                     &mesh,
                        const std::set<types::boundary_id> &slaves,
                        const std::set<types::boundary_id> &masters)
  {
    // Work is counted only for faces near the other surface, as the partition is made for the
    // initial position. Where the surfaces are nowhere near each other, an empty tree makes all
    // their faces count.
    const std::vector<Box> of_slaves = boxes(mesh, slaves), of_masters = boxes(mesh, masters);
    const auto             tree = pack_rtree(of_masters);
    const bool any = std::any_of(of_slaves.begin(), of_slaves.end(), [&](const Box &box) {
      return tree.qbegin(boost::geometry::index::intersects(box)) != tree.qend();
    });
    // Where bodies that are apart will meet is not known in advance.
    sides.push_back({slaves, slave_face, any ? tree : RTree<Box>()});
    if (!masters.empty())
      sides.push_back({masters, master_face, any ? pack_rtree(of_slaves) : RTree<Box>()});
  }



  unsigned int
  ContactWork::operator()(const Triangulation<dim>::cell_iterator &cell) const
  {
    // A cell at an edge of the contact surface can have several faces in contact, each of which
    // counts.
    unsigned int sum = 0;
    for (const auto &face : cell->face_iterators())
      if (face->at_boundary())
        for (const Side &side : sides)
          if (side.boundaries.count(face->boundary_id()) > 0)
            {
              std::vector<Point<dim>> vertices;
              for (const unsigned int v : face->vertex_indices())
                vertices.push_back(face->vertex(v));
              if (side.others.empty() || side.others.qbegin(boost::geometry::index::intersects(
                                           wide_box(vertices))) != side.others.qend())
                sum += side.work;
            }
    return sum;
  }
} // namespace Touchstone

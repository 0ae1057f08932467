#ifndef touchstone_contact_search_h
#define touchstone_contact_search_h

#include <touchstone/contact/surface.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/numerics/rtree.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace Touchstone
{
  /** @brief The master point that a slave node faces. */
  struct ContactPartner
  {
    /** Points into the search that made it; valid until its next update. */
    const Face            *face = nullptr;
    std::array<double, 2>  xi{};
    dealii::Point<dim>     x;
    dealii::Tensor<1, dim> normal;
  };

  /**
   * @brief Finds the master point closest to a slave node, on whatever rank the
   * face lives.
   *
   * Global search: each rank receives the master faces that meet the bounding box
   * of its slave nodes, and keeps their boxes in an R-tree. Local search:
   * closest-point projection on the faces in the order of the distance of their
   * boxes, until no box is closer than the best point found.
   */
  class Search
  {
  public:
    /**
     * @param reach     Farthest distance at which a partner is looked for, length.
     * @param tolerance How far beyond an edge of the master surface a node still
     *                  finds it, as a fraction of the face.
     */
    Search(const Surface &master, double reach, double tolerance, MPI_Comm communicator);

    /** @brief Exchange the master faces in their present position.
     * @param positions Current positions of this rank's slave nodes. */
    void
    update(const std::vector<dealii::Point<dim>> &positions);

    /**
     * @brief The partner of a node at @p x.
     * @param slave_normal Outward normal of the slave surface there: faces that
     *                     look the same way are on the far side of a body.
     * @param in_contact   A node in contact slides off an edge only five times as
     *                     far beyond it as one that is not comes on, or it would
     *                     go on and off for ever.
     */
    std::optional<ContactPartner>
    find(const dealii::Point<dim>     &x,
         const dealii::Tensor<1, dim> &slave_normal,
         bool                          in_contact) const;

    /**
     * @brief Unit outward normal of the master surface at @p xi of a face,
     * continuous across the edges of faces unless these are sharp.
     *
     * On facets it is interpolated from the averaged normals of the nodes. On an
     * exact surface it is that of the surface moved with the face, with the jumps
     * at the nodes taken out.
     */
    dealii::Tensor<1, dim>
    normal(const Face &face, const std::array<double, 2> &xi) const;

    /** @brief Visit the master faces within reach of a box that look the other way
     * than @p slave_normal. */
    void
    for_each_near(const dealii::BoundingBox<dim>          &box,
                  const dealii::Tensor<1, dim>            &slave_normal,
                  const std::function<void(const Face &)> &visit) const;

  private:
    using Box  = dealii::BoundingBox<dim>;
    using Tree = dealii::RTree<std::pair<Box, std::size_t>>;

    const Surface    &master;
    const double      reach, tolerance;
    const MPI_Comm    communicator;
    std::vector<Face> faces;
    Tree              tree;

    Box
    bounding_box(const Face &face) const;
  };
} // namespace Touchstone

#endif

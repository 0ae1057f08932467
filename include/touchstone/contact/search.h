#ifndef touchstone_contact_search_h
#define touchstone_contact_search_h

#include <touchstone/contact/surface.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/numerics/rtree.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <unordered_map>
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
    /** 1 or -1 in the wedge over a sharp edge, where the normal is this times the
     * direction from the contact point; 0 elsewhere. */
    int wedge = 0;
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
     * @param kind      What gaps are measured to.
     */
    Search(const Surface &master,
           double         reach,
           double         tolerance,
           MasterNormal   kind,
           MPI_Comm       communicator);

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

    /** @brief What gaps to a face are measured to. */
    FaceGeometry
    geometry(const Face &face) const;

    /** @brief Derivatives of the averaged normals of faces of this search, from the
     * ranks that own them. Empty if normals come from the faces alone. Collective. */
    std::unordered_map<const Face *, std::vector<NormalDerivative>>
    normal_derivatives(const std::vector<const Face *> &needed) const;

    /** @brief Visit the master faces within reach of a box that look the other way
     * than @p slave_normal. Not those that are seen edge-on: their shadows on the
     * slave surface are slivers. */
    void
    for_each_near(const dealii::BoundingBox<dim>          &box,
                  const dealii::Tensor<1, dim>            &slave_normal,
                  const std::function<void(const Face &)> &visit) const;

  private:
    using Box  = dealii::BoundingBox<dim>;
    using Tree = dealii::RTree<std::pair<Box, std::size_t>>;

    const Surface     &master;
    const double       reach, tolerance;
    const MasterNormal kind;
    const MPI_Comm     communicator;
    std::vector<Face>  faces;
    Tree               tree;

    /** Numbers of this rank's faces that each rank has received, and where its own
     * copies of those of another rank begin. */
    std::map<unsigned int, std::vector<std::size_t>> sent;
    std::map<unsigned int, std::size_t>              received;

    Box
    bounding_box(const Face &face) const;
  };
} // namespace Touchstone

#endif

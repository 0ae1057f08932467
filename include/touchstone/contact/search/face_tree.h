// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_search_face_tree_h
#define touchstone_contact_search_face_tree_h

#include <touchstone/contact/search/face_exchange.h>
#include <touchstone/contact/search/self_contact.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief A face with the point of it that is closest to a node. */
  struct FaceProjection
  {
    const Face *face = nullptr;
    Projection  projection;
  };

  /**
   * @brief The faces of a FaceExchange in R-trees of their boxes: which are near a point, a box,
   * or the path of a node.
   */
  class FaceTree
  {
  public:
    using Box = FaceExchange::Box;

    /** @param exchange Must live as long, without another update. */
    explicit FaceTree(const FaceExchange &exchange);

    /** @brief Faces whose boxes are closest to a point: squares of the distances of the boxes with
     * indices of the faces, in ascending order. */
    std::vector<std::pair<double, std::size_t>>
    nearest(const dealii::Point<dim> &x, unsigned int n) const;

    /** @brief The same for all faces whose boxes are within @p radius of a point, and perhaps some
     * more: where it is known how far to look this is much faster. @param result Is overwritten. */
    void
    within(const dealii::Point<dim>                    &x,
           double                                       radius,
           std::vector<std::pair<double, std::size_t>> &result) const;

    /** @brief A bound from below of the distance of a face from a point, length. */
    double
    least_distance(const dealii::Point<dim> &x, const std::size_t index) const
    {
      const Outline &face   = outlines[index];
      double         square = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double outside = std::max({face.lower[d] - x[d], x[d] - face.upper[d], 0.});
          square += outside * outside;
        }
      return std::sqrt(square);
    }

    /** @brief The longest diagonal of any face, at least; length. */
    double
    largest_diagonal() const
    {
      return largest;
    }

    /** @brief Indices of the faces whose boxes meet a box. */
    std::vector<std::size_t>
    meeting(const Box &box) const;

    /** @brief Indices of the faces whose boxes meet a box at any time of this step, and perhaps
     * some more. Empty if steps are not committed. */
    std::vector<std::size_t>
    meeting_in_step(const Box &box) const;

    /** @brief The faces within @p reach of a box whose normals oppose @p slave_normal, in the
     * order of their keys. Not those that are seen edge-on: their projections on the slave
     * surface are slivers. */
    std::vector<const Face *>
    facing(const Box &box, const dealii::Tensor<1, dim> &slave_normal, double reach) const;

    /** @brief Whether the normal of a face is about that of the slave surface: the face is on the
     * far side of its body. */
    bool
    is_back_face(const std::size_t index, const dealii::Tensor<1, dim> &slave_normal) const
    {
      return outlines[index].normal * slave_normal > Tolerances::back_face_cosine;
    }

    /** @brief Whether a node may meet a face, wherever on it: no back face, and of its own body
     * only those that SelfContact allows. */
    bool
    may_meet(const std::size_t index, const SlavePoint &point) const
    {
      return !is_back_face(index, point.normal) &&
             (point.self == nullptr || point.self->may_meet(point, exchange.faces()[index]));
    }

    /** @brief Whether a face may be the closest one of a node: it may meet it, and a node at no
     * sharp edge does not see it edge-on. */
    bool
    may_be_closest(const std::size_t index, const SlavePoint &point) const
    {
      return may_meet(index, point) &&
             !(point.is_plain && is_edge_on(outlines[index].normal, point.normal));
    }

    /** @brief Whether a node with this normal does not face a master face with that one. */
    static bool
    is_edge_on(const dealii::Tensor<1, dim> &of_master, const dealii::Tensor<1, dim> &of_slave)
    {
      return of_master * of_slave > -Tolerances::perpendicular_cosine;
    }

    /** @brief Whether a node that may meet a face does so at the closest point. */
    bool
    meets(const SlavePoint &point, const FaceProjection &candidate) const;

    /** @brief Whether a node can have passed through a face since the step began, if both are of
     * one body. */
    bool
    can_have_entered(const SlavePoint &point, const FaceProjection &candidate) const
    {
      return point.self == nullptr ||
             point.self->can_have_entered(point, *candidate.face, candidate.projection);
    }

    /** @brief Project a node on a face. */
    FaceProjection
    project(const dealii::Point<dim> &x, const Face &face) const
    {
      ++n_candidates;
      return {&face, closest_point_projection(x, exchange.geometry(face))};
    }

    /** @brief Count a candidate that is tested without project(). */
    void
    count_candidate() const
    {
      ++n_candidates;
    }

    /** @brief Faces looked at so far. */
    std::uint64_t
    candidates() const
    {
      return n_candidates;
    }

    const FaceExchange &exchange;

  private:
    using Tree = dealii::RTree<std::pair<Box, std::size_t>>;

    /** Quick tests by which most faces are excluded. */
    struct Outline
    {
      dealii::Tensor<1, dim> normal; // in the middle
      dealii::Point<dim>     centre; // of a sphere around the face
      double                 radius;
      dealii::Point<dim>     lower, upper; // of a box around the face, without a margin if plane
    };
    std::vector<Outline> outlines;
    double               largest = 0.;
    Tree                 tree;
    /** Of all positions that the faces had in this step; made when first needed, as small motions
     * do without it. */
    mutable std::optional<Tree> swept_tree;

    mutable std::uint64_t n_candidates = 0;

    Outline
    outline(const Face &face, const Box &box) const;
  };
} // namespace Touchstone

#endif

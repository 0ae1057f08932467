// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_collision_box_tree_h
#define touchstone_collision_box_tree_h

#include <touchstone/collision/search_boxes.h>

#include <deal.II/base/point.h>

#include <functional>
#include <vector>

namespace Touchstone
{
  /**
   * @brief A binary tree of bounding boxes.
   *
   * Boxes are sorted along a space-filling curve (Lauterbach et al. 2009, "Fast BVH construction
   * on GPUs"); four that follow one another are a leaf, two nodes that follow one another have a
   * parent. So a tree has no pointers, and where boxes have moved a little the order is kept and
   * only the bounds are computed anew: refit().
   */
  class BoxTree
  {
  public:
    /** @brief Sort the boxes and compute all bounds. */
    void
    build(const SearchBoxes &input);

    /** @brief Compute all bounds; @p input must have as many boxes as in build(), of the same sets.
     */
    void
    refit(const SearchBoxes &input);

    unsigned int
    n() const
    {
      return numbers.size();
    }

    /** @brief Mean size of leaves over that of the root: what a search costs grows with it. It
     * does not change with the scale. */
    double
    looseness() const;

    /** @brief Append all pairs that @p input, which the bounds are of, asks for. */
    void
    pairs(const SearchBoxes &input, BoxPairs &pairs) const;

    /** @brief Append the numbers of all boxes that meet @p box. */
    void
    meeting(const FlatBox &box, std::vector<unsigned int> &result) const;

    /**
     * @brief Visit boxes until what is nearest to @p x is found, near ones first.
     *
     * @param look_at Is given the number of a box and returns the distance of the nearest that it
     * has met so far; of boxes farther than that no more are visited, but those in the same
     * distance all are.
     */
    void
    nearest(const dealii::Point<dim> &x, const std::function<double(unsigned int)> &look_at) const;

  private:
    static constexpr unsigned int leaf_size = 4;

    struct Node
    {
      FlatBox box;
      /** Whether boxes of the first set (1) and of the second (2) are below. */
      unsigned int sets;
    };
    /** Boxes by place in the tree, with their numbers. */
    std::vector<FlatBox>      boxes;
    std::vector<unsigned int> numbers;
    /** Nodes by level, leaves first. */
    std::vector<std::vector<Node>> levels;

    class PairSearch;

    void
    meeting(const FlatBox             &box,
            unsigned int               level,
            unsigned int               node,
            std::vector<unsigned int> &result) const;

    double
    nearest(const dealii::Point<dim>                  &x,
            double                                     reach,
            unsigned int                               level,
            unsigned int                               node,
            const std::function<double(unsigned int)> &look_at) const;
  };
} // namespace Touchstone

#endif

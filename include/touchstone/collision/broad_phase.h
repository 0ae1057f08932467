// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_collision_broad_phase_h
#define touchstone_collision_broad_phase_h

#include <touchstone/base/registry.h>
#include <touchstone/collision/search_boxes.h>

#include <vector>

namespace Touchstone
{
  /**
   * @brief Global search of contact: which of many boxes intersect.
   *
   * All methods find the same pairs, and differ in cost only: doc/searches.md compares them.
   * What an object keeps between calls makes the next one cheaper where boxes have moved a
   * little; the result depends on the boxes alone.
   *
   * A new method is a class that implements collect(), registered in BroadPhaseRegistry.
   */
  class BroadPhase
  {
  public:
    virtual ~BroadPhase() = default;

    /**
     * @brief All pairs (i, j) for which box i of @p a and box j of @p b have a point in common,
     * in ascending order.
     *
     * Boxes are closed: two that touch are a pair. Lengths have the unit of the caller.
     * @throws ExplicitFailure with the number of a box that is not finite or that is inverted.
     */
    BoxPairs
    find(const std::vector<dealii::BoundingBox<dim>> &a,
         const std::vector<dealii::BoundingBox<dim>> &b);

    /** @brief The same within one set: all pairs i < j, in ascending order. */
    BoxPairs
    find(const std::vector<dealii::BoundingBox<dim>> &boxes);

  protected:
    /**
     * @brief Find the pairs.
     * @param boxes Of one or of two sets; there may be none.
     * @param pairs Empty. To be filled with all pairs that SearchBoxes::sought() asks for and that
     *              intersect, each once, in any order, and with either box first.
     */
    virtual void
    collect(const SearchBoxes &boxes, BoxPairs &pairs) = 0;

    /** @brief Let another method do it. */
    static void
    delegate(BroadPhase &method, const SearchBoxes &boxes, BoxPairs &pairs)
    {
      method.collect(boxes, pairs);
    }

  private:
    // Kept so that no memory is asked for in each call.
    SearchBoxes               input;
    BoxPairs                  found;
    std::vector<unsigned int> begin;

    BoxPairs
    sorted_pairs();
  };

  /** @brief Methods of global search by name. */
  using BroadPhaseRegistry = Registry<BroadPhase>;
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/collision/box_tree.h>
#include <touchstone/collision/broad_phase.h>

namespace Touchstone
{
  namespace
  {
    /** @brief A tree of bounding boxes, which is built once and whose bounds follow the boxes
     * (Yang and Laursen 2008). */
    class Tree : public BroadPhase
    {
      BoxTree tree;
      bool    one_set            = true;
      double  looseness_as_built = 0.;

      void
      collect(const SearchBoxes &boxes, BoxPairs &pairs) override
      {
        bool build = tree.n() != boxes.n() || one_set != boxes.one_set;
        if (!build)
          {
            tree.refit(boxes);
            // Boxes of a leaf have moved apart: a search costs more, and building is cheap.
            build = tree.looseness() > 1.2 * looseness_as_built;
          }
        if (build)
          {
            tree.build(boxes);
            one_set            = boxes.one_set;
            looseness_as_built = tree.looseness();
          }
        tree.pairs(boxes, pairs);
      }
    };

    const BroadPhaseRegistry::Entry<Tree> tree_entry(
      "tree",
      "a tree of bounding boxes, whose bounds follow the motion; built anew when they have "
      "become loose.");
  } // namespace
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/collision/broad_phase.h>

namespace Touchstone
{
  namespace
  {
    /**
     * @brief The methods that are cheapest in the table of doc/searches.md: the tree, and tracking
     * where most boxes have moved by little since the last call.
     *
     * The tree is the cheapest in the first call or nearly so, whatever the scene; tracking needs
     * up to a third less where its partners can be kept, and up to twice as much where not.
     */
    class Automatic : public BroadPhase
    {
      std::shared_ptr<BroadPhase> tree     = BroadPhaseRegistry::make("tree"),
                                  tracking = BroadPhaseRegistry::make("tracking");
      std::vector<FlatBox> last;
      unsigned int         n_first = 0;

      /** @brief Whether at least 7 of 8 boxes have moved by less than a fifteenth of their size:
       * a third of the room that tracking gives them. */
      bool
      moved_little(const SearchBoxes &boxes) const
      {
        if (last.size() != boxes.n() || n_first != boxes.n_first)
          return false;
        unsigned int n_far = 0;
        for (unsigned int k = 0; k < boxes.n(); ++k)
          n_far += !last[k].grown(0.07 * last[k].size()).contains(boxes.boxes[k]);
        return n_far <= boxes.n() / 8;
      }

      void
      collect(const SearchBoxes &boxes, BoxPairs &pairs) override
      {
        const bool little = moved_little(boxes);
        delegate(little ? *tracking : *tree, boxes, pairs);
        last    = boxes.boxes;
        n_first = boxes.n_first;
      }
    };

    const BroadPhaseRegistry::Entry<Automatic>
      automatic_entry("automatic",
                      "tree at first, tracking when boxes have moved little since the last call.");
  } // namespace
} // namespace Touchstone

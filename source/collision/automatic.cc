// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/collision/broad_phase.h>

namespace Touchstone
{
  namespace
  {
    /**
     * @brief The method that is cheapest in the table of doc/searches.md: the hierarchy, and
     * tracking as soon as most boxes have moved by little since the last call.
     *
     * The hierarchy is the cheapest or nearly so in the first call whatever the scene; tracking
     * needs half its time when its partners can be kept, and twice when not.
     */
    class Automatic : public BroadPhase
    {
      std::shared_ptr<BroadPhase> hierarchy = BroadPhaseRegistry::make("hierarchy"),
                                  tracking  = BroadPhaseRegistry::make("tracking");
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
        delegate(little ? *tracking : *hierarchy, boxes, pairs);
        last    = boxes.boxes;
        n_first = boxes.n_first;
      }
    };

    const BroadPhaseRegistry::Entry<Automatic> automatic_entry(
      "automatic",
      "hierarchy at first, tracking when boxes have moved little since the last call.");
  } // namespace
} // namespace Touchstone

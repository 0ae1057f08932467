// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/collision/broad_phase.h>

namespace Touchstone
{
  namespace
  {
    /** @brief Each box against each other: what all methods are compared with. */
    class EveryPair : public BroadPhase
    {
      void
      collect(const SearchBoxes &boxes, BoxPairs &pairs) override
      {
        for (unsigned int i = 0; i < boxes.n_first; ++i)
          for (unsigned int j = boxes.one_set ? i + 1 : boxes.n_first; j < boxes.n(); ++j)
            boxes.test(i, j, pairs);
      }
    };

    const BroadPhaseRegistry::Entry<EveryPair> every_pair_entry(
      "every pair",
      "each box is compared with each other; for tests, since the cost grows with the square.");
  } // namespace
} // namespace Touchstone

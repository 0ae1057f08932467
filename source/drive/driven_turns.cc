// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact.h>
#include <touchstone/drive/driven_turns.h>

#include <cmath>
#include <cstdio>

// Steps in which formulas turn obstacles so far that their ends do not tell the way.
namespace Touchstone
{
  namespace
  {
    /** Degrees; the second for pairs with friction. */
    constexpr double most = 45., most_with_friction = 15.;
    /** Of sums of steps. */
    constexpr double round_off = 1e-9;
  } // namespace



  std::string
  turns_too_far(const Contact &contact, const double from, const double to)
  {
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      {
        const ContactPair &pair  = contact.pair(p);
        const double       limit = pair.parameters().friction ? most_with_friction : most,
                     turn        = std::abs(pair.pairing().driven_turn(from, to));
        if (turn <= limit * (1. + round_off))
          continue;
        char text[120];
        std::snprintf(
          text,
          sizeof(text),
          "' turns by %.3g degrees in the step, and %.3g are as far as the ends of a step "
          "tell how",
          turn,
          limit);
        return "contact pair '" + pair.parameters().name + "': obstacle '" +
               pair.parameters().obstacle + text +
               (pair.parameters().friction ? " it slides" : " it goes") +
               ": make smaller steps, or let 'Load stepping/Maximum cuts' make them";
      }
    return "";
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact.h>
#include <touchstone/drive/driven_turns.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

// Steps in which formulas turn obstacles so far that their ends do not tell the way.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Whether anything touches the master of each pair. Collective. */
    std::vector<int>
    touched(const Contact &contact)
    {
      std::vector<int> result(contact.n_pairs());
      for (const ContactRow &row : contact.rows())
        if (contact.state(row).active())
          result[row.pair] = 1;
      Utilities::MPI::max(result, contact.communicator(), result);
      return result;
    }



    /** By what the largest turn of an obstacle exceeds what is allowed, at least 1. */
    double
    excess(const Contact          &contact,
           const std::vector<int> &touched,
           const double            from,
           const double            to)
    {
      constexpr double most = 45., most_with_friction = 15.; // degrees
      double           result = 1.;
      for (unsigned int p = 0; p < contact.n_pairs(); ++p)
        if (touched[p] == 1)
          {
            const ContactPair &pair  = contact.pair(p);
            const double       limit = pair.parameters().friction ? most_with_friction : most,
                         turn        = std::abs(pair.pairing().driven_turn(from, to));
            result                   = std::max(result, turn / limit);
          }
      return result;
    }
  } // namespace



  double
  end_of_turn(const Contact &contact, const double from, const double to)
  {
    constexpr double round_off = 1e-9, shortest = 1e-6;
    // Most scenes have no obstacle that turns.
    if (excess(contact, std::vector<int>(contact.n_pairs(), 1), from, to) <= 1. + round_off)
      return to;
    const auto touches = touched(contact);
    for (double part = 1.; part > shortest; part *= 0.5)
      if (const double end = part == 1. ? to : from + part * (to - from);
          excess(contact, touches, from, end) <= 1. + round_off)
        return end;
    return to;
  }
} // namespace Touchstone

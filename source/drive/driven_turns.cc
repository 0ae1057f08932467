// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact.h>
#include <touchstone/drive/driven_turns.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>

// Steps in which formulas turn obstacles or bodies so far that their ends do not tell the way.
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



    /** By what the largest turn of a master or slave, or of one against the other, exceeds what is
     * allowed, at least 1. */
    double
    excess(const Contact                     &contact,
           const std::vector<int>            &touched,
           const std::vector<Tensor<1, dim>> &of_bodies,
           const double                       from,
           const double                       to)
    {
      constexpr double most = 45., most_with_friction = 15.; // degrees
      double           result = 1.;
      for (unsigned int p = 0; p < contact.n_pairs(); ++p)
        if (touched[p] == 1)
          {
            const ContactPair   &pair   = contact.pair(p);
            const Tensor<1, dim> slave  = of_bodies[pair.slave_body()],
                                 master = pair.master_body() == numbers::invalid_unsigned_int
                                            ? pair.pairing().driven_turn(from, to)
                                            : of_bodies[pair.master_body()];
            const double limit          = pair.parameters().friction ? most_with_friction : most;
            for (const double turn : {slave.norm(), master.norm(), (master - slave).norm()})
              result = std::max(result, turn / limit);
          }
      return result;
    }
  } // namespace



  double
  end_of_turn(const Contact       &contact,
              const TurnsOfBodies &turns_of_bodies,
              const double         from,
              const double         to)
  {
    constexpr double round_off = 1e-9, shortest = 1e-6;
    const auto       is_short = [&](const std::vector<int> &of_pairs, const double end) {
      return excess(contact, of_pairs, turns_of_bodies(from, end), from, end) <= 1. + round_off;
    };
    // Most scenes have nothing that turns.
    if (is_short(std::vector<int>(contact.n_pairs(), 1), to))
      return to;
    const auto touches = touched(contact);
    for (double part = 1.; part > shortest; part *= 0.5)
      if (const double end = part == 1. ? to : from + part * (to - from); is_short(touches, end))
        return end;
    return to;
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact.h>
#include <touchstone/contact/contact_checks.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

// How much penetration the springs of a penalty have left: where these are softer than the bodies,
// the result is that of the springs (doc/theory.md 6).
namespace Touchstone
{
  using namespace dealii;

  std::map<std::string, LeftPenetration>
  left_penetration(const Contact &contact)
  {
    // What exact methods leave, whose tolerance of gaps is smaller.
    constexpr double negligible = 1e-6;

    std::map<std::string, LeftPenetration> result;
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      {
        const ContactPair &pair = contact.pair(p);
        LeftPenetration    left;
        for (const ContactRow &row : pair.rows())
          if (const RowState &state = contact.state(row); state.active())
            {
              const double length = row.tied ? row.gap_vector.norm() : -row.gap;
              if (length <= negligible * row.size)
                continue;
              left.relative = std::max(left.relative, length / row.size);
              left.length   = std::max(left.length, length);
              left.energy += 0.5 * length * (row.tied ? state.force.norm() : state.lambda);
            }
        left.relative = Utilities::MPI::max(left.relative, contact.communicator());
        left.length   = Utilities::MPI::max(left.length, contact.communicator());
        left.energy   = Utilities::MPI::sum(left.energy, contact.communicator());
        if (left.length > 0.)
          result[pair.parameters().name] = left;
      }
    return result;
  }
} // namespace Touchstone

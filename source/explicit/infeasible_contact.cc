// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/infeasible_contact.h>

#include <string>
#include <vector>

namespace Touchstone
{
  namespace
  {
    std::string
    side(const std::string &body, const std::vector<std::string> &boundaries)
    {
      std::string list;
      for (const std::string &boundary : boundaries)
        list += (list.empty() ? "" : ", ") + boundary;
      return "'" + list + "' of '" + body + "'";
    }

    std::string
    text(const ContactPairParameters &pair)
    {
      return "contact pair '" + pair.name + "': " + side(pair.slave_body, pair.slave_boundaries) +
             " and " +
             (pair.obstacle.empty() ? side(pair.master_body, pair.master_boundaries)
                                    : "the obstacle '" + pair.obstacle + "'") +
             " are driven into each other: supports, or contact from other sides, leave their nodes "
             "no velocity that contact allows. Check prescribed displacements, the motion of "
             "obstacles, and initial gaps.";
    }
  } // namespace



  InfeasibleContact::InfeasibleContact(const ContactPairParameters &pair)
    : NonConvergence(text(pair))
  {
  }



  SoftContact::SoftContact(const ContactPairParameters &pair, const double time)
    : NonConvergence("contact pair '" + pair.name + "': at time " + std::to_string(time) +
                     " bodies are within each other by more than half a face, since the contact "
                     "springs are too soft for what presses them; take a larger 'Penalty factor' "
                     "or 'Contact/Enforcement = forward increment', and check initial overlaps")
  {
  }
} // namespace Touchstone

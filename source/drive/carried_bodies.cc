// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/carried_bodies.h>
#include <touchstone/drive/translations.h>

#include <algorithm>
#include <cmath>

// First guesses of steps for bodies that contact alone holds (doc/theory.md 5).
namespace Touchstone
{
  using namespace dealii;

  Tensor<1, dim>
  motion_of_obstacle(const Contact &contact, const ContactRow &row, const double t)
  {
    return contact.pair(row).pairing().motion(t).since(row.motion, contact_point(row));
  }



  namespace
  {
    /** A direction in which a row holds a body without supports, and the motion in it of what the
     * row faces; length. */
    struct Hold
    {
      unsigned int   body;
      Tensor<1, dim> direction;
      double         motion;
    };



    /** The holds of bodies that supports of no kind hold, by what obstacles and @p motions of other
     * bodies do in the step; of those that hold each other nothing is known. @param supported By
     * number of the body. */
    std::vector<Hold>
    holds_of_contact(const Contact                     &contact,
                     const std::vector<int>            &supported,
                     const std::vector<Tensor<1, dim>> &motions,
                     const double                       t)
    {
      std::vector<Hold> result;
      for (const ContactRow &row : contact.rows())
        {
          const RowState &state = contact.state(row);
          if (!state.active())
            continue;
          const bool slave  = supported[row.body] == 0,
                     master = !row.on_obstacle() && supported[row.master_body] == 0;
          if (slave == master)
            continue;
          const Tensor<1, dim> motion = master              ? motions[row.body]
                                        : row.on_obstacle() ? motion_of_obstacle(contact, row, t)
                                                            : motions[row.master_body];
          const unsigned int   body   = master ? row.master_body : row.body;
          if (state.status == ContactStatus::slip)
            result.push_back({body, row.normal, row.normal * motion});
          else
            for (unsigned int d = 0; d < dim; ++d)
              {
                Tensor<1, dim> axis;
                axis[d] = 1.;
                result.push_back({body, axis, motion[d]});
              }
        }
      return result;
    }
  } // namespace



  void
  carry_bodies(const Contact               &contact,
               const std::vector<int>      &supported,
               const double                 t,
               std::vector<Tensor<1, dim>> &motions)
  {
    const std::vector<Hold> holds = holds_of_contact(contact, supported, motions, t);
    Translations            translations(motions.size());
    for (const Hold &hold : holds)
      translations.add(hold.body, hold.direction, hold.motion);
    translations.complete(contact.communicator());
    std::vector<double> largest(2 * motions.size());
    for (const Hold &hold : holds)
      {
        const Tensor<1, dim> motion = translations.closest(hold.body);
        double *const        worst  = &largest[2 * hold.body];
        worst[0]                    = std::max(worst[0], std::abs(hold.motion));
        worst[1] = std::max(worst[1], std::abs(hold.motion - hold.direction * motion));
      }
    Utilities::MPI::max(largest, contact.communicator(), largest);
    constexpr double round_off = 1e-10;
    for (unsigned int body = 0; body < motions.size(); ++body)
      if (largest[2 * body] > 0. && largest[2 * body + 1] <= round_off * largest[2 * body])
        motions[body] = translations.closest(body);
  }
} // namespace Touchstone

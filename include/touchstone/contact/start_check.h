// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_start_check_h
#define touchstone_contact_start_check_h

#include <touchstone/contact/contact_parameters.h>
#include <touchstone/contact/geometry/surface.h>
#include <touchstone/contact/row.h>

#include <vector>

namespace Touchstone
{
  /**
   * @brief Looks at a contact pair as its bodies are placed: whether its surfaces look
   * at each other, and whether they overlap more deeply than the search reaches.
   *
   * The surfaces must have been moved to the start position.
   */
  class StartCheck
  {
  public:
    /**
     * @param u    Displacement at the start, with ghosts.
     * @param rows Rows of the pair after the first search.
     * @param slave_body, master_body Numbers of the bodies; @p master is null for an obstacle.
     */
    StartCheck(const Solid                   &solid,
               const ContactPairParameters   &parameters,
               const Surface                 &slave,
               const Surface                 *master,
               unsigned int                   slave_body,
               unsigned int                   master_body,
               const Vector                  &u,
               const std::vector<ContactRow> &rows);

    /**
     * @brief The distance at which slave faces that lie within the master body find its
     * surface. Only faces with a node that the search found nothing for are looked at; if it
     * found nothing at all, also master faces within the slave body.
     * @return zero if there are none; length. Collective.
     */
    double
    depth_of_overlap() const;

    /** @brief @throws InputError, on all ranks, if every node of the slave surface
     * looks away from the obstacle or from the master surface beside it, and if bodies
     * overlap without any slave node that meets a master face. Collective. */
    void
    check_facing() const;

  private:
    const Solid                   &solid;
    const ContactPairParameters   &parameters;
    const Surface                 &slave;
    const Surface                 *master;
    const unsigned int             slave_body, master_body;
    const Vector                  &u;
    const std::vector<ContactRow> &rows;

    /** Over all ranks: no row has a partner. */
    bool
    nothing_found() const;
    /** Their names, as a list. */
    std::string
    slave_boundaries() const;
    void
    throw_if_all_look_away(bool looks_here, const std::string &what) const;
  };
} // namespace Touchstone

#endif

#ifndef touchstone_contact_balance_h
#define touchstone_contact_balance_h

#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/contact/contact.h>

#include <functional>

namespace Touchstone
{
  /**
   * @brief Set the forces of rows to what balances their slave nodes, in the
   * directions in which no prescribed displacement does.
   *
   * The displacement increment that the forces belong to has been found, so they
   * are those of the linearised conditions; the gaps that the change of normals
   * and contact points leaves have no part in them.
   *
   * @param unbalanced External minus internal forces, without contact forces.
   * @param graph      Holds the prescribed displacements only.
   * @param applies    Which active rows to set; the others keep their forces.
   */
  void
  balance_slave_nodes(Contact                                       &contact,
                      const Vector                                  &unbalanced,
                      const ConstraintGraph                         &graph,
                      const std::function<bool(const ContactRow &)> &applies);
} // namespace Touchstone

#endif

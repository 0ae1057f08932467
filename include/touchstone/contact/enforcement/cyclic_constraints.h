// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_enforcement_cyclic_constraints_h
#define touchstone_contact_enforcement_cyclic_constraints_h

#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/contact/contact_pair.h>

#include <memory>
#include <vector>

namespace Touchstone
{
  class Contact;

  /**
   * @brief Finds rows that depend on each other in a cycle over several pairs.
   *
   * The slave nodes of a row move with its master nodes, and these, if they are slaves
   * of other active rows, with further ones. Where that leads back to a row, those
   * of the later pair are redundant: up to discretisation error they repeat constraints that are
   * already imposed. Kept, they would make multipliers dependent, could not
   * be eliminated, and would let the surfaces fit together only as far as both
   * meshes represent the same functions (locking).
   */
  class CyclicConstraints
  {
  public:
    /** Of the rows of this rank, by their index. */
    struct Redundant
    {
      /** All conditions of the row. */
      std::vector<bool> rows;
      /** Those of stick of other rows, which the condition along the normal does without. */
      std::vector<bool> stick;
    };

    /** @brief Find the pairs that can be part of a cycle. Collective. */
    void
    reinit(const std::vector<std::unique_ptr<ContactPair>> &pairs, MPI_Comm communicator);

    /**
     * @brief Conditions that are redundant. Collective.
     *
     * A cycle that only stick closes is none of the conditions along normals, which keep the bodies
     * apart and remain.
     * @param graph     The prescribed displacements: rows that these determine are in no cycle.
     * @param threshold Smaller components of unit normals do not count.
     */
    Redundant
    find(const Contact &contact, const ConstraintGraph &graph, double threshold) const;

  private:
    /** Pairs whose rows can depend on each other in a cycle, in their order. */
    std::vector<unsigned int> cyclic;

    struct Search;
  };
} // namespace Touchstone

#endif

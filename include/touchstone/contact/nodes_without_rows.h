// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_nodes_without_rows_h
#define touchstone_contact_nodes_without_rows_h

#include <touchstone/contact/junctions.h>

#include <memory>
#include <set>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Slave nodes that leave their rows to the other nodes of their faces, by pair: at edges
   * where pairs meet, over joints of masters, and between supports (doc/theory.md 3.1).
   *
   * They follow from the configuration in which a step begins, and those that a step brings
   * together are added once it has been solved. The same on all ranks.
   */
  struct NodesWithoutRows
  {
    /** See junction_nodes() and nodes_over_joints(), and held_nodes(). */
    std::vector<std::set<Index>> junctions, held;

    explicit NodesWithoutRows(const std::size_t n_pairs = 0)
      : junctions(n_pairs)
      , held(n_pairs)
    {
    }

    bool
    operator==(const NodesWithoutRows &other) const
    {
      return junctions == other.junctions && held == other.held;
    }

    /** @brief All of the pair @p p. */
    std::set<Index>
    of_pair(std::size_t p) const;

    /** @brief Whether no pair has any. */
    bool
    empty() const;

    /** @brief Add those of another set. */
    void
    add(const NodesWithoutRows &other);
  };

  /** @brief Finds NodesWithoutRows. */
  class NodesWithoutRowsFinder
  {
  public:
    /** @brief Surfaces and supports of a run, which do not change. Collective.
     * @param supports Directions in which displacements of owned nodes are prescribed. */
    NodesWithoutRowsFinder(const std::vector<std::unique_ptr<ContactPair>> &pairs,
                           const ContactPair::Mirrors                      &supports,
                           const Solid                                     &solid);

    /** @brief Whether pairs that can stick have nodes in common: rows of all nodes are needed to
     * tell what they join. */
    bool
    pairs_meet() const
    {
      return !shared.empty();
    }

    /** @brief The nodes in the configuration of some rows, of all slave nodes. Collective. */
    NodesWithoutRows
    find(const RowsByPair &rows) const;

  private:
    const std::vector<std::unique_ptr<ContactPair>> &pairs;
    const ContactPair::Mirrors                      &supports;
    const Solid                                     &solid;
    std::set<Index>                                  shared;
  };
} // namespace Touchstone

#endif

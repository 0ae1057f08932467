// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_connected_parts_h
#define touchstone_solid_connected_parts_h

#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/solid/solid.h>

#include <deal.II/base/bounding_box.h>

#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief The connected parts of all bodies: cells with a common vertex are connected. A body
   * from a mesh file, or one that is repeated, can have several. */
  class ConnectedParts
  {
  public:
    /** Collective. */
    explicit ConnectedParts(const Solid &solid);

    /** @brief Of all bodies together. */
    unsigned int
    n_parts() const
    {
      return boxes.size();
    }

    /** @brief The part of a node that this rank owns. */
    unsigned int
    of_node(const Index node) const
    {
      return part_of_node[solid.owned.index_within_set(dim * node) / dim];
    }

    /** @brief Whether the body of part @p k has others. */
    bool
    has_others(unsigned int k) const;

    /** @brief Whether the conditions, on nodes and without others, prevent all rigid motions of
     * part @p k; for each part. Collective. */
    std::vector<bool>
    held(const std::vector<Condition> &conditions) const;

    /** @brief The parts in words for messages: body, and the box around each. */
    std::string
    describe(const std::vector<unsigned int> &parts) const;

    /** @brief The name of the body of part @p k. */
    const std::string &
    body(const unsigned int k) const
    {
      return solid.bodies[bodies[k]].name;
    }

  private:
    const Solid              &solid;
    std::vector<unsigned int> part_of_node;
    /** Of each part: its body and the box around its vertices, undeformed; length. */
    std::vector<unsigned int>             bodies;
    std::vector<dealii::BoundingBox<dim>> boxes;

    /** For each active cell that this rank knows a number that its whole part has in common, over
     * all ranks. */
    std::vector<double>
    labels() const;
    void
    set_boxes(const std::vector<unsigned int> &part_of_cell, unsigned int n);
  };
} // namespace Touchstone

#endif

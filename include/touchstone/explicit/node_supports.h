// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_node_supports_h
#define touchstone_explicit_node_supports_h

#include <touchstone/explicit/node_map.h>
#include <touchstone/solid/boundary_conditions.h>

#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Supports and prescribed motion of explicit dynamics: at each supported node up to three
   * orthonormal directions in which the velocity is prescribed, and contact meets an infinite mass.
   *
   * Precedence is that of BoundaryConditions: a direction that earlier ones span is dropped.
   */
  class NodeSupports
  {
  public:
    /** @brief Collective. */
    NodeSupports(const BoundaryConditions &conditions, const NodeMap &map);

    /** @brief Whether a local node, owned or ghost, is supported in any direction. */
    bool
    supported(const unsigned int node) const
    {
      return place(node) < frames.size();
    }

    /** @brief Place of a supported node; of an owned one, that in nodes(). */
    unsigned int
    place(const unsigned int node) const
    {
      return places[node];
    }

    /** @brief The part of a vector at a local node, owned or ghost, that supports leave free. */
    dealii::Tensor<1, dim>
    free_part(const unsigned int node, dealii::Tensor<1, dim> vector) const
    {
      if (!supported(node))
        return vector;
      const Frame &frame = frames[place(node)];
      for (unsigned int k = 0; k < frame.n; ++k)
        vector -= (vector * frame.directions[k]) * frame.directions[k];
      return vector;
    }

    /** @brief Set the supported components of the velocities of owned nodes so that the nodes, now
     * displaced by @p u, reach their prescribed displacements of time @p t after the time @p step.
     */
    void
    set_velocities(double t, double step, const NodeField &u, NodeField &v) const;

    /** @brief Set the supported components of the displacements of owned nodes to those of time @p
     * t. */
    void
    set_displacements(double t, NodeField &u) const;

    /** @brief Sum forces at owned nodes over the boundaries that exert them, bitwise the same on
     * any number of ranks. @param force Of the supports, by place in nodes(); components in free
     * directions are ignored. Collective. */
    std::vector<Reaction>
    reactions(const NodeField &force) const;

    /** @brief The same forces at each owned node. */
    NodeField
    nodal_reactions(const NodeField &force) const;


    /** @brief Owned nodes that are supported, ascending. */
    const std::vector<unsigned int> &
    nodes() const
    {
      return supported_nodes;
    }

    /** @throws InputError if a prescribed displacement was not finite. Collective. */
    void
    check() const
    {
      conditions.all_formulas().check(map.communicator());
    }

  private:
    /** A direction of a node. */
    struct Direction
    {
      unsigned int           node;
      dealii::Tensor<1, dim> unit;
      unsigned int           support;
      /** Number of the formula, and for those that depend on the position where it is
       * evaluated; -1: zero. */
      int                formula;
      dealii::Point<dim> position;
      /** The direction that the scene prescribes is norm times unit, plus those of the node's
       * earlier directions times these factors. */
      double                norm;
      std::array<double, 2> earlier;
      /** Number of earlier directions of the node. */
      unsigned int n_earlier;
    };

    const BoundaryConditions &conditions;
    const NodeMap            &map;
    /** The orthonormal directions of a node. */
    struct Frame
    {
      unsigned int                            n = 0;
      std::array<dealii::Tensor<1, dim>, dim> directions;
    };
    /** Of the supported nodes, owned ones first, and by local node its place there: the highest
     * number if it is free. */
    std::vector<Frame>                        frames;
    std::vector<unsigned int>                 places;
    std::vector<Direction>                    all;
    std::vector<BoundaryConditions::Function> formulas;
    std::vector<unsigned int>                 supported_nodes;
    mutable std::vector<double>               formula_values;

    /** Set the frames from the directions of the owned nodes, one field for the first, the second
     * and the third direction, zero where there is none. Collective. */
    void
    set_frames(std::array<NodeField, dim> &directions);
    /** Call @p use with each direction and the displacement that is prescribed along it. */
    template <class Use>
    void
    for_each_target(double t, const Use &use) const;
  };
} // namespace Touchstone

#endif

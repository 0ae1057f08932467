// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_node_sets_h
#define touchstone_solid_node_sets_h

#include <touchstone/base/formula.h>
#include <touchstone/mesh/forest.h>
#include <touchstone/solid/boundary_parameters.h>
#include <touchstone/solid/solid.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief An owned node of a set. */
  struct SetNode
  {
    Index              node;
    dealii::Point<dim> position;
    /** Of a force on the whole set: what belongs to this node; no unit. */
    double share = 0.;
  };

  /** @brief A force on the nodes of a set. */
  struct NodeSetLoad
  {
    std::array<std::shared_ptr<const Formula>, dim> force;
    std::vector<SetNode>                            nodes;
  };

  /**
   * @brief The owned nodes of a set of mesh nodes, on the present mesh: edges, points, or any nodes
   * that a mesh file names. Hanging nodes are not among them.
   *
   * A node that elements of degree 2 or refinement have added belongs to the set if it is on an
   * edge, a face, or in a cell of the mesh file all of whose corners belong to it. Collective.
   */
  std::vector<SetNode>
  nodes_of_set(const Forest      &forest,
               const Solid       &solid,
               unsigned int       body,
               const std::string &name);

  /**
   * @brief Set the shares of a force: by the length of the edges that have all their nodes in the
   * set, such that the force per length is the same everywhere; equal ones for single points.
   * @throws InputError in the name of @p section for sets of edges and points, and for whole
   * faces. Collective.
   */
  void
  set_shares(const Solid          &solid,
             const Forest         &forest,
             unsigned int          body,
             const std::string    &name,
             const std::string    &section,
             std::vector<SetNode> &nodes);

  /** @brief Refuse what cannot be on a set of nodes. @throws InputError */
  void
  check_for_node_set(const BoundaryParameters &condition, const std::string &section);
} // namespace Touchstone

#endif

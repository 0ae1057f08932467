// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_tool_nodes_h
#define touchstone_explicit_tool_nodes_h

#include <touchstone/base/stateful.h>
#include <touchstone/contact/rigid_tool.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/symmetric_tensor.h>

#include <limits>
#include <map>
#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Obstacles that forces move in explicit dynamics (doc/explicit.md, section 9.1): rigid
   * bodies with two nodes, whose velocities are that of the reference point and the angular
   * velocity. Contact rows name them after the slave node, so that impulses act on them as on other
   * nodes.
   *
   * All ranks know all of it; the nodes belong to the first rank, with dofs after those of the
   * bodies.
   */
  class ToolNodes : public Stateful
  {
  public:
    /** @param obstacles, contact Must live as long as this. Collective. */
    ToolNodes(const std::vector<ObstacleParameters> &obstacles, const Contact &contact);

    bool
    empty() const
    {
      return tools.empty();
    }

    /** @brief The dofs of this rank with those of tools. */
    const dealii::IndexSet &
    owned() const
    {
      return all_owned;
    }

    /** @brief First dofs of both nodes of the obstacle of a pair; invalid if it is driven. */
    Index
    shift_dof(const unsigned int pair) const
    {
      return of_pairs[pair] == none ? invalid_index : first_dof + 2 * dim * of_pairs[pair];
    }
    Index
    turn_dof(const unsigned int pair) const
    {
      return shift_dof(pair) + dim;
    }
    bool
    is_tool(const Index dof) const
    {
      return dof >= first_dof;
    }

    /** @brief By the dof of a node: inverse mass or inertia, and the velocity, in the cycle before
     * as well. */
    dealii::SymmetricTensor<2, dim>
    mobility(Index dof) const;
    dealii::Tensor<1, dim>
    velocity(Index dof) const;
    dealii::Tensor<1, dim>
    velocity_before(Index dof) const;

    /** @brief The matrix by which an impulse on a body at @p x acts on the node of turns. */
    dealii::Tensor<2, dim>
    lever(unsigned int pair, const dealii::Point<dim> &x, double time) const;

    /** @brief How fast a point of the obstacle moves at most where the bodies are. */
    double
    speed(unsigned int pair) const;

    /** @brief Change the velocities by what loads do in the time @p between. */
    void
    kick(double time, double between);

    /** @brief Take back the last kick(), and what contact did. */
    void
    restore();

    /** @brief Set the velocity of a node. On the first rank, followed by spread() on all. */
    void
    take(Index dof, const dealii::Tensor<1, dim> &velocity);
    void
    spread();

    /** @brief Move for the time @p length. */
    void
    advance(double length);

    /** @brief The interval has ended: keep the mean contact forces. Collective. */
    void
    end_interval(double time);

    /** @brief By name of the obstacle. */
    std::map<std::string, RigidToolResult>
    results() const;

    void
    commit() override;
    void
    rollback() override;
    void
    save(ArchiveWriter &archive) const override;
    void
    load(const ArchiveReader &archive) override;

  private:
    static constexpr unsigned int none = std::numeric_limits<unsigned int>::max();

    const Contact            &contact;
    std::vector<RigidTool>    tools;
    std::vector<unsigned int> of_pairs;
    const Index               first_dof;
    dealii::IndexSet          all_owned;
    double                    present_time = 0.;
    /** Velocities before the last kick(). */
    std::vector<RigidTool::Components> before;

    /** Of the node of turns with these components, in fixed axes. */
    static dealii::Tensor<1, dim>
    spatial(const RigidTool::State &state, const RigidTool::Components &velocity, bool turn);
    dealii::Tensor<1, dim>
    velocity(Index dof, bool earlier) const;
    /** Angular momentum in fixed axes, and the velocity that it means. */
    static dealii::Tensor<1, dim>
    spin(const RigidTool &tool);
    static void
    set_spin(RigidTool &tool, const dealii::Tensor<1, dim> &momentum);
  };
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_pairing_h
#define touchstone_contact_pairing_pairing_h

#include <touchstone/base/registry.h>
#include <touchstone/contact/contact_parameters.h>
#include <touchstone/contact/geometry/surface.h>
#include <touchstone/contact/pairing/beyond_edge.h>
#include <touchstone/contact/row.h>
#include <touchstone/contact/search/search.h>
#include <touchstone/mesh/obstacle_parameters.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

namespace Touchstone
{
  /** @brief What a pairing is made from. */
  struct PairingInput
  {
    const ContactPairParameters *parameters;
    const ObstacleParameters    *obstacle;
    const Solid                 *solid;
    const Surface               *slave;
    /** Null for an obstacle. */
    const Surface *master;
    /** Farthest distance at which partners are looked for, length; zero lets the pairing
     * choose it from the size of the faces. */
    double search_distance = 0.;
    /** There are other pairs, which may cover what this one does not. */
    bool one_of_several = false;
    /** The second is invalid for an obstacle. */
    unsigned int slave_body = 0, master_body = dealii::numbers::invalid_unsigned_int;
  };

  struct CoverOfNodes;

  /** @brief What a slave node meets, where that is known without a search. */
  struct PointContact
  {
    /** Unit outward normal of the master. */
    dealii::Tensor<1, dim> normal;
    /** From the contact point to the node, length. */
    dealii::Tensor<1, dim> gap_vector;
  };

  /** @brief What a pairing knows of earlier steps besides positions, in keys of faces. */
  struct PairingMemory
  {
    /** The master face of each row, in the order of the rows; or nothing at all. */
    std::vector<std::optional<std::uint64_t>> of_rows;
    /** Slave faces of this rank, each with a master face. */
    std::unordered_map<std::uint64_t, std::uint64_t> of_faces;
  };

  /**
   * @brief Makes the rows of a contact pair: one for each slave node of this
   * rank, in the order of Surface::owned_nodes(), and behind them those for points
   * between nodes. Registered by name.
   */
  class Pairing
  {
  public:
    explicit Pairing(const PairingInput &input)
      : input(input)
    {
    }

    virtual ~Pairing() = default;

    /** @brief Rows for points between nodes (ContactRow::between_nodes): so many for each slave
     * node, those of all nodes one after the other behind the rows of the nodes. The same on all
     * ranks. */
    virtual unsigned int
    rows_between_nodes() const
    {
      return 0;
    }

    /** @brief Whether slave nodes themselves are kept out of the master. If not, the rows of nodes
     * never have a partner, and all force is between nodes. */
    virtual bool
    keeps_nodes_out() const
    {
      return true;
    }

    /** @brief What holds a node that its row loses over an edge of the master. */
    virtual BeyondEdge
    beyond_edge() const
    {
      return BeyondEdge::free;
    }

    /**
     * @brief Read the deformed surfaces: set has_partner, stencil, normal, gap_vector and gap
     * of all rows, and area, share, lever and motion where they change. What else the rows
     * hold is not changed.
     * @param u    Displacement with ghosts; the surfaces have been moved to it.
     * @param time For obstacles that move.
     * @param rows Rows of this pair, already there.
     */
    virtual void
    update(const Vector &u, double time, std::vector<ContactRow> &rows) = 0;

    /**
     * @brief Set the derivative of the rows that were active (ContactRow::was_active), for the
     * consistent linearisation. Called after update() with the same arguments, on all ranks.
     *
     * A pairing that does not implement it keeps normals and stencils constant
     * within a Newton iteration.
     */
    virtual void
    differentiate(const Vector & /*u*/, double /*time*/, std::vector<ContactRow> & /*rows*/)
    {
    }

    /**
     * @brief A step ends or starts with the displacement @p u (with ghosts): what
     * nodes pass through from here on counts. Without a call, steps start from the
     * reference state.
     */
    virtual void
    commit_positions(const Vector & /*u*/)
    {
    }

    /** @brief A step begins, or is tried again with another length; not where it begins again
     * because of what a state of balance has shown. */
    virtual void
    begin_step()
    {
    }

    /** @brief The last update() was in a state of balance: which slave nodes have left edges that
     * they were to stay on, see EdgesUnderNodes. @return Whether the step is to begin again on
     * account of nodes of this rank. */
    virtual bool
    leave_edges()
    {
      return false;
    }

    /** @brief Whether the row of a slave node, by its number among the owned ones, is that of a
     * node on a parallel edge of the master since the last update(), see EdgeOnEdge. */
    virtual bool
    on_edge(std::size_t /*k*/) const
    {
      return false;
    }

    /** @brief The step begins again from the committed state. */
    virtual void
    rollback()
    {
    }

    /** @brief What it knows of earlier steps, for checkpoints; nothing if each update
     * begins anew from positions alone. */
    virtual PairingMemory
    memory() const
    {
      return {};
    }

    /** @brief Restore a memory(), after commit_positions(). It may contain faces of other ranks. */
    virtual void
    remember(const PairingMemory &)
    {
    }

    /** @brief Distance of a point from the master, negative within it, length; infinite where
     * that is not known without a search. */
    virtual double
    distance(const dealii::Point<dim> & /*x*/, double /*time*/) const
    {
      return std::numeric_limits<double>::infinity();
    }

    /** @brief Geometry of the row of a slave node at @p x, where it depends on nothing else;
     * nothing where other nodes enter it. */
    virtual std::optional<PointContact>
    at(const dealii::Point<dim> & /*x*/, double /*time*/) const
    {
      return {};
    }

    /** @brief The derivative of at() by the position of @p node, which is at @p x, as of a row
     * without a stencil; null where at() is nothing. @param size Of the slave faces there. */
    virtual std::shared_ptr<const RowDerivative>
    derivative_at(const dealii::Point<dim> & /*x*/,
                  double /*time*/,
                  Index /*node*/,
                  double /*size*/) const
    {
      return nullptr;
    }

    /** @brief Where the master is, if it is rigid. */
    virtual RigidMotion
    motion(double /*time*/) const
    {
      return {};
    }

    /** @brief How far formulas turn a rigid master from one time to another: rotation vector,
     * degrees. */
    virtual dealii::Tensor<1, dim>
    driven_turn(double /*from*/, double /*to*/) const
    {
      return {};
    }

    /** @brief Forces have moved a rigid master so far beside what drives it. */
    virtual void
    set_free_motion(const ToolMotion &)
    {
    }

    /** @brief What the pair covers of the surfaces since the last update(), if rows depend on it;
     * or null. */
    virtual const CoverOfNodes *
    cover() const
    {
      return nullptr;
    }

    /** @brief From the next update() on, how far other pairs cover the rest of slave nodes of which
     * this one covers a part, see cover_by_other_pairs().
     * @param part With ghosts; null: nowhere. @return Whether rows change by that. */
    virtual bool
    set_cover_by_others(const Vector * /*part*/)
    {
      return false;
    }

    /** @brief Amount of work of its searches so far; zero without any. */
    virtual SearchWork
    search_work() const
    {
      return {};
    }

  protected:
    const PairingInput input;
  };

  /** @brief The pairings that the key "Pairing" of a contact pair names. */
  using PairingRegistry = Registry<Pairing, const PairingInput &>;

  /** @brief The pairing with an obstacle. */
  std::shared_ptr<Pairing>
  make_obstacle_pairing(const PairingInput &input);

  /** @brief The pairing @p of_nodes, whose rows come first, with rows for what touches between
   * slave nodes: one more for each node, in the same order. */
  std::shared_ptr<Pairing>
  make_edge_pairing(const PairingInput &input, const std::shared_ptr<Pairing> &of_nodes);

  /** @brief The pairing that the parameters choose, or that with the obstacle. */
  inline std::shared_ptr<Pairing>
  make_pairing(const PairingInput &input)
  {
    return input.obstacle ? make_obstacle_pairing(input) : input.parameters->pairing.make(input);
  }
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_row_h
#define touchstone_contact_row_h

#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/algebra/stencil.h>
#include <touchstone/base/types.h>
#include <touchstone/contact/rigid_motion.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace Touchstone
{
  struct FrictionRow;

  /**
   * @brief How a row changes with the positions x_a of the nodes that its geometry
   * depends on: the slave node, its master nodes, and those that their normals
   * and averages come from.
   */
  struct RowDerivative
  {
    /** The nodes a, each once; may be owned by any rank. */
    std::vector<Index> nodes;
    /** d normal / d x_a: entry [i][j] is d n_i / d x_aj, per length. */
    std::vector<dealii::Tensor<2, dim>> normal;
    /** d gap_vector / d x_a, no unit. */
    std::vector<dealii::Tensor<2, dim>> gap_vector;
    /** weights[m][a] = d w_m / d x_a, in the order of the stencil, per length. */
    std::vector<std::vector<dealii::Tensor<1, dim>>> weights;
    /** d area / d x_a, length; empty where the area does not change. */
    std::vector<dealii::Tensor<1, dim>> area;
  };

  /**
   * @brief One slave node must not move through a weighted combination of
   * master nodes (doc/theory.md 3): the only form in which enforcement sees contact.
   *
   * With M = [I, -w_1 I, ...] the gap is g = n . (M x + offset) and the contact
   * force f = lambda_n n + t_T acts as M^T f. An obstacle is a row with an empty
   * stencil.
   *
   * A row is geometry. It is written by the pairing, and by ContactPair, which applies
   * small sliding and initial overlaps; for all other classes it is const. The state of a row
   * (status and forces) belongs to the enforcement, see RowState, the history of friction
   * to Friction, see FrictionRow.
   */
  struct ContactRow
  {
    /** @name Constant on a mesh */
    /** @{ */
    /** Number of the contact pair. */
    unsigned int pair = 0;
    /** Number of the row among those of this rank, over all pairs: its entry in arrays that
     * are parallel to the rows, see RowArray. */
    std::size_t index = 0;
    /** The slave node; owned by this rank. */
    Index slave = invalid_index;
    /** Its reference position. */
    dealii::Point<dim> reference;
    /** Size of the slave faces at the node, length; makes gaps nondimensional. */
    double size = 1.;
    /** Scale of contact forces per gap, force per length: Young's modulus of the
     * softer body times area over size. The complementarity constant c. */
    double stiffness = 1.;
    /** Body of the slave node, and of the master; invalid_unsigned_int if that is an obstacle. */
    unsigned int body = 0, master_body = 0;

    /** @brief The master is rigid: it has no nodes, and other nodes in the stencil are of the slave
     * (points between nodes). */
    bool
    on_obstacle() const
    {
      return master_body == dealii::numbers::invalid_unsigned_int;
    }

    /** Constrained in all components, in tension too. */
    bool tied = false;
    /** What touches is not the slave node but a point between slave nodes: of an edge that crosses
     * an edge of the master, or of a face in which a vertex of the master lies (doc/theory.md 4.2).
     * Slave nodes may have such a row besides their own. The other nodes of the edge or face are in
     * its stencil, with negative weights, and it has no area. */
    bool between_nodes = false;
    /** Friction of the row, owned by Friction; null without friction. */
    const FrictionRow *friction = nullptr;
    /** @} */

    /** @name Input of the pairing */
    /** @{ */
    /** The row was active when the pairing was called: a node in contact keeps its partner beyond
     * the edge of the master surface farther than an open one finds it (hysteresis), and only such
     * rows are differentiated. */
    bool was_active = false;
    /** @} */

    /** @name Set by each update */
    /** @{ */
    /** A master face is within reach. Where there is none, the rest has no meaning. */
    bool has_partner = false;
    /** A number of the face, edge or vertex of the master that it touches, in this update and in
     * the one before, for messages; zero where there is none, and of means over several faces. */
    std::uint64_t touches = 0, touched = 0;
    /** Master nodes and their weights; may be owned by any rank. Slave nodes of partly covered
     * faces whose basis functions are aggregated with that of this row are among them, with
     * negative weights (doc/theory.md 3.1, equation (5)), and so are those of rows between nodes.
     * The sum is one. */
    std::vector<StencilEntry> stencil;
    /** Of a tied row whose slave point is not on the facets of the master: the stencil of the place
     * there alone, without what carries the offset (doc/theory.md 4.6); null elsewhere. */
    std::shared_ptr<const Stencil> at_surface;
    /** Set by Pairing::differentiate(), null while normal and stencil are taken
     * as constant. */
    std::shared_ptr<const RowDerivative> derivative;
    /** Unit outward normal of the master surface at the contact point. */
    dealii::Tensor<1, dim> normal;
    /** Gap vector x_s - x_contact, length. */
    dealii::Tensor<1, dim> gap_vector;
    /** Gap, negative for penetration, length. */
    double gap = 0.;
    /** Tributary area of the slave node in the reference state, as far as it is covered:
     * lambda / area is the pressure. */
    double area = 0.;
    /** Where other slave nodes are in the stencil, with negative weights, the force on all of
     * them is `share` times that on the slave node, and so is the area, and acts at `lever`
     * (length) from it. Gap and gap vector are `share` times those of the surfaces. */
    double                 share = 1.;
    dealii::Tensor<1, dim> lever;
    /** Current position of the slave node. */
    dealii::Point<dim> position;
    /** Of a row without a partner: the master surface is not closer, length; zero if that is not
     * known, as after a step. */
    double away = 0.;
    /** Where the obstacle is; at rest for a master body. */
    RigidMotion motion;
    /** How far its point at the contact point of a row between nodes has moved since the step
     * began, length. */
    dealii::Tensor<1, dim> moved;
    /** Of a point inside a slave face: two material vectors there, see
     * Surface::material_tangents(); null: those of the node. */
    std::shared_ptr<const std::array<Stencil, 2>> tangents;
    /** @} */

    /** @brief The fields that a step begins with: the one list of what checkpoints hold of a
     * row. The others are set by the constructor of the pair or by each update. */
    template <class Row, class Visitor>
    static void
    visit_state(Row &row, Visitor &&visit)
    {
      visit(row.has_partner);
      visit(row.stencil);
      visit(row.normal);
      visit(row.gap_vector);
      visit(row.gap);
      visit(row.area);
      visit(row.share);
      visit(row.lever);
      visit(row.position);
      visit(row.motion.shift);
      // Known from the pairing, whose update comes before a row is read; checkpoints of earlier
      // versions have no rotation.
      if (row.motion.turned)
        visit(row.motion.turn);
    }
  };

  /** @brief Where the master is touched, length. */
  inline dealii::Point<dim>
  contact_point(const ContactRow &row)
  {
    return row.position + row.lever - row.gap_vector / row.share;
  }

  /** @brief Whether a row that was active has lost what it touched in the update before, or touches
   * something else. */
  inline bool
  exchanged(const ContactRow &row)
  {
    return row.was_active && (!row.has_partner || row.touches != row.touched);
  }

  /** @brief Whether a row with a derivative changes so fast that the derivative is not valid over
   * a Newton increment: the normal over a sharp edge at a very small gap, averages over a
   * sliver of coverage. Such a row is better frozen. */
  bool
  changes_steeply(const ContactRow &row);

  /** @brief The contact rows of this rank, pair after pair, in the order of their index. */
  using ContactRows = std::vector<std::reference_wrapper<const ContactRow>>;
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_results_h
#define touchstone_contact_results_h

#include <touchstone/base/types.h>
#include <touchstone/contact/row_state.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <set>
#include <vector>

namespace Touchstone
{
  class Contact;
  struct ContactRow;

  /** @brief Result at one node of a slave surface, or of a master surface; each rank has those it
   * owns. */
  struct ContactPoint
  {
    unsigned int           pair;
    Index                  node;
    dealii::Point<dim>     reference_position;
    dealii::Tensor<1, dim> displacement;
    dealii::Tensor<1, dim> normal;
    double                 gap;
    /** Tributary area in the reference state, as far as it is covered, with the areas that
     * aggregation has added to this node (doc/theory.md 3.1). */
    double area;
    /** Normal force divided by this area. */
    double pressure = 0.;
    /** Contact force divided by this area. */
    dealii::Tensor<1, dim> traction;
    /** Contact force. */
    dealii::Tensor<1, dim> force;
    /** Point of action of the force, relative to the node; length. */
    dealii::Tensor<1, dim> lever;
    /** Tangential slip of the last step, length. */
    dealii::Tensor<1, dim> slip;
    /** Length of the slip path, and work done against friction, force times
     * length. */
    double        slip_length = 0., friction_work = 0.;
    ContactStatus status;
  };

  /** @brief A slave or master face as polygon for VTU output: nodes in lexicographic order,
   * 4 for degree 1 and 9 for degree 2. */
  struct ContactFace
  {
    unsigned int         pair;
    unsigned int         degree;
    std::array<Index, 9> nodes;

    /** @brief A node that has no result of its own: it follows others. */
    struct HangingNode
    {
      Index              node;
      dealii::Point<dim> reference_position;
      Stencil            follows;
    };
    std::vector<HangingNode> hanging = {};
  };

  /** @brief Sums over the slave nodes of one pair, over all ranks. */
  struct PairResult
  {
    /** Force of the master on the slave body. */
    dealii::Tensor<1, dim> force;
    /** Its mean over the step, of which it is the end in implicit dynamics; else the same. */
    dealii::Tensor<1, dim> mean_force;
    /** Moment of that force about the origin of the reference frame. */
    dealii::Tensor<1, dim> moment;
    /** Tributary area of the nodes in contact. */
    double area         = 0.;
    double max_pressure = 0.;
    /** Largest penetration, >= 0, length. */
    double       max_penetration = 0.;
    unsigned int active          = 0;
    unsigned int stick           = 0;
    unsigned int slip            = 0;
    /** Work done against friction since the start, force times length. */
    double friction_work = 0.;

    /** @brief For checkpoints. All members are named, so that this does not compile if one is
     * forgotten. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      auto &[f, mean, m, a, pressure, penetration, in_contact, sticks, slips, work] = *this;
      archive &f &m &a &pressure &penetration &in_contact &sticks &slips &work;
    }
  };

  /** @brief Boundaries of the slave and of the master surface of a pair, by
   * body; empty for an obstacle. */
  struct PairBoundaries
  {
    unsigned int                         slave_body, master_body;
    std::set<dealii::types::boundary_id> slave, master;
  };

  /** @brief Result at the slave node of a row. */
  ContactPoint
  contact_point(const Contact &contact, const ContactRow &row, const Vector &u);

  /** @brief Results at this rank's slave nodes in displacement @p u. */
  std::vector<ContactPoint>
  contact_points(const Contact &contact, const Vector &u);

  /** @brief Slave faces of this rank, for VTU output. */
  std::vector<ContactFace>
  contact_faces(const Contact &contact);

  /** @brief Contact at this rank's nodes of the master surfaces in displacement @p u: what the rows
   * do to them, so that forces of both sides add up to zero, and those of a side to the force of
   * its pair. Area, pressure, traction and gap are the means of the rows that have the node in
   * their stencil, see PositiveSpread; `normal` is that of the master surface. Obstacles have no
   * nodes. Collective. */
  std::vector<ContactPoint>
  master_points(const Contact &contact, const Vector &u);

  /** @brief What rows hand on of their areas to the Surface::owned_nodes() of the master of a pair
   * with the weights of forces, of either sign. Collective. */
  std::vector<double>
  areas_on_master(const Contact &contact, unsigned int pair);

  /** @brief Master faces of this rank. */
  std::vector<ContactFace>
  master_faces(const Contact &contact);

  /** @brief Sums per pair over all ranks. Collective. */
  std::vector<PairResult>
  pair_results(const Contact &contact, const Vector &u);

  /** @brief Boundaries of each pair, in the order of the pairs. */
  std::vector<PairBoundaries>
  pair_boundaries(const Contact &contact);
} // namespace Touchstone

#endif

#ifndef touchstone_contact_row_h
#define touchstone_contact_row_h

#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/algebra/stencil.h>
#include <touchstone/base/types.h>
#include <touchstone/contact/friction/friction.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <memory>
#include <optional>
#include <vector>

namespace Touchstone
{
  /** @brief What a contact row does at present. */
  enum class ContactStatus : int
  {
    /** No master face within reach, or beyond the edge of the master surface. */
    no_partner = -1,
    /** A master face is there, but the gap is open. */
    open = 0,
    /** In contact, free to slide. */
    slip = 1,
    /** In contact, held in the tangential directions. */
    stick = 2,
    /** All components constrained, compression and tension. */
    tied = 3
  };

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
   * master nodes: the only thing that enforcement knows of contact.
   *
   * With M = [I, -w_1 I, ...] the gap is g = n . (M x + offset) and the contact
   * force f = lambda_n n + t_T acts as M^T f. An obstacle is a row with an empty
   * stencil.
   */
  struct ContactRow
  {
    /** Number of the contact pair. */
    unsigned int pair = 0;
    /** The slave node; owned by this rank. */
    Index slave = invalid_index;
    /** Master nodes and their weights; may be owned by any rank. Slave nodes that have
     * left their share to this row are among them, with negative weights. The sum is one. */
    std::vector<StencilEntry> stencil;
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
    /** Size of the slave faces at the node, length; makes gaps nondimensional. */
    double size = 1.;
    /** Scale of contact forces per gap, force per length: Young's modulus of the
     * softer body times area over size. The complementarity constant c. */
    double stiffness = 1.;
    /** Body of the slave node, and of the stencil. */
    unsigned int body = 0, master_body = 0;
    /** Current position of the slave node. */
    dealii::Point<dim> position;
    /** Held in all components, in tension too. */
    bool tied = false;
    /** Conditions of the row that the constraint graph took and refused: what a
     * refused one asks for is decided by others. */
    unsigned int accepted = 0, refused = 0;
    /** Depends on itself over rows of earlier pairs, and asks for nothing. */
    bool closes_circle = false;
    /** The first of them, along the normal, was taken. */
    bool normal_accepted = true;
    /** Gap that the enforcement grants for now: the penetration of a penalty. */
    double granted_gap = 0.;
    /** Normal and other force at the last augmentation of an augmented
     * Lagrangian. */
    double                 augmented_lambda = 0.;
    dealii::Tensor<1, dim> augmented;
    /** Contact force on the slave node, force: lambda_n n + t_T. */
    dealii::Tensor<1, dim> force;
    /** Normal contact force, >= 0 in compression. */
    double        lambda = 0.;
    ContactStatus status = ContactStatus::no_partner;
    /** Motion of the obstacle since time 0, length; zero for a master body. */
    dealii::Tensor<1, dim> shift;
    /** What an impact without rebound adds to the force of the last step, for results
     * only; force. */
    dealii::Tensor<1, dim> jump;
    /** Only where there is friction. */
    std::optional<FrictionState> friction;

    bool
    active() const
    {
      return status >= ContactStatus::slip;
    }

    /** @brief No relative motion is left to the row: tied, or stick that is not
     * left to springs. */
    bool
    held() const
    {
      return tied || (status == ContactStatus::stick && friction && friction->hold);
    }

    /** @brief No contact force of any kind. */
    void
    clear_force()
    {
      lambda = augmented_lambda = 0.;
      force = augmented = dealii::Tensor<1, dim>();
      if (friction)
        friction->clear_force();
    }

    /** @brief Active, but all that it asks for is decided by others. */
    bool
    dropped() const
    {
      return accepted == 0 && refused > 0;
    }

    /** @brief Take note of whether the constraint graph accepted a condition, the one
     * along the normal first; returns that. */
    bool
    take(const Condition &condition, const bool was_accepted)
    {
      if (accepted + refused == 0)
        normal_accepted = was_accepted;
      else if (!was_accepted && held() && friction)
        friction->unheld.push_back(condition.direction);
      ++(was_accepted ? accepted : refused);
      return was_accepted;
    }
  };
} // namespace Touchstone

#endif

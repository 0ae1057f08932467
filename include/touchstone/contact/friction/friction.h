// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_friction_friction_h
#define touchstone_contact_friction_friction_h

#include <touchstone/algebra/stencil.h>
#include <touchstone/base/types.h>
#include <touchstone/contact/friction/friction_law.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief T_n = I - n n, the projector onto the plane of the unit normal n. */
  dealii::Tensor<2, dim>
  tangential_projector(const dealii::Tensor<1, dim> &normal);

  /** @brief History of the friction of a row from one step to the next. Vectors are stored by their
   * components in the frame that moves with the slave surface. */
  struct FrictionHistory
  {
    /** The convected contact point of the start of the step: a point of the master body by
     * its stencil, or an offset (obstacle, small sliding); and the tangential displacement of
     * the node relative to it, then. */
    bool                   has_anchor = false;
    Stencil                anchor;
    dealii::Tensor<1, dim> anchor_offset;
    std::array<double, 2>  anchor_displacement{};
    /** The gap at that time, and the pre-contact tangential offset: the displacement that an open
     * node is predicted to make until it touches, which is no slip (doc/theory.md 6.2, equation
     * (19)); part of anchor_displacement. */
    double                anchor_gap = 0.;
    std::array<double, 2> precontact_offset{};
    /** Tangential force. */
    std::array<double, 2> traction{};
    /** Slip path, length, and work done against friction, force times length: both of the
     * irreversible slip only. */
    double slip_length = 0., work = 0.;

    /** @brief The one list of what checkpoints hold. */
    template <class History, class Visitor>
    static void
    visit_state(History &h, Visitor &&visit)
    {
      visit(h.has_anchor);
      visit(h.anchor);
      visit(h.anchor_offset);
      visit(h.anchor_displacement);
      visit(h.anchor_gap);
      visit(h.precontact_offset);
      visit(h.traction);
      visit(h.slip_length);
      visit(h.work);
    }
  };

  /** @brief The slip of a row: a function of its history and of the present positions alone. */
  struct SlipKinematics
  {
    using Vec = dealii::Tensor<1, dim>;
    using Mat = dealii::Tensor<2, dim>;

    /** Tangential slip since the step began. */
    Vec slip;
    /** Tributary area of the row. */
    double area = 0.;
    /** Time at the end of the step, and the length of the step in time. */
    double time = 0., step = 0.;
    /** Unit tangents; the first one is carried along with the slave surface. */
    std::array<Vec, 2> frame;
    /** Projector onto the directions that friction can act along, which are tangential and
     * lie in the planes of symmetry, and an orthonormal basis of them. */
    Mat              tangential;
    std::vector<Vec> tangents;
    /** The tangential force at the start of the step, carried along with the frame: t_b of
     * regularised friction. */
    Vec start;
    /** d slip / d x_a, and the rate at which the frame turns about the normal,
     * d omega / d x_a: set for the consistent linearisation only. */
    std::vector<std::pair<Index, Mat>> slip_gradient;
    std::vector<std::pair<Index, Vec>> spin_gradient;

    /** @brief A tangential vector from its components in the moving frame. */
    Vec
    carry(const std::array<double, 2> &components) const
    {
      return components[0] * frame[0] + components[1] * frame[1];
    }

    /** @brief The components in the moving frame. */
    std::array<double, 2>
    components(const Vec &vector) const
    {
      return {{vector * frame[0], vector * frame[1]}};
    }

    /** @brief The one list of what checkpoints hold. */
    template <class Kinematics, class Visitor>
    static void
    visit_state(Kinematics &k, Visitor &&visit)
    {
      visit(k.slip);
      visit(k.frame);
      visit(k.start);
    }
  };

  /** @brief Friction of one row. Owned by Friction: const for everybody else. */
  struct FrictionRow
  {
    /** @name Constant on a mesh */
    /** @{ */
    const FrictionLaw *law = nullptr;
    /** Normals of the planes of symmetry that the node lies on: the mirrored half of the body
     * cancels the friction along them. */
    std::vector<dealii::Tensor<1, dim>> mirrors;
    /** Two material vectors of the slave surface at the node, see Surface::material_tangents(). */
    std::array<Stencil, 2> material_tangents;
    /** Small sliding: slip is measured by the gap vector. */
    bool small = false;
    /** Stick without elastic slip, where the enforcement permits it. */
    bool exact = true;
    /** Stiffness of regularised stick alpha_t, force per length. */
    double alpha = 1.;
    /** @} */

    FrictionHistory history;
    SlipKinematics  kinematics;

    /** @brief The cone of the law under a normal force.
     * @param slip Irreversible slip of the step, length. */
    FrictionLimit
    cone(double normal_force, bool sliding, double slip = 0.) const;

    /** @brief The cone of a slipping row whose elastic slip is stored in springs of stiffness
     * @p c: its irreversible slip (|t_tr| - L) / c depends on the limit L, and L on that slip.
     * @param trial Size of the trial force |t_tr|. */
    FrictionLimit
    cone_of_springs(double normal_force, double trial, double c) const;

    /** @brief Derivative of a limit with respect to the irreversible slip of the step, force per
     * length. */
    double
    slip_derivative(const FrictionLimit &limit) const
    {
      return limit.slip_slope + (kinematics.step > 0. ? limit.rate_slope / kinematics.step : 0.);
    }

    /** @brief The one list of what checkpoints hold. */
    template <class Row, class Visitor>
    static void
    visit_state(Row &row, Visitor &&visit)
    {
      FrictionHistory::visit_state(row.history, visit);
      SlipKinematics::visit_state(row.kinematics, visit);
    }
  };
} // namespace Touchstone

#endif

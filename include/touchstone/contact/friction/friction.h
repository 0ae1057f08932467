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
  struct ContactRow;

  /** @brief I - n n, what is left of a vector in the plane of the unit normal n. */
  dealii::Tensor<2, dim>
  tangential_projector(const dealii::Tensor<1, dim> &normal);

  /**
   * @brief Friction of one slave node: its history, its present slip, and the
   * response that enters the linear system.
   *
   * The tangential force follows a trial force, t_tr = base - c s, with the slip s
   * of the step: inside the cone of radius L(lambda) the node sticks, outside it
   * slips with t = L t_tr / |t_tr|. What base and c are makes the formulation:
   * - regularised (elastic-plastic slip): the force at the start of the step,
   *   carried along with the slave surface, and alpha_t;
   * - augmented Lagrangian: the force at the last augmentation, and its penalty;
   * - exact: the force of the last iteration, and the complementarity constant.
   *   The node is then held by conditions while it sticks.
   *
   * Simo and Laursen (1992), Comput. Struct. 42; Alart and Curnier (1991), Comput.
   * Methods Appl. Mech. Engng 92; Hueeber, Stadler and Wohlmuth (2008), SIAM J. Sci.
   * Comput. 30.
   */
  struct FrictionState
  {
    using Vec = dealii::Tensor<1, dim>;
    using Mat = dealii::Tensor<2, dim>;

    const FrictionLaw *law = nullptr;
    /** Normals of the planes of symmetry that the node lies on: the other half of the body
     * cancels what friction there is along them. */
    std::vector<Vec> mirrors;
    /** No elastic slip, where the enforcement can do without. */
    bool exact = true;
    /** Stiffness of regularised stick alpha_t, force per length. */
    double alpha = 1.;

    /** @name History, as of the last converged step */
    /** @{ */
    /** Where the node touched when the step began: a point of the master body by
     * its stencil, or an offset (obstacle, small sliding); and the tangential way
     * of the node from there, in the moving frame. */
    bool                  has_anchor = false;
    Stencil               anchor;
    Vec                   anchor_offset;
    std::array<double, 2> anchor_way{};
    /** The gap then, and the tangential way that an open node had yet to go until
     * it touches, which is no slip: part of anchor_way. */
    double                anchor_gap = 0.;
    std::array<double, 2> way_to_touch{};
    /** Tangential force in the frame that moves with the slave surface. */
    std::array<double, 2> stored{};
    /** Slip path, length, and work done against friction: of the slip that is
     * not elastic. */
    double slip_length = 0., work = 0.;
    /** @} */

    /** @name Present kinematics */
    /** @{ */
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
    /** The stored force in the present frame. */
    Vec start;
    /** d slip / d x_a, and the rate at which the frame turns about the normal,
     * d omega / d x_a: set for the consistent linearisation only. */
    std::vector<std::pair<Index, Mat>> slip_gradient;
    std::vector<std::pair<Index, Vec>> spin_gradient;
    /** @} */

    /** @name Formulation, chosen by the enforcement */
    /** @{ */
    /** Conditions hold the node while it sticks. */
    bool hold = false;
    /** Tangents along which no condition holds it, because a support or another pair
     * determines its displacement there: springs with an augmented force do. */
    std::vector<Vec> unheld;
    double           c = 1.;
    Vec              base;
    /** The base is the force that is carried along with the slave surface. */
    bool carried = false;
    /** The force of stick is not unique: see Contact::find_shared_nodes(). */
    bool shared = false;
    /** @} */

    /** @name Response, see respond() */
    /** @{ */
    /** Direction of the force and stiffness, now and in the last linear system;
     * the direction is zero while sticking. */
    Vec direction, last_direction;
    Mat slope, last_slope;
    /** Linearised, t = rest + coupling lambda + area_coupling dA - slope ds - turn omega
     * + slip_coupling (slip_direction . ds), the last where the limit depends on the slip. */
    Vec rest, coupling, area_coupling, turn, slip_coupling, slip_direction;
    /** Radius of the cone, force. */
    double limit = 0.;
    /** |t_tr| - L, force: positive asks for slip, negative for stick. */
    double excess = 0.;
    /** @} */

    void
    clear_force();

    /** @brief Set the directions that friction can act along, from the frame. */
    void
    find_tangents(const Vec &normal);

    /** @brief A tangential vector from its components in the moving frame. */
    Vec
    carry(const std::array<double, 2> &components) const
    {
      return components[0] * frame[0] + components[1] * frame[1];
    }

    /** @brief The cone of the law under a normal force.
     * @param slip Irreversible slip of the step, length. */
    FrictionLimit
    cone(double normal_force, bool sliding, double slip = 0.) const;

    /** @brief The cone of a slipping row whose elastic slip is stored in springs of stiffness c:
     * its irreversible slip (|t_tr| - L) / c depends on the limit L, and L on that slip.
     * @param trial Size of the trial force |t_tr|. */
    FrictionLimit
    cone_of_springs(double normal_force, double trial) const;

    /** @brief Derivative of a limit with respect to the irreversible slip of the step, force per
     * length. */
    double
    slip_derivative(const FrictionLimit &limit) const
    {
      return limit.slip_slope + (step > 0. ? limit.rate_slope / step : 0.);
    }

    /** @brief The slip of the present step without its elastic part, the change of
     * the springs that regularised friction stores its force in.
     * @param force The present tangential force. */
    Vec
    irreversible_slip(const Vec &force) const;

    /** @brief Force per length of the springs along unheld tangents.
     * @param stiffness ContactRow::stiffness. */
    static double
    unheld_stiffness(const double stiffness)
    {
      return 100. * stiffness;
    }

    /** @brief Let the springs along unheld tangents take the force that the present slip
     * asks for. */
    void
    augment_unheld(const double stiffness)
    {
      for (const Vec &tangent : unheld)
        base -= unheld_stiffness(stiffness) * (slip * tangent) * tangent;
    }

    /** @brief Take the regularised formulation. */
    void
    regularise()
    {
      hold    = false;
      carried = true;
      c       = alpha;
      base    = start;
    }
  };

  /** @brief Take the formulation of an enforcement that holds what sticks by
   * conditions: exact, unless the scene asks for regularised stick. */
  void
  choose_friction(ContactRow &row);

  /**
   * @brief Evaluate the friction of an active row from its normal force, slip and
   * status: sets the row's force and the response. A row without friction gets
   * force = lambda n; one that is tied is left alone.
   */
  void
  respond(ContactRow &row);
} // namespace Touchstone

#endif

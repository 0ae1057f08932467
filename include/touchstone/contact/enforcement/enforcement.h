#ifndef touchstone_contact_enforcement_enforcement_h
#define touchstone_contact_enforcement_enforcement_h

#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/algebra/linear_system.h>
#include <touchstone/base/registry.h>
#include <touchstone/contact/contact.h>

#include <functional>
#include <vector>

namespace Touchstone
{
  /** @brief What a linear solve has found. */
  struct LinearSolution
  {
    /** The system, and the graph with its conditions. */
    const LinearSystem    &system;
    const ConstraintGraph &graph;
    /** Displacement increment of this rank's unknowns, all of it. */
    const Vector &increment;
    /** Extra unknowns of this rank. */
    const std::vector<double> &extra;
    /** Adds the forces on hanging nodes to the nodes that these follow. */
    std::function<void(Vector &)> condense;
  };

  /**
   * @brief Turns active rows into parts of the linear system, and its solution
   * into contact forces. Never asks where a row came from. Registered by name.
   *
   * In each Newton iteration: recover() with the prescribed displacements in the
   * graph, then the active set is updated, then enforce(), then the system is
   * solved, then take() and update().
   */
  class Enforcement
  {
  public:
    virtual ~Enforcement() = default;

    /** @brief Whether contact forces are unknowns of the linear system, which then is not
     * definite. */
    virtual bool
    uses_multipliers() const
    {
      return false;
    }

    /** @brief A step begins, or begins again: no linear solve has come before. */
    virtual void
    begin_step()
    {
    }

    /**
     * @brief Bring the contact forces of the rows up to date before they are
     * judged, by respond() where there may be friction.
     * @param unbalanced External minus internal forces, without contact forces.
     * @param graph      Holds the prescribed displacements only.
     */
    virtual void
    recover(Contact &contact, const Vector &unbalanced, const ConstraintGraph &graph) = 0;

    /** @brief Offer the active rows to the graph and add terms and extra unknowns
     * to the system, whose right-hand side holds no contact forces: RowTerms adds
     * those of friction afterwards. Rows take note of what the graph refuses. */
    virtual void
    enforce(Contact &contact, ConstraintGraph &graph, LinearSystem &system) = 0;

    /** @brief The forces are in balance with the active set as it is; called
     * before convergence is judged by the gaps. */
    virtual void
    balanced(Contact &)
    {
    }

    /** @brief Contact::drop_circles() takes out rows that depend on each other in a circle
     * by components of their normals larger than this: by default those that are about
     * dependent, and say the same thing twice. */
    virtual double
    smallest_circle() const
    {
      return 0.3;
    }

    /** @brief Force that the round-off of positions of magnitude @p length leads
     * to: the residual cannot fall below it. Of this rank's rows, squared. */
    virtual double
    round_off_squared(const Contact &, const double) const
    {
      return 0.;
    }

    /** @brief Take from a solution what contact forces are made of. Collective. */
    virtual void
    take(const LinearSolution & /*solution*/)
    {
    }

    /** @brief Set the forces of the rows to those of the last solution; called again, with the
     * rows as they were before, where a part of the increment is taken back. */
    virtual void
    update(Contact &contact) = 0;
  };

  using EnforcementRegistry = Registry<Enforcement, const ContactParameters &>;
} // namespace Touchstone

#endif

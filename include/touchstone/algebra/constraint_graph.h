// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_constraint_graph_h
#define touchstone_algebra_constraint_graph_h

#include <touchstone/algebra/stencil.h>
#include <touchstone/algebra/vector.h>
#include <touchstone/base/types.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/tensor.h>
#include <deal.II/lac/affine_constraints.h>

#include <array>
#include <boost/container/flat_map.hpp>
#include <functional>
#include <map>
#include <vector>

namespace Touchstone
{
  /**
   * @brief One linear condition on the displacement increment of a node,
   *
   *   d . (du_s - sum_m w_m du_m) = value,
   *
   * and the force that meets it: along d on the node and -w_m d on the others,
   * which makes the system symmetric. Where the two are not the same, the force
   * acts along another direction (friction), or the condition has coefficients of
   * its own (change of normals and stencils); the system is then unsymmetric.
   *
   * Prescribed displacements and symmetry are conditions without a stencil,
   * contact rows have one.
   */
  struct Condition
  {
    /** Node whose displacement the condition determines; owned by this rank. */
    Index node = invalid_index;
    /** Unit direction d. */
    dealii::Tensor<1, dim> direction;
    Stencil                stencil;
    double                 value = 0.;
    /** Direction of the force; zero: d. */
    dealii::Tensor<1, dim> force_direction;
    /** All coefficients of the condition by node; empty: those of d and stencil. */
    NodalForm gradient;
    /** Body of the node, and of the stencil. */
    unsigned int body = 0, master_body = 0;
    /** Position of the node and of the stencil's point, for rigid-body modes. */
    dealii::Tensor<1, dim> position, master_position;

    /** @brief The force meets the condition along its own coefficients. */
    bool
    symmetric() const
    {
      return force_direction.norm_square() == 0. && gradient.empty();
    }

    /** @brief The direction of the force on the node. */
    const dealii::Tensor<1, dim> &
    force() const
    {
      return force_direction.norm_square() > 0. ? force_direction : direction;
    }

    /** @brief What of the displacement increment the condition prescribes. */
    NodalForm
    motion_form() const
    {
      return gradient.empty() ? relative_motion(node, stencil, direction) : gradient;
    }

    /** @brief What the force of the condition does work on. */
    NodalForm
    force_form() const
    {
      return relative_motion(node, stencil, force());
    }
  };

  /**
   * @brief Decides which conditions are linearly independent (doc/theory.md,
   * sections 6 and 7).
   *
   * Conditions are added (accept()) in the order of their precedence: prescribed
   * displacements first, then contact. One whose direction is already determined
   * by earlier conditions of the same node is rejected: it would make the system
   * singular or contradictory. Conditions at one node are kept in reduced form,
   * each with a component of its own that later ones do not contain.
   */
  class ConstraintGraph
  {
  public:
    /** @brief Remove all conditions. */
    void
    clear();

    /** @brief How a condition is enforced: by elimination of a dof, or by a multiplier or a
     * spring, whose terms the caller adds to the linear system. */
    enum class Treatment
    {
      eliminate,
      multiplier,
      spring
    };

    /** @brief Add a condition. @return false if it depends linearly on earlier ones and was
     * rejected. */
    bool
    accept(const Condition &condition, Treatment treatment = Treatment::eliminate);

    /** @brief The part of a vector at @p node that no condition accepted so far
     * determines: its projection onto the complement of their directions. */
    dealii::Tensor<1, dim>
    free_part(Index node, dealii::Tensor<1, dim> vector) const;

    const std::vector<Condition> &
    accepted() const
    {
      return conditions;
    }

    /** @brief Note a condition that was rejected and is met by a spring without a dof of its own:
     * it holds bodies as those accepted do. */
    void
    add_spring(const Condition &condition)
    {
      springs.push_back(condition);
    }

    /** @brief Conditions met by springs, see add_spring(). */
    const std::vector<Condition> &
    met_by_springs() const
    {
      return springs;
    }

    /**
     * @brief The conditions to be eliminated, as deal.II constraints on the
     * dofs, each solved for the component of its node with the largest
     * coefficient. The result knows the lines of all dofs that the stencils of
     * this rank's conditions refer to.
     *
     * @param hanging   Constraints of hanging nodes, which go first.
     * @param owned     Dofs of this rank.
     * @param relevant  Dofs whose lines this rank needs besides those of the
     *                  stencils.
     */
    dealii::AffineConstraints<double>
    constraints(const dealii::AffineConstraints<double> &hanging,
                const dealii::IndexSet                  &owned,
                const dealii::IndexSet                  &relevant,
                MPI_Comm                                 communicator) const
    {
      return make_constraints(&ReducedCondition::trial, hanging, owned, relevant, communicator);
    }

    /**
     * @brief The same lines for the test functions, which do no work against the
     * forces of the conditions; without values.
     */
    dealii::AffineConstraints<double>
    test_constraints(const dealii::AffineConstraints<double> &hanging,
                     const dealii::IndexSet                  &owned,
                     const dealii::IndexSet                  &relevant,
                     MPI_Comm                                 communicator) const
    {
      return make_constraints(&ReducedCondition::test, hanging, owned, relevant, communicator);
    }

    /**
     * @brief The change of basis that replaces a displacement by the elongation of a spring, one
     * for each condition that is a spring, as deal.II constraints without chains: x_i =
     * sum_j c_j x_j holds where the spring is rigid (doc/theory.md, section 7, stiff springs).
     *
     * A spring then adds to one diagonal entry, and multigrid sees a stiff spring as it sees an
     * eliminated dof, however stiff. Any change of basis leads to the same solution: references
     * to other dofs of this kind are left out.
     *
     * @param constraints What constraints() has returned.
     */
    dealii::AffineConstraints<double>
    basis_change(const dealii::AffineConstraints<double> &constraints,
                 const dealii::IndexSet                  &owned,
                 const dealii::IndexSet                  &relevant,
                 MPI_Comm                                 communicator) const
    {
      return make_basis_change(
        &ReducedCondition::trial, constraints, owned, relevant, communicator);
    }

    /**
     * @brief The same for the test functions: those of other dofs do no work against the
     * forces of springs, or a spring whose force is not along its elongation (friction) would
     * be as large in the equations of its neighbours as in its own.
     *
     * @param constraints What test_constraints() has returned, or constraints() where these
     *                    are the same.
     */
    dealii::AffineConstraints<double>
    test_basis_change(const dealii::AffineConstraints<double> &constraints,
                      const dealii::IndexSet                  &owned,
                      const dealii::IndexSet                  &relevant,
                      MPI_Comm                                 communicator) const
    {
      return make_basis_change(&ReducedCondition::test, constraints, owned, relevant, communicator);
    }

    /**
     * @brief The forces of the conditions that are eliminated, in the order of accepted();
     * zero for others.
     *
     * With the residual r = b - A x of the solution x, without these forces, they are the
     * solution of r_p + sum_k mu_k F_kp = 0 for the dofs p that are eliminated, where F_k
     * is what condition k acts on. Conditions that refer to dofs which others eliminate
     * are solved one after the other; that ends, or converges
     * where small coefficients lead back (see resolve_cycles()).
     *
     * @param residual Out-of-balance forces of this rank's dofs.
     * @param condense Adds the forces on hanging nodes to the nodes that these follow.
     * Collective.
     */
    std::vector<double>
    forces(Vector residual, const std::function<void(Vector &)> &condense) const;

    /** @brief Whether all conditions treated in this way are symmetric: then both
     * kinds of constraints, or changes of basis, are the same. Of this rank only. */
    bool
    symmetric(Treatment treatment = Treatment::eliminate) const;

  private:
    /** Coefficients of the node, of other dofs, and the right-hand side. */
    struct Side
    {
      dealii::Tensor<1, dim>                    direction;
      boost::container::flat_map<Index, double> others;
      double                                    value = 0.;
      /** Of which conditions at the node it is a combination, in the order in which these
       * were accepted. */
      dealii::Tensor<1, dim> origin;

      Side() = default;
      Side(Index node, const NodalForm &form, double value);
    };

    struct ReducedCondition
    {
      Treatment    treatment;
      unsigned int pivot;
      /** What it prescribes of displacements, and the force that meets it. */
      Side trial, test;
      bool symmetric;
    };

    dealii::AffineConstraints<double>
    make_constraints(Side ReducedCondition::                 *side,
                     const dealii::AffineConstraints<double> &hanging,
                     const dealii::IndexSet                  &owned,
                     const dealii::IndexSet                  &relevant,
                     MPI_Comm                                 communicator) const;

    dealii::AffineConstraints<double>
    make_basis_change(Side ReducedCondition::                 *side,
                      const dealii::AffineConstraints<double> &constraints,
                      const dealii::IndexSet                  &owned,
                      const dealii::IndexSet                  &relevant,
                      MPI_Comm                                 communicator) const;

    std::vector<Condition>                         conditions, springs;
    std::map<Index, std::vector<ReducedCondition>> nodes;
    /** Index of each accepted condition among those of its node. */
    std::vector<unsigned int> numbers;

    /** Substitute the conditions of the same node into @p reduced. */
    void
    reduce(Index node, ReducedCondition &reduced) const;
  };
} // namespace Touchstone

#endif

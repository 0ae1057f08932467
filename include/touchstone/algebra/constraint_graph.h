#ifndef touchstone_algebra_constraint_graph_h
#define touchstone_algebra_constraint_graph_h

#include <touchstone/contact/row.h>
#include <touchstone/types.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/tensor.h>
#include <deal.II/lac/affine_constraints.h>

#include <array>
#include <map>
#include <vector>

namespace Touchstone
{
  /**
   * @brief One linear condition on the displacement increment of a node,
   *
   *   d . (du_s - sum_m w_m du_m) = value.
   *
   * Prescribed displacements and symmetry are conditions without a stencil,
   * contact rows have one.
   */
  struct Condition
  {
    /** Node whose displacement the condition determines; owned by this rank. */
    Index node = invalid_index;
    /** Unit direction d. */
    dealii::Tensor<1, dim>    direction;
    std::vector<StencilEntry> stencil;
    double                    value = 0.;
    /** Body of the node, and of the stencil. */
    unsigned int body = 0, master_body = 0;
    /** Position of the node and of the stencil's point, for rigid-body modes. */
    dealii::Tensor<1, dim> position, master_position;
  };

  /**
   * @brief The one place that decides which conditions hold together.
   *
   * Conditions are offered in the order of their precedence: prescribed
   * displacements first, then contact. One whose direction is already determined
   * by earlier conditions of the same node is refused: it would make the system
   * singular or contradictory. Conditions at one node are kept in reduced form,
   * each with a component of its own that later ones do not contain.
   */
  class ConstraintGraph
  {
  public:
    /** @brief Forget all conditions. */
    void
    clear();

    /** @brief How a condition is met: by elimination of an unknown, or by a
     * multiplier that somebody else adds. */
    enum class Treatment
    {
      eliminate,
      multiplier
    };

    /** @brief Take note of a condition. @return false if it depends on earlier
     * ones and was refused. */
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

    /**
     * @brief The conditions to be eliminated, as deal.II constraints on the
     * unknowns, each solved for the component of its node with the largest
     * coefficient. The result knows the lines of all unknowns that the stencils of
     * this rank's conditions refer to.
     *
     * @param hanging   Constraints of hanging nodes, which go first.
     * @param owned     Unknowns of this rank.
     * @param relevant  Unknowns whose lines this rank needs besides those of the
     *                  stencils.
     */
    dealii::AffineConstraints<double>
    constraints(const dealii::AffineConstraints<double> &hanging,
                const dealii::IndexSet                  &owned,
                const dealii::IndexSet                  &relevant,
                MPI_Comm                                 communicator) const;

  private:
    struct ReducedCondition
    {
      Treatment              treatment;
      unsigned int           pivot;
      dealii::Tensor<1, dim> direction;
      /** Coefficients of master unknowns. */
      std::map<Index, double> others;
      double                  value;
    };

    std::vector<Condition>                         conditions;
    std::map<Index, std::vector<ReducedCondition>> nodes;

    /** Substitute the conditions of the same node into @p reduced. */
    void
    reduce(Index node, ReducedCondition &reduced) const;
  };
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/base/orthogonal.h>

#include <algorithm>
#include <cmath>

// Linear independence of all conditions on displacements, prescribed ones and contact, decided
// node by node (doc/theory.md, section 6, 'One constraint graph'). Each condition has two sides:
// what it prescribes of trial functions, and the force that meets it, which is the condition on
// test functions (section 6.3, equation (22)). Their translation to deal.II's AffineConstraints is
// in constraint_lines.cc and basis_change.cc, their forces are in constraint_forces.cc.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A condition is refused as dependent if its direction, less what earlier conditions of the
     * node determine, is shorter than this, of a length of one: it is within 0.06 degrees of
     * their span, and its multiplier would be a difference of numbers a thousand times as
     * large (doc/theory.md, section 6). */
    constexpr double dependent = 1e-3;

    /**
     * side <- side - factor * other: a step of elimination, on coefficients, right-hand side and
     * the combination of accepted conditions (origin) alike.
     */
    template <class Side>
    void
    subtract(Side &side, const double factor, const Side &other)
    {
      if (factor == 0.)
        return;
      side.direction -= factor * other.direction;
      side.origin -= factor * other.origin;
      for (const auto &[dof, coefficient] : other.others)
        side.others[dof] -= factor * coefficient;
      side.value -= factor * other.value;
    }

    /** Take the component @p pivot out of @p side by means of @p other, in which it
     * has the coefficient one. */
    template <class Side>
    void
    substitute(Side &side, const unsigned int pivot, const Side &other)
    {
      subtract(side, side.direction[pivot], other);
      side.direction[pivot] = 0.;
    }

    // Scale a side so that its coefficient at the pivot is one, which solves it for that
    // component.
    template <class Side>
    void
    normalise(Side &side, const unsigned int pivot)
    {
      const double factor = 1. / side.direction[pivot];
      side.direction *= factor;
      side.origin *= factor;
      for (auto &entry : side.others)
        entry.second *= factor;
      side.value *= factor;
      side.direction[pivot] = 1.;
    }
  } // namespace



  // Split a form by nodes into the part of the condition's own node, in which the pivot is
  // chosen, and coefficients of all other dofs. The form may name a node several times:
  // terms of equal node add up.
  ConstraintGraph::Side::Side(const Index node, const NodalForm &form, const double value)
    : value(value)
  {
    others.reserve(dim * form.size());
    for (const auto &[other, coefficients] : form)
      if (other == node)
        direction += coefficients;
      else
        for (unsigned int d = 0; d < dim; ++d)
          if (coefficients[d] != 0.)
            others[dim * other + d] += coefficients[d];
  }



  void
  ConstraintGraph::clear()
  {
    conditions.clear();
    springs.clear();
    nodes.clear();
    numbers.clear();
  }



  // Gaussian elimination of the pivots of earlier conditions of the node, from both sides.
  void
  ConstraintGraph::reduce(const Index node, ReducedCondition &reduced) const
  {
    const auto found = nodes.find(node);
    if (found == nodes.end())
      return;
    // In the order of acceptance: each reduced condition is free of the pivots of those before
    // it, so one pass eliminates all.
    for (const ReducedCondition &earlier : found->second)
      {
        substitute(reduced.trial, earlier.pivot, earlier.trial);
        substitute(reduced.test, earlier.pivot, earlier.test);
      }
  }



  // The projection is orthogonal to the directions of the reduced conditions, which are not
  // orthogonal to each other: hence the orthonormal basis first.
  Tensor<1, dim>
  ConstraintGraph::free_part(const Index node, Tensor<1, dim> vector) const
  {
    const auto found = nodes.find(node);
    if (found == nodes.end())
      return vector;
    if (found->second.size() >= dim)
      return Tensor<1, dim>();
    // Gram-Schmidt over one or two directions.
    std::vector<Tensor<1, dim>> basis;
    for (const ReducedCondition &condition : found->second)
      {
        const Tensor<1, dim> direction = orthogonal_part(condition.trial.direction, basis);
        basis.push_back(direction / direction.norm());
      }
    return orthogonal_part(vector, basis);
  }



  // One step of Gaussian elimination with pivoting among the components of the node. Trial and
  // test sides share the pivot, since dof and equation are eliminated together.
  bool
  ConstraintGraph::accept(const Condition &condition, const Treatment treatment)
  {
    ReducedCondition reduced;
    reduced.treatment         = treatment;
    reduced.symmetric         = condition.symmetric();
    reduced.trial             = Side(condition.node, condition.motion_form(), condition.value);
    reduced.test              = Side(condition.node, condition.force_form(), 0.);
    const auto         found  = nodes.find(condition.node);
    const unsigned int number = found == nodes.end() ? 0 : found->second.size();
    if (number >= dim)
      return false; // all directions are determined
    // The condition is itself so far; reduce() notes in origin which earlier ones are subtracted,
    // and forces() needs that to tell the forces of the conditions from those of their
    // combinations.
    reduced.trial.origin[number] = reduced.test.origin[number] = 1.;
    reduce(condition.node, reduced);

    // The component whose smaller coefficient of the two sides is the largest (doc/theory.md,
    // section 6.3): a pivot that is small on either side would make its line ill-conditioned.
    double best = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      {
        // Of components that are nearly equal the first: a normal that turns a little from one
        // Newton iteration to the next should keep its pivot, and with it the pattern of the
        // matrix.
        const double size =
          std::min(std::abs(reduced.trial.direction[d]), std::abs(reduced.test.direction[d]));
        if (size > 1.3 * best)
          {
            best          = size;
            reduced.pivot = d;
          }
      }
    if (best < dependent)
      return false;

    normalise(reduced.trial, reduced.pivot);
    normalise(reduced.test, reduced.pivot);
    std::vector<ReducedCondition> &all = nodes[condition.node];
    // Back-substitution: lines of eliminated dofs must not refer to another eliminated dof of the
    // same node, or they would depend on each other in a cycle. Conditions of multipliers are not
    // solved for a dof.
    if (treatment != Treatment::multiplier)
      for (ReducedCondition &earlier : all)
        {
          if (earlier.treatment != treatment)
            continue;
          substitute(earlier.trial, reduced.pivot, reduced.trial);
          substitute(earlier.test, reduced.pivot, reduced.test);
          earlier.symmetric = earlier.symmetric && reduced.symmetric;
        }
    all.push_back(std::move(reduced));
    conditions.push_back(condition);
    numbers.push_back(number);
    return true;
  }



  bool
  ConstraintGraph::symmetric(const Treatment treatment) const
  {
    for (const auto &[node, reduced] : nodes)
      for (const ReducedCondition &condition : reduced)
        if (condition.treatment == treatment && !condition.symmetric)
          return false;
    return true;
  }
} // namespace Touchstone

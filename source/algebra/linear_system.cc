// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/linear_system.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

// Values of the parts of a linear system without assembling it: linear forms (elongations, gaps)
// and the residual, from which contact forces follow.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /**
     * A copy of @p x with the entries of other ranks that @p for_each_form refers to;
     * multipliers, whose numbers follow those of the displacements, are not in @p x.
     */
    template <class ForEachForm>
    Vector
    with_ghosts(const Vector &x, const ForEachForm &for_each_form)
    {
      const IndexSet     owned = x.locally_owned_elements();
      std::vector<Index> far;
      for_each_form([&](const LinearForm &form) {
        for (const auto &[dof, value] : form)
          if (dof < x.size() && !owned.is_element(dof))
            far.push_back(dof);
      });
      std::sort(far.begin(), far.end());
      IndexSet known(owned);
      known.add_indices(far.begin(), std::unique(far.begin(), far.end()));
      known.compress();
      Vector result(owned, known, x.get_mpi_communicator());
      result = x;
      return result;
    }
  } // namespace



  // One exchange for all forms: the entries of other ranks are collected first.
  std::vector<double>
  evaluate_forms(const std::vector<LinearForm> &forms, const Vector &x)
  {
    const Vector        ghosted = with_ghosts(x, [&](const auto &visit) {
      for (const LinearForm &form : forms)
        visit(form);
    });
    std::vector<double> result;
    for (const LinearForm &form : forms)
      {
        double sum = 0.;
        for (const auto &[dof, value] : form)
          sum += value * ghosted(dof);
        result.push_back(sum);
      }
    return result;
  }



  // b - (A + D + C) x part by part, as in AppliedOperator::multiply(), but without conditions.
  // Forces of the conditions do not appear, so in equilibrium the residual at constrained dofs is
  // minus these forces (ConstraintGraph::forces()). Multipliers act through the terms: columns
  // from first_extra on belong to extra.
  Vector
  LinearSystem::residual(const Vector &displacement, const std::vector<double> &extra) const
  {
    Vector result(rhs);
    stiffness->vmult(result, displacement);
    result.sadd(-1., rhs);
    if (diagonal_shift.size() > 0)
      {
        Vector part(displacement);
        part.scale(diagonal_shift);
        result -= part;
      }
    if (Utilities::MPI::max(static_cast<int>(!terms.empty()), rhs.get_mpi_communicator()) == 0)
      return result;

    const Vector        ghosted = with_ghosts(displacement, [&](const auto &visit) {
      for (const RankOneTerm &term : terms)
        visit(term.right);
    });
    std::vector<Index>  dofs;
    std::vector<double> values;
    for (const RankOneTerm &term : terms)
      {
        // r^T x of the term l r^T, e.g. the elongation of a spring; its force acts along l, also
        // on nodes of other ranks, hence the distributed sum behind the loop.
        double amount = 0.;
        for (const auto &[column, value] : term.right)
          amount += value * (column < rhs.size() ? ghosted(column) : extra[column - first_extra]);
        for (const auto &[row, value] : term.left)
          if (row < rhs.size())
            {
              dofs.push_back(row);
              values.push_back(-value * amount);
            }
      }
    result.add(dofs, values);
    result.compress(VectorOperation::add);
    return result;
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/algebra/cyclic_lines.h>
#include <touchstone/algebra/shared_lines.h>

#include <cmath>
#include <utility>

// Eliminated conditions as lines of deal.II's AffineConstraints, each solved for its pivot
// (doc/theory.md, section 7).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Smaller coefficients are round-off and are left out of constraint lines: references without
     * meaning would make chains longer. */
    constexpr double negligible = 1e-12;
  } // namespace



  AffineConstraints<double>
  ConstraintGraph::make_constraints(Side ReducedCondition::         *side,
                                    const AffineConstraints<double> &hanging,
                                    const IndexSet                  &owned,
                                    const IndexSet                  &relevant,
                                    const MPI_Comm                   communicator) const
  {
    // Lines of owned dofs: hanging nodes first, then each eliminated condition solved for its
    // pivot.
    std::vector<AffineConstraints<double>::ConstraintLine> lines;
    for (const auto &line : hanging.get_lines())
      if (owned.is_element(line.index))
        lines.push_back(line);
    for (const auto &[node, reduced] : nodes)
      for (const ReducedCondition &condition : reduced)
        {
          const Index index = dim * node + condition.pivot;
          if (condition.treatment != Treatment::eliminate)
            continue;
          if (hanging.is_constrained(index))
            continue; // a hanging node follows its neighbours
          lines.emplace_back(index);
          auto       &entries = lines.back().entries;
          const Side &known   = condition.*side;
          for (unsigned int d = 0; d < dim; ++d)
            if (d != condition.pivot && std::abs(known.direction[d]) > negligible)
              entries.emplace_back(dim * node + d, -known.direction[d]);
          for (const auto &[dof, coefficient] : known.others)
            if (std::abs(coefficient) > negligible)
              entries.emplace_back(dof, -coefficient);
          lines.back().inhomogeneity = known.value;
        }

    // A rank needs the lines of the dofs in its matrix rows and of those that its conditions refer
    // to.
    std::vector<Index> far;
    for (const auto &[node, reduced] : nodes)
      for (const ReducedCondition &condition : reduced)
        for (const auto &[dof, coefficient] : (condition.*side).others)
          far.push_back(dof);
    AffineConstraints<double> result =
      gather_lines(std::move(lines), owned, add_indices(relevant, std::move(far)), communicator);
    resolve_cycles(result);
    result.close();
    return result;
  }
} // namespace Touchstone

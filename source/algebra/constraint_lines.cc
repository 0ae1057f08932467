// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/algebra/cyclic_lines.h>
#include <touchstone/algebra/shared_lines.h>

#include <deal.II/base/mpi.h>

#include <cmath>

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
    std::vector<typename AffineConstraints<double>::ConstraintLine> lines;
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

    // A rank needs the lines of the dofs in its matrix rows, of those that
    // these lines refer to, of those that the latter refer to, and so on: until
    // no rank meets a dof that it has not asked for.
    std::vector<Index> far;
    for (const auto &[node, reduced] : nodes)
      for (const ReducedCondition &condition : reduced)
        for (const auto &[dof, coefficient] : (condition.*side).others)
          far.push_back(dof);
    IndexSet needed = add_indices(relevant, far);
    while (true)
      {
        AffineConstraints<double> result(needed);
        for (const auto &line : lines)
          {
            result.add_line(line.index);
            result.add_entries(line.index, line.entries);
            result.set_inhomogeneity(line.index, line.inhomogeneity);
          }
        if (Utilities::MPI::n_mpi_processes(communicator) > 1)
          add_lines_of_others(result, owned, needed, communicator);
        far.clear();
        for (const auto &line : result.get_lines())
          for (const auto &entry : line.entries)
            if (!needed.is_element(entry.first))
              far.push_back(entry.first);
        if (Utilities::MPI::max(static_cast<int>(!far.empty()), communicator) == 0)
          {
            resolve_cycles(result);
            result.close();
            return result;
          }
        needed = add_indices(needed, far);
      }
  }
} // namespace Touchstone

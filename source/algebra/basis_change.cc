// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/algebra/shared_lines.h>

#include <deal.II/base/mpi.h>

#include <map>

// The change of basis for conditions that stiff springs meet (doc/theory.md, end of section 7).
namespace Touchstone
{
  using namespace dealii;

  AffineConstraints<double>
  ConstraintGraph::make_basis_change(Side ReducedCondition::         *kind,
                                     const AffineConstraints<double> &constraints,
                                     const IndexSet                  &owned,
                                     const IndexSet                  &relevant,
                                     const MPI_Comm                   communicator) const
  {
    int here = 0;
    for (const auto &[node, reduced] : nodes)
      for (const ReducedCondition &condition : reduced)
        here |= (condition.treatment == Treatment::spring);
    if (Utilities::MPI::max(here, communicator) == 0)
      return AffineConstraints<double>();

    // Two rounds, as a line must not refer to another changed dof (CondensedSystem substitutes
    // once): the first finds out which dofs are changed on all ranks, the second makes their
    // lines without these.
    std::vector<Index> far;
    for (const auto &line : constraints.get_lines())
      for (const auto &entry : line.entries)
        far.push_back(entry.first);
    for (const auto &[node, reduced] : nodes)
      for (const ReducedCondition &condition : reduced)
        for (const auto &[dof, coefficient] : (condition.*kind).others)
          far.push_back(dof);
    const IndexSet            needed = add_indices(relevant, far);
    AffineConstraints<double> known(needed);
    for (const bool with_entries : {false, true})
      {
        std::vector<AffineConstraints<double>::ConstraintLine> lines;
        const auto                                             plain = [&](const Index i) {
          return !known.is_constrained(i) && !constraints.is_constrained(i);
        };
        for (const auto &[node, reduced] : nodes)
          for (const ReducedCondition &condition : reduced)
            {
              const Index index = dim * node + condition.pivot;
              if (condition.treatment != Treatment::spring || constraints.is_constrained(index))
                continue;
              lines.emplace_back(index);
              if (!with_entries)
                continue;
              std::map<Index, double> entries;
              // References to eliminated dofs are resolved at once, so that B follows C in T = C
              // B D; references to other changed dofs are dropped, which any change of basis
              // allows (doc/theory.md, end of section 7).
              const auto add = [&](const Index dof, const double factor) {
                if (constraints.is_constrained(dof))
                  {
                    for (const auto &entry : *constraints.get_constraint_entries(dof))
                      if (plain(entry.first))
                        entries[entry.first] += factor * entry.second;
                  }
                else if (plain(dof))
                  entries[dof] += factor;
              };
              const Side &side = condition.*kind;
              for (unsigned int d = 0; d < dim; ++d)
                if (d != condition.pivot && side.direction[d] != 0.)
                  add(dim * node + d, -side.direction[d]);
              for (const auto &[dof, coefficient] : side.others)
                if (coefficient != 0.)
                  add(dof, -coefficient);
              lines.back().entries.assign(entries.begin(), entries.end());
            }
        known = gather_lines(std::move(lines), owned, needed, communicator);
      }
    known.close();
    return known;
  }
} // namespace Touchstone

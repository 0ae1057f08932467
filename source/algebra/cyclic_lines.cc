// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/cyclic_lines.h>
#include <touchstone/algebra/strong_components.h>

#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    using Line = AffineConstraints<double>::ConstraintLine;

    /** Lines that refer to each other; in the order of their dofs, each list. (None refers to
     * itself, which deal.II does not allow.) */
    std::vector<std::vector<const Line *>>
    cycles(const AffineConstraints<double> &constraints)
    {
      // Few lines refer to others at all. By dof: the order of the lines depends on the partition.
      std::map<Index, const Line *> by_dof;
      for (const Line &line : constraints.get_lines())
        if (std::any_of(line.entries.begin(), line.entries.end(), [&](const auto &entry) {
              return constraints.is_constrained(entry.first);
            }))
          by_dof.emplace(line.index, &line);
      std::map<Index, unsigned int> numbers;
      std::vector<const Line *>     lines;
      for (const auto &[dof, line] : by_dof)
        {
          numbers.emplace(dof, lines.size());
          lines.push_back(line);
        }
      std::vector<std::pair<unsigned int, unsigned int>> edges;
      for (unsigned int i = 0; i < lines.size(); ++i)
        for (const auto &[dof, coefficient] : lines[i]->entries)
          if (const auto found = numbers.find(dof); found != numbers.end())
            edges.emplace_back(i, found->second);
      std::vector<std::vector<const Line *>> result;
      for (const std::vector<unsigned int> &component : strong_components(lines.size(), edges))
        if (component.size() > 1)
          {
            result.emplace_back();
            for (const unsigned int i : component)
              result.back().push_back(lines[i]);
          }
      return result;
    }



    /** The lines (I - C) x = E y + b of a cycle, with coefficients C of their own dofs and E of
     * others, solved for x. */
    std::vector<Line>
    solve(const std::vector<const Line *> &lines)
    {
      const unsigned int            n = lines.size();
      std::map<Index, unsigned int> own, other;
      for (unsigned int i = 0; i < n; ++i)
        own.emplace(lines[i]->index, i);
      for (const Line *line : lines)
        for (const auto &entry : line->entries)
          if (own.count(entry.first) == 0)
            other.emplace(entry.first, other.size());
      // The last column is b.
      FullMatrix<double> within{IdentityMatrix(n)}, outside(n, other.size() + 1),
        result(n, other.size() + 1);
      for (unsigned int i = 0; i < n; ++i)
        {
          for (const auto &[dof, coefficient] : lines[i]->entries)
            if (const auto found = own.find(dof); found != own.end())
              within(i, found->second) -= coefficient;
            else
              outside(i, other.at(dof)) += coefficient;
          outside(i, other.size()) = lines[i]->inhomogeneity;
        }
      within.gauss_jordan();
      within.mmult(result, outside);
      std::vector<Line> solved;
      for (unsigned int i = 0; i < n; ++i)
        {
          solved.emplace_back(lines[i]->index);
          for (const auto &[dof, column] : other)
            if (result(i, column) != 0.)
              solved.back().entries.emplace_back(dof, result(i, column));
          solved.back().inhomogeneity = result(i, other.size());
        }
      return solved;
    }
  } // namespace



  void
  resolve_cycles(AffineConstraints<double> &constraints)
  {
    const std::vector<std::vector<const Line *>> found = cycles(constraints);
    if (found.empty())
      return;
    std::map<Index, Line> solved;
    for (const std::vector<const Line *> &lines : found)
      for (Line &line : solve(lines))
        {
          const Index index = line.index;
          solved.emplace(index, std::move(line));
        }
    AffineConstraints<double> result(constraints.get_local_lines());
    for (const Line &before : constraints.get_lines())
      {
        const auto  other = solved.find(before.index);
        const Line &line  = other == solved.end() ? before : other->second;
        result.add_line(line.index);
        result.add_entries(line.index, line.entries);
        result.set_inhomogeneity(line.index, line.inhomogeneity);
      }
    constraints = std::move(result);
  }
} // namespace Touchstone

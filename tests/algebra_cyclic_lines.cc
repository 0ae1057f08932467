// SPDX-License-Identifier: LGPL-2.1-or-later

// Constraint lines that refer to each other in cycles: what resolve_cycles() makes of them has the
// same solutions, and chains and other lines stay as they are.

#include <touchstone/algebra/cyclic_lines.h>

#include <cmath>
#include <iostream>
#include <vector>

using namespace Touchstone;
using namespace dealii;

namespace
{
  using Lines = std::vector<AffineConstraints<double>::ConstraintLine>;

  Lines
  lines(const AffineConstraints<double> &constraints)
  {
    return Lines(constraints.get_lines().begin(), constraints.get_lines().end());
  }

  /** What is missing in the line of a dof. */
  double
  defect(const AffineConstraints<double>::ConstraintLine &line, const std::vector<double> &x)
  {
    double result = line.inhomogeneity - x[line.index];
    for (const auto &[dof, coefficient] : line.entries)
      result += coefficient * x[dof];
    return std::abs(result);
  }
} // namespace



int
main()
{
  AffineConstraints<double> constraints;
  const auto                add = [&](const Index                                  line,
                       const std::vector<std::pair<Index, double>> &entries,
                       const double                                 value) {
    constraints.add_line(line);
    constraints.add_entries(line, entries);
    constraints.set_inhomogeneity(line, value);
  };
  // A cycle of three, one of two that refers to it, and a chain.
  add(0, {{1, 0.4}, {10, 0.6}}, 0.1);
  add(1, {{2, -0.3}, {11, 1.3}}, 0.);
  add(2, {{0, 0.2}, {1, 0.1}, {12, 0.7}}, -0.2);
  add(3, {{4, 0.5}, {0, 0.5}}, 1.);
  add(4, {{3, 0.5}, {10, 0.5}}, 0.);
  add(6, {{7, 1.}}, 0.);
  add(7, {{11, 2.}}, 0.);
  const Lines before = lines(constraints);
  resolve_cycles(constraints);
  const Lines after = lines(constraints);
  bool        chain = true, left = false;
  for (const auto &line : after)
    for (const auto &[dof, coefficient] : line.entries)
      {
        if (line.index < 6)
          left = left || dof == line.index || (line.index < 3 && dof < 3) ||
                 (line.index > 2 && line.index < 5 && dof > 2 && dof < 5);
        else
          chain = chain && (line.index == 6 ? dof == 7 : dof == 11);
      }
  std::cout << "references within cycles: " << (left ? "some" : "none") << std::endl
            << "chains: " << (chain ? "as before" : "changed") << std::endl;

  constraints.close();
  std::vector<double> x(13);
  x[10] = 1.;
  x[11] = -2.;
  x[12] = 0.5;
  for (const auto &line : lines(constraints))
    {
      x[line.index] = line.inhomogeneity;
      for (const auto &[dof, coefficient] : line.entries)
        x[line.index] += coefficient * x[dof];
    }
  double worst = 0.;
  for (const auto &line : before)
    worst = std::max(worst, defect(line, x));
  std::cout << "the lines before hold: " << (worst < 1e-14 ? "yes" : "no") << std::endl;
  return 0;
}

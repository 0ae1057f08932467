// SPDX-License-Identifier: LGPL-2.1-or-later
// Which nodes of a body find which of its own faces: none of a body that is left as it is or
// only bent, however thin, and of a sheet that is folded those of one of the sides that meet.

#include "contact_support.h"
#include <algorithm>

using namespace Touchstone;
using namespace dealii;

namespace
{
  std::string
  body(const std::string &geometry)
  {
    return "set Bodies = sheet\nset Contact pairs = pair\n" + body_section("sheet", geometry) +
           "subsection Contact pair pair\n" + slave_and_master("sheet", "all", "sheet", "all") +
           "\nset Pairing = pointwise\nend\n";
  }

  /** Half the thickness of the sheet, and the length of what is bent. */
  constexpr double half = 0.25, bent = 2., first = 5.;

  /** A sheet that is bent upwards by an angle behind a straight part; the rest is straight again,
   * and moved by @p closed towards the first part. */
  Tensor<1, dim>
  fold(const Point<dim> &x, const double angle, const double closed)
  {
    const double z = x[2] - half, along = std::clamp(x[0] - first, 0., bent);
    const double turned = angle * along / bent, rest = std::max(0., x[0] - first - bent);
    // Of the middle of the sheet: an arc, and a straight part behind it.
    const double radius = bent / angle;
    Point<dim>   y(std::min(x[0], first) + radius * std::sin(turned) + rest * std::cos(turned),
                 x[1],
                 radius * (1. - std::cos(turned)) + rest * std::sin(turned));
    y += z * Point<dim>(-std::sin(turned), 0., std::cos(turned));
    y[2] += half - closed * std::min(1., rest);
    return y - x;
  }

  struct Counts
  {
    unsigned int partners = 0, penetrate = 0, of_first_arm = 0;
    double       lowest = 0.;
  };

  Counts
  count(const PairOfScene &pair)
  {
    Counts result;
    for (const ContactRow &row : pair.rows)
      if (row.has_partner)
        {
          ++result.partners;
          result.penetrate += (row.gap < -1e-9);
          result.of_first_arm += (row.gap < -1e-9 && row.reference[0] < first);
          result.lowest = std::min(result.lowest, row.gap);
        }
    for (unsigned int *n : {&result.partners, &result.penetrate, &result.of_first_arm})
      *n = Utilities::MPI::sum(*n, MPI_COMM_WORLD);
    result.lowest = Utilities::MPI::min(result.lowest, MPI_COMM_WORLD);
    return result;
  }

  void
  print(const std::string &text)
  {
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << text << std::endl;
  }

  void
  print(const std::string &name, const PairOfScene &pair)
  {
    const Counts all = count(pair);
    char         text[160];
    std::snprintf(text,
                  sizeof(text),
                  "%s: %u penetrate, %u of them of the first arm, lowest gap %.6f",
                  name.c_str(),
                  all.penetrate,
                  all.of_first_arm,
                  all.lowest + 0.);
    print(text);
  }

  void
  commit(PairOfScene &pair, const Touchstone::Vector &u)
  {
    Touchstone::Vector ghosted(pair.solid.owned, pair.solid.relevant, pair.solid.communicator);
    ghosted = u;
    pair.pairing->commit_positions(ghosted);
  }

  /** Bend a sheet by half a turn in steps, and then close it by less and by more than its gap. */
  void
  check_fold(const std::string &name, const std::string &cells)
  {
    PairOfScene pair(body("set Upper corner = 12, 1, 0.5\nset Cells = " + cells));
    const auto  at = [&](const double angle, const double closed) {
      return pair.displacement(
        [&](const Point<dim> &x, unsigned int) { return fold(x, angle, closed); });
    };
    unsigned int penetrate = 0;
    for (unsigned int step = 1; step <= 12; ++step)
      {
        const auto u = at(numbers::PI * step / 12., 0.);
        pair.update(u);
        penetrate += count(pair).penetrate;
        commit(pair, u);
      }
    print(name + ", bent: " + std::to_string(penetrate) + " penetrate");
    const double gap = 2. * (bent / numbers::PI - half);
    for (const double part : {0.25, 0.5, 0.75, 0.9})
      commit(pair, at(numbers::PI, part * gap));
    for (const double closed : {gap - 0.01, gap + 0.01, gap + 0.3})
      {
        pair.update(at(numbers::PI, closed));
        char text[80];
        std::snprintf(text, sizeof(text), "%s, gap %.2f", name.c_str(), gap - closed);
        print(text, pair);
      }
  }

  /** A body that turns and is compressed by a third. */
  void
  check_whole(const std::string &name, const std::string &geometry)
  {
    PairOfScene pair(body(geometry));
    const auto  u = pair.displacement([](const Point<dim> &x, unsigned int) {
      return Point<dim>(-0.33 * x[0] + 0.2 * x[1], 0.2 * x[0] - 0.33 * x[1], -0.33 * x[2]);
    });
    pair.update(u);
    print(name, pair);
    commit(pair, u);
    pair.update(u);
    print(name + ", in the next step", pair);
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  check_whole("cube", "set Cells = 4, 4, 4");
  check_whole("thin plate", "set Upper corner = 10, 10, 0.05\nset Cells = 5, 5, 1");
  check_whole("tube",
              "set Type = tube\nset Inner radius = 0.9\nset Outer radius = 1\n"
              "set Start = 0\nset End = 1\nset Cells = 1, 16, 2");
  check_fold("sheet", "24, 1, 1");
  check_fold("fine sheet", "48, 2, 2");
  return 0;
}

// SPDX-License-Identifier: LGPL-2.1-or-later
// The search: right faces against a comparison with all faces, nodes that pass
// through a thin body within a step, and nodes that stay with their face.

#include "contact_support.h"
#include <limits>

using namespace Touchstone;
using namespace dealii;

namespace
{
  bool
  first()
  {
    return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }

  void
  move(PairOfScene                                                                      &pair,
       const std::function<Tensor<1, dim>(const Point<dim> &, const unsigned int body)> &formula)
  {
    const Touchstone::Vector u = pair.displacement(formula);
    Touchstone::Vector       ghosted(pair.solid.owned, pair.solid.relevant, MPI_COMM_WORLD);
    ghosted = u;
    pair.move_surfaces(ghosted);
  }

  const Tensor<1, dim> down({0., 0., -1.});



  /** Scattered points: no face may be closer than the one that is found. */
  void
  compare_with_all(const std::string &name,
                   const std::string &geometry,
                   const std::string &boundaries,
                   const double       warp,
                   const Point<dim>  &lower,
                   const Point<dim>  &upper)
  {
    PairOfScene pair(master_only(geometry, boundaries, ""));
    move(pair, [&](const Point<dim> &x, unsigned int) { return warp * scattered(x, 5); });
    const double            reach = 10.;
    Search                  search(*pair.master, reach, 1., MasterNormal::averaged, MPI_COMM_WORLD);
    std::vector<Point<dim>> points;
    for (unsigned int i = 0; i < 400; ++i)
      {
        Point<dim> x;
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = lower[d] +
                 (upper[d] - lower[d]) * (0.5 + 0.5 * scatter(Point<dim>(0.37 * i, 0., 0.), d));
        points.push_back(x);
      }
    search.update(points);
    double       farther = 0.;
    unsigned int found = 0, others = 0;
    // The face that a point before had, to begin the search at: mostly a wrong one.
    std::optional<std::uint64_t> guess;
    std::size_t                  index = std::numeric_limits<std::size_t>::max();
    for (const Point<dim> &x : points)
      {
        const auto partner = search.find({x, x, down, false, {}});
        double     best    = std::numeric_limits<double>::max();
        for (const Face &face : pair.master->owned_faces())
          if (evaluate(face, nullptr, {{0., 0.}}).normal() * down <= 0.3)
            best =
              std::min(best,
                       closest_point_projection(x,
                                                FaceGeometry(face, nullptr, MasterNormal::averaged))
                         .distance_squared);
        best = Utilities::MPI::min(best, MPI_COMM_WORLD);
        if (!partner)
          continue;
        ++found;
        const auto guessed = search.find({x, x, down, false, guess, index});
        others += !guessed || guessed->face->key != partner->face->key ||
                  guessed->x.distance(partner->x) > 0.;
        guess   = partner->face->key;
        index   = search.exchange().index(*partner->face);
        farther = std::max(farther, x.distance(partner->x) - std::sqrt(best));
      }
    if (first())
      std::cout << name << ": " << found << " points, farther than the closest face "
                << small(std::max(farther, 0.), 1e-9) << ", others from a guess: " << others
                << std::endl;
  }



  struct Move
  {
    Point<dim>     start, end;
    Tensor<1, dim> master;
  };

  /** Nodes that move from a start to an end while the master moves, too. */
  void
  pass(const std::string       &name,
       const std::string       &geometry,
       const std::string       &boundaries,
       const std::vector<Move> &moves,
       const double             reach)
  {
    if (first())
      std::cout << name << '\n';
    PairOfScene pair(master_only(geometry, boundaries, ""));
    for (const Move &m : moves)
      {
        move(pair, [&](const Point<dim> &, unsigned int) { return m.master; });
        std::ostringstream out;
        out << "  " << m.start << " to " << m.end << ", body by " << m.master << ':';
        for (const bool swept : {false, true})
          {
            Search search(*pair.master, reach, 0.01, MasterNormal::averaged, MPI_COMM_WORLD);
            if (swept)
              search.commit(nullptr);
            search.update({m.start, m.end});
            const auto partner = search.find({m.end, m.start, down, false, {}});
            out << (swept ? "; with its path" : " as it is");
            if (!partner)
              out << " nothing";
            else
              out << " gap " << std::round(1e6 * ((m.end - partner->x) * partner->normal)) / 1e6;
          }
        if (first())
          std::cout << out.str() << std::endl;
      }
  }



  /** A node within a body near a sharp edge, about as close to both faces. */
  void
  stay()
  {
    PairOfScene pair(master_only("set Cells = 4, 4, 4", "top, right", ""));
    move(pair, [](const Point<dim> &, unsigned int) { return Tensor<1, dim>(); });
    const Tensor<1, dim> normal = Tensor<1, dim>({-1., 0., -1.}) / std::sqrt(2.);
    Search               search(*pair.master, 1., 0.01, MasterNormal::averaged, MPI_COMM_WORLD);
    // From the top towards the right face and back, in steps.
    std::ostringstream           out;
    std::optional<std::uint64_t> present;
    for (const double depth : {0.012, 0.0101, 0.0099, 0.0101, 0.009, 0.0099, 0.0101, 0.011})
      {
        const Point<dim> x(1. - depth, 0.6, 0.99);
        search.update({x});
        const auto free = search.find({x, x, normal, false, present});
        const auto held = search.find({x, x, normal, true, present});
        if (!free || !held)
          std::cout << "no partner FAILED\n";
        else
          {
            present = held->face->key;
            out << "  " << depth << " below the right face, 0.01 below the top: free on "
                << (free->normal[2] > 0.5 ? "top" : "right") << ", in contact on "
                << (held->normal[2] > 0.5 ? "top" : "right") << '\n';
          }
      }
    if (first())
      std::cout << "node at a sharp edge\n" << out.str() << std::flush;
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  const Point<dim> below(-0.2, -0.2, 0.6), above(1.2, 1.2, 1.4);
  compare_with_all("plane faces", "set Cells = 5, 4, 3", "top", 0., below, above);
  compare_with_all("warped faces", "set Cells = 5, 4, 3", "top", 0.06, below, above);
  compare_with_all(
    "around a corner", "set Cells = 5, 4, 3", "top, right, back", 0.03, below, {1.5, 1.5, 1.5});
  compare_with_all(
    "aspect ratio 100", "set Cells = 1, 100, 1", "top, right, back", 0., below, {1.2, 1.2, 1.2});
  compare_with_all("aspect ratio 100, warped",
                   "set Cells = 100, 1, 1",
                   "top, right, back",
                   0.004,
                   below,
                   {1.2, 1.2, 1.2});
  compare_with_all("inside of a tube",
                   "set Type = tube\nset Axis = y\nset Inner radius = 0.5\nset Outer radius = 1\n"
                   "set Angle = 360\nset Start = -0.3\nset End = 1.3\nset Cells = 1, 24, 3",
                   "inner",
                   0.01,
                   {-0.6, -0.2, -0.6},
                   {0.6, 1.2, 0.6});

  const Tensor<1, dim> still, up({0., 0., 0.8}), aside({0.05, 0., 0.8});
  const std::string    plate =
    "set Lower corner = 0, 0, 0\nset Upper corner = 1, 1, 0.02\nset Cells = 4, 4, 1";
  pass("thin plate",
       plate,
       "top, bottom",
       {{{0.4, 0.4, 0.1}, {0.4, 0.4, -0.05}, still},
        {{0.4, 0.4, 0.1}, {0.45, 0.4, -0.7}, still},
        {{0.4, 0.4, 0.1}, {0.4, 0.4, 0.1}, up},
        {{0.5, 0.5, 0.1}, {0.55, 0.5, 0.1}, aside},
        // It touches, leaves, slides, or was below from the start.
        {{0.4, 0.4, 0.02}, {0.4, 0.4, -0.6}, still},
        {{0.4, 0.4, 0.02}, {0.4, 0.4, 0.4}, still},
        {{0.4, 0.4, 0.02}, {0.6, 0.7, 0.02}, still},
        {{0.4, 0.4, -0.5}, {0.4, 0.4, -0.6}, still},
        // Past the edge, and through the plate on the way beyond its edge.
        {{1.1, 0.4, 0.1}, {1.1, 0.4, -0.7}, still},
        {{0.9, 0.4, 0.02}, {1.3, 0.4, -0.02}, still}},
       0.3);
  pass("wall of a tube, with the other side of the bore behind it",
       "set Type = tube\nset Axis = y\nset Inner radius = 0.95\nset Outer radius = 1\n"
       "set Angle = 360\nset Cells = 1, 32, 3",
       "inner, outer",
       {{{0.1, 0.5, 1.05}, {0.1, 0.5, -0.5}, still},
        {{0.1, 0.5, 1.05}, {0.1, 0.5, 0.6}, still},
        // Already within the bore.
        {{0.1, 0.5, -0.2}, {0.1, 0.5, -0.5}, still}},
       2.);
  // It cuts the corner of a body whose side is known, and comes out again.
  pass("corner of a box",
       "set Cells = 4, 4, 4",
       "top, right",
       {{{0.9, 0.4, 1.05}, {1.3, 0.4, 0.9}, still}, {{0.9, 0.4, 1.05}, {0.95, 0.4, 0.4}, still}},
       0.3);
  stay();
  return 0;
}

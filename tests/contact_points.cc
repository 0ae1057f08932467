// SPDX-License-Identifier: LGPL-2.1-or-later
// Rows of material points inside slave faces: weights and lever that keep force and moment, and
// their derivatives against central differences in directions in which every node moves on its own.

#include <touchstone/base/exchange.h>
#include <touchstone/contact/pairing/sets_of_points.h>

#include "contact_support.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  const std::string low = "set Lower corner = -1, -1, -1\n"
                          "set Upper corner = 1, 1, 0\n"
                          "set Cells        = 3, 3, 2";

  /** A tube along the middle of a slave face, whose nodes are beside it. */
  const std::string tube = two_bodies("low",
                                      low,
                                      "tube",
                                      "set Type         = tube\n"
                                      "set Axis         = x\n"
                                      "set Origin       = 0, 0, 0.46\n"
                                      "set Start        = -0.27\n"
                                      "set End          = 0.27\n"
                                      "set Inner radius = 0.225\n"
                                      "set Outer radius = 0.45\n"
                                      "set First angle  = 180\n"
                                      "set Angle        = 180\n"
                                      "set Cells        = 2, 9, 2",
                                      slave_and_master("low", "top", "tube", "outer"));

  const std::string ball = "set Bodies = low\nset Contact pairs = pair\nset Obstacles = ball\n" +
                           body_section("low", low) +
                           "subsection Obstacle ball\n"
                           "  set Shape  = sphere\n"
                           "  set Point  = 0.07, 0.03, 0.41\n"
                           "  set Radius = 0.4\n"
                           "  set Rotate angle = 20\n"
                           "end\n"
                           "subsection Contact pair pair\n"
                           "  set Slave body       = low\n"
                           "  set Slave boundaries = top\n"
                           "  set Obstacle         = ball\n"
                           "end\n";

  /** The point at @p xi of the slave face in whose middle the origin is, on all ranks. */
  std::vector<MaterialPoint>
  point_on_face(const PairOfScene &pair, const std::array<double, 2> &xi)
  {
    std::vector<MaterialPoint> mine;
    for (const Face &face : pair.slave->owned_faces())
      {
        Point<dim> centre;
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          centre += face.reference[m] / double(face.n_nodes());
        if (centre.norm() > 1e-3)
          continue;
        mine.emplace_back(face, pair.slave->trace(face), xi);
        MaterialPoint &point = mine.back();
        point.slave = std::max_element(point.weights.begin(), point.weights.begin() + point.n) -
                      point.weights.begin();
      }
    std::vector<MaterialPoint> all;
    for (const auto &of_rank : gather_records(mine, MPI_COMM_WORLD))
      all.insert(all.end(), of_rank.begin(), of_rank.end());
    return all;
  }

  std::vector<ContactRow>
  rows_at(PairOfScene &scene, const Touchstone::Vector &u, const bool differentiate = false)
  {
    const auto active = [](const ContactRow &row) { return row.between_nodes && row.has_partner; };
    Touchstone::Vector ghosted(scene.solid.owned, scene.solid.relevant, scene.solid.communicator);
    ghosted = u;
    scene.pair.update(u, ghosted, 1., active);
    if (differentiate)
      scene.pair.differentiate(active);
    return scene.pair.rows();
  }

  /** Largest difference between a derivative in a direction and a difference quotient. */
  double
  error_of_derivative(const ContactRow         &row,
                      const ContactRow         &plus,
                      const ContactRow         &minus,
                      const double              h,
                      const Touchstone::Vector &direction)
  {
    const RowDerivative &d = *row.derivative;
    Tensor<1, dim>       normal, gap_vector;
    std::vector<double>  weights(row.stencil.size());
    for (std::size_t a = 0; a < d.nodes.size(); ++a)
      {
        Tensor<1, dim> v;
        for (unsigned int c = 0; c < dim; ++c)
          v[c] = direction(dim * d.nodes[a] + c);
        normal += d.normal[a] * v;
        gap_vector += d.gap_vector[a] * v;
        for (std::size_t m = 0; m < weights.size(); ++m)
          weights[m] += d.weights[m][a] * v;
      }
    double error = std::max((normal - (plus.normal - minus.normal) / (2. * h)).norm(),
                            (gap_vector - (plus.gap_vector - minus.gap_vector) / (2. * h)).norm());
    for (std::size_t m = 0; m < weights.size(); ++m)
      {
        const auto weight = [&](const ContactRow &other) {
          double sum = 0.;
          for (const StencilEntry &entry : other.stencil)
            sum += entry.node == row.stencil[m].node ? entry.weight : 0.;
          return sum;
        };
        error = std::max(error, std::abs(weights[m] - (weight(plus) - weight(minus)) / (2. * h)));
      }
    return error;
  }

  double
  largest(const double x)
  {
    return Utilities::MPI::max(x, MPI_COMM_WORLD);
  }

  /** A point on the edge between two faces is the same whichever of them it is given by. */
  void
  check_edge(const std::string &text)
  {
    PairOfScene              scene(text, {});
    const Touchstone::Vector u =
      scene.displacement([](const Point<dim> &x, unsigned int) { return 0.003 * scattered(x, 7); });
    rows_at(scene, u);
    const MaterialPoint        first = point_on_face(scene, {{1., -0.11}}).at(0);
    std::vector<MaterialPoint> points;
    for (const Face &face : scene.slave->owned_faces())
      if (const auto xi = coordinates_on(face, first))
        points.emplace_back(face, scene.slave->trace(face), *xi);
    points                                      = gather_all(points, MPI_COMM_WORLD);
    double                           difference = 0.;
    std::vector<std::vector<double>> figures;
    for (MaterialPoint &point : points)
      {
        difference = std::max(difference, distance(first, point));
        for (unsigned int a = 0; a < point.n; ++a)
          if (point.nodes[a] == first.nodes[first.slave])
            point.slave = a;
        scene.pair.set_points({point});
        std::vector<double> of_point;
        for (const ContactRow &row : rows_at(scene, u))
          if (row.between_nodes && row.has_partner)
            {
              of_point.push_back(row.gap);
              for (const Stencil &tangent : *row.tangents)
                for (const StencilEntry &entry : tangent)
                  of_point.push_back(entry.weight);
            }
        figures.push_back(of_point);
      }
    for (std::size_t k = 0; k < figures[0].size(); ++k)
      difference = std::max(difference, std::abs(figures[0][k] - figures.at(1).at(k)));
    difference = largest(difference);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "on an edge: " << points.size() << " faces, " << small(difference, 1e-14)
                << '\n';
  }

  void
  check(const std::string &name, const std::string &text, const std::vector<std::string> &overrides)
  {
    PairOfScene              scene(text, overrides);
    const Touchstone::Vector u =
      scene.displacement([](const Point<dim> &x, unsigned int) { return 0.003 * scattered(x, 7); });
    rows_at(scene, u);
    scene.pair.set_points(point_on_face(scene, {{0.23, -0.11}}));
    const std::vector<ContactRow> rows = rows_at(scene, u, /*differentiate=*/true);

    IndexSet needed = scene.solid.relevant;
    for (const ContactRow &row : rows)
      if (row.derivative)
        for (const Index node : row.derivative->nodes)
          needed.add_range(dim * node, dim * node + dim);
    needed.compress();
    double       error = 0., weights = 0., gap = 0.;
    unsigned int compared = 0;
    for (const unsigned int seed : {1, 2, 3})
      {
        const Touchstone::Vector direction =
          scene.displacement([&](const Point<dim> &x, unsigned int) { return scattered(x, seed); });
        Touchstone::Vector of_nodes(scene.solid.owned, needed, scene.solid.communicator);
        of_nodes             = direction;
        const double       h = 1e-6;
        Touchstone::Vector plus(u), minus(u);
        plus.add(h, direction);
        minus.add(-h, direction);
        const std::vector<ContactRow> after = rows_at(scene, plus), before = rows_at(scene, minus);
        for (std::size_t k = 0; k < rows.size(); ++k)
          if (const ContactRow &row = rows[k]; row.derivative && row.between_nodes)
            {
              ++compared;
              error = std::max(error, error_of_derivative(row, after[k], before[k], h, of_nodes));
              // All nodes together move with a master body, or by the share on an obstacle.
              double sum = 0.;
              for (const StencilEntry &entry : row.stencil)
                sum += entry.weight;
              weights = std::abs(sum - (scene.master ? 1. : 1. - row.share));
              gap     = row.gap / row.share;
            }
      }
    compared = Utilities::MPI::sum(compared, MPI_COMM_WORLD);
    error    = largest(error);
    weights  = largest(weights);
    gap      = largest(gap);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << name << ": " << compared / 3 << " row(s), gap " << gap << ", weights "
                << small(weights, 1e-13) << ", derivative " << small(error, 2e-6) << '\n';
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string pairing : {"pointwise", "averaged"})
    check("tube, " + pairing, tube, {"Contact pair pair/Pairing=" + pairing});
  check("tube, smoothed", tube, {"Contact pair pair/Master normal=smoothed"});
  check("tube, degree 2", tube, {"Discretisation/Degree=2"});
  check("ball", ball, {});
  check("ball, degree 2", ball, {"Discretisation/Degree=2"});
  check_edge(ball);
  return 0;
}

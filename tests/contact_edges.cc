// SPDX-License-Identifier: LGPL-2.1-or-later
// Rows between nodes, of edges that cross and of a vertex in a slave face: that they stand in place
// of rows that push obliquely, that they keep momentum, and their derivatives against central
// differences in directions in which every node moves on its own.

#include "contact_support.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  // The edge of the lower box runs along x, that of the upper one along y, just above it.
  const std::string edges =
    two_bodies("lower",
               "set Cells    = 4, 3, 2\n"
               "set Rotation = 45, 0, 0",
               "upper",
               "set Lower corner = 0.03, -0.4, 2.125\n"
               "set Upper corner = 1.03, 0.6, 3.125\n"
               "set Cells        = 4, 3, 2\n"
               "set Rotation     = 0, 45, 0",
               slave_and_master("upper", "bottom, right", "lower", "top, back"));

  // A corner of the upper box points down, just above the lower one.
  const std::string vertex =
    two_bodies("lower",
               "set Lower corner = -1, -1, -1\n"
               "set Upper corner = 1, 1, 0\n"
               "set Cells        = 5, 5, 2",
               "upper",
               "set Lower corner = 0.05, 0.02, 0.005\n"
               "set Upper corner = 1.05, 1.02, 1.005\n"
               "set Cells        = 2, 2, 2\n"
               "set Rotation     = 45, -35.2643896828, 0",
               slave_and_master("lower", "top", "upper", "bottom, left, front"));

  // The same boxes one upon the other: faces touch, which needs no row between nodes.
  const std::string flat = two_bodies("lower",
                                      "set Cells = 4, 3, 2",
                                      "upper",
                                      "set Lower corner = 0.3, 0.2, 0.99\n"
                                      "set Upper corner = 1.3, 1.2, 1.99\n"
                                      "set Cells        = 3, 3, 2",
                                      slave_and_master("upper",
                                                       "bottom, left, right, front, back",
                                                       "lower",
                                                       "top, left, right, front, back"));

  unsigned int
  sum(const unsigned int x)
  {
    return Utilities::MPI::sum(x, MPI_COMM_WORLD);
  }

  double
  largest(const double x)
  {
    return Utilities::MPI::max(x, MPI_COMM_WORLD);
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
        // Neighbours of the closest face could change the order of the stencil.
        if (plus.stencil[m].node != row.stencil[m].node)
          return 1e9;
        error = std::max(error,
                         std::abs(weights[m] -
                                  (plus.stencil[m].weight - minus.stencil[m].weight) / (2. * h)));
      }
    return error;
  }



  void
  check(const std::string &name, const std::string &text, const std::string &pairing)
  {
    PairOfScene              pair(text, {"Contact pair pair/Pairing=" + pairing});
    const Touchstone::Vector u =
      pair.displacement([](const Point<dim> &x, const unsigned int body) {
        return 0.01 * scattered(x, 7) - 0.02 * body * Point<dim>::unit_vector(2);
      });
    pair.update(u);
    // Only rows between nodes are looked at: the pairing of the nodes has tests of its own.
    unsigned int       between = 0, of_nodes = 0;
    double             penetration = 0., off_balance = 0., oblique = 0.;
    Touchstone::Vector ghosted(pair.solid.owned, pair.solid.relevant, pair.solid.communicator);
    for (const ContactRow &row : pair.rows)
      if (row.has_partner && row.gap < 0.)
        {
          ++(row.between_nodes ? between : of_nodes);
          if (!row.between_nodes)
            continue;
          double weights = 0.;
          for (const StencilEntry &entry : row.stencil)
            weights += entry.weight;
          penetration = std::max(penetration, -row.gap / row.share);
          off_balance = std::max(off_balance, std::abs(weights - 1.));
          // Apart from the change of directions along the edges the gap vector is normal.
          oblique = std::max(oblique, 1. - std::abs(row.gap) / row.gap_vector.norm());
        }
    pair.differentiate(u);
    const std::vector<ContactRow> rows = pair.rows;

    IndexSet needed = pair.solid.relevant;
    for (const ContactRow &row : rows)
      if (row.derivative)
        for (const Index node : row.derivative->nodes)
          needed.add_range(dim * node, dim * node + dim);
    needed.compress();
    double       error    = 0.;
    unsigned int compared = 0;
    for (const unsigned int seed : {1, 2, 3})
      {
        const Touchstone::Vector direction =
          pair.displacement([&](const Point<dim> &x, unsigned int) { return scattered(x, seed); });
        Touchstone::Vector of_nodes(pair.solid.owned, needed, pair.solid.communicator);
        of_nodes             = direction;
        const double       h = 1e-6;
        Touchstone::Vector plus(u), minus(u);
        plus.add(h, direction);
        minus.add(-h, direction);
        pair.update(plus);
        const std::vector<ContactRow> rows_plus = pair.rows;
        pair.update(minus);
        for (std::size_t k = 0; k < rows.size(); ++k)
          if (rows[k].derivative && rows[k].between_nodes)
            {
              ++compared;
              error =
                std::max(error,
                         error_of_derivative(rows[k], rows_plus[k], pair.rows[k], h, of_nodes));
            }
      }
    between     = sum(between);
    of_nodes    = sum(of_nodes);
    compared    = sum(compared);
    penetration = largest(penetration);
    off_balance = largest(off_balance);
    oblique     = largest(oblique);
    error       = largest(error);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        std::cout << name << ", " << pairing << ": " << between << " row(s) between nodes overlap, "
                  << (of_nodes > 0 ? "and some" : "and none") << " of nodes\n";
        if (between > 0)
          std::cout << "  penetration " << penetration << ", weights " << small(off_balance, 1e-14)
                    << ", gap vector beside the normal " << small(oblique, 1e-2)
                    << "\n  derivative " << small(error, 1e-6)
                    << (compared == 0 ? ", NOT COMPARED" : "") << '\n';
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string pairing : {"pointwise", "averaged"})
    {
      check("edges", edges, pairing);
      check("vertex", vertex, pairing);
      check("flat", flat, pairing);
    }
  return 0;
}

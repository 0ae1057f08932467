// SPDX-License-Identifier: LGPL-2.1-or-later
// The constraint graph: which conditions it refuses, and that its lines meet all
// that it accepted.

#include <touchstone/algebra/constraint_graph.h>

#include "mesh_common.h"
#include <random>

using namespace Touchstone;
using namespace dealii;

namespace
{
  using Treatment = ConstraintGraph::Treatment;

  std::mt19937 generator(42);

  double
  random_number()
  {
    // Not std::uniform_real_distribution, which differs between libraries.
    return generator() / 2147483648. - 1.;
  }

  Tensor<1, dim>
  random_direction()
  {
    Tensor<1, dim> direction;
    do
      for (unsigned int d = 0; d < dim; ++d)
        direction[d] = random_number();
    while (direction.norm() < 0.1);
    return direction / direction.norm();
  }

  const Tensor<1, dim> x({1., 0., 0.}), y({0., 1., 0.}), z({0., 0., 1.});

  Condition
  make(const Index node, Tensor<1, dim> direction, const double value = 0.)
  {
    Condition condition;
    condition.node      = node;
    condition.direction = direction / direction.norm();
    condition.value     = value;
    return condition;
  }

  void
  offer(ConstraintGraph      &graph,
        const std::string    &what,
        const Tensor<1, dim> &direction,
        const Treatment       treatment = Treatment::eliminate)
  {
    std::cout << "  " << what << ": "
              << (graph.accept(make(0, direction), treatment) ? "accepted" : "refused") << '\n';
  }

  /** Distribute random free unknowns and see by how much conditions are missed. */
  double
  missed(const ConstraintGraph &graph, const unsigned int n)
  {
    const IndexSet                  all = complete_index_set(dim * n);
    const AffineConstraints<double> constraints =
      graph.constraints(AffineConstraints<double>(all), all, all, MPI_COMM_SELF);
    dealii::Vector<double> u(dim * n);
    for (double &value : u)
      value = random_number();
    constraints.distribute(u);
    double largest = 0.;
    for (const Condition &condition : graph.accepted())
      {
        double sum = -condition.value;
        for (unsigned int d = 0; d < dim; ++d)
          {
            sum += condition.direction[d] * u[dim * condition.node + d];
            for (const StencilEntry &entry : condition.stencil)
              sum -= condition.direction[d] * entry.weight * u[dim * entry.node + d];
          }
        largest = std::max(largest, std::abs(sum));
      }
    return largest;
  }



  /** A condition that earlier ones of its node determine is refused. */
  void
  one_node()
  {
    std::cout << "one node\n";
    ConstraintGraph graph;
    offer(graph, "z", z);
    offer(graph, "z again", z);
    offer(graph, "-z", -1. * z);
    offer(graph, "nearly z", z + 1e-4 * x);
    offer(graph, "x and z", x + z);
    offer(graph, "x", x);
    offer(graph, "2x and z", 2. * x + z);
    offer(graph, "oblique", x + y + z);
    offer(graph, "anything", random_direction());
    std::cout << "  " << graph.accepted().size() << " conditions\n";
    graph.clear();
    std::cout << "  after clear() " << graph.accepted().size() << " conditions\n";
    offer(graph, "z", z);
  }



  /** It does not matter how the earlier ones are met. */
  void
  with_multipliers()
  {
    std::cout << "with multipliers\n";
    ConstraintGraph graph;
    offer(graph, "z", z);
    offer(graph, "z as multiplier", z, Treatment::multiplier);
    offer(graph, "x and z as multiplier", x + z, Treatment::multiplier);
    offer(graph, "x", x);
    offer(graph, "y", y);
  }



  /** What is left of a vector is perpendicular to all accepted conditions. */
  void
  free_part()
  {
    std::cout << "free part\n";
    ConstraintGraph      graph;
    const Tensor<1, dim> force({1., 2., 3.});
    std::cout << "  " << graph.free_part(0, force) << '\n';
    graph.accept(make(0, z));
    std::cout << "  " << graph.free_part(0, force) << ", other node " << graph.free_part(1, force)
              << '\n';
    const Tensor<1, dim> oblique = x + y + z;
    graph.accept(make(0, oblique));
    const Tensor<1, dim> rest = graph.free_part(0, force);
    std::cout << "  " << rest << ", " << small(rest * z) << ", " << small(rest * oblique) << '\n';
    graph.accept(make(0, x));
    std::cout << "  " << graph.free_part(0, force) << '\n';
  }



  /** Lines meet all that was accepted. Nodes 0, 1, 2 are slaves of 3, 4, 5, and node 1 also of
   * node 0. */
  void
  lines()
  {
    std::cout << "lines\n";
    double       worst      = 0.;
    unsigned int n_accepted = 0, n_offered = 0;
    for (unsigned int trial = 0; trial < 500; ++trial)
      {
        // A line may rely on a multiplier's condition of the same node, so all are
        // eliminated here.
        ConstraintGraph graph;
        for (const Index node : {0, 1, 2})
          {
            const unsigned int n_conditions = 1 + trial % 4;
            for (unsigned int k = 0; k < n_conditions; ++k)
              {
                Condition condition = make(node,
                                           trial % 5 == 0 && k < 3 ? (k == 0   ? z
                                                                      : k == 1 ? x
                                                                               : y)
                                                                   : random_direction(),
                                           random_number());
                if (k > 0 || trial % 2 == 0)
                  {
                    const double w    = 0.5 * (1. + random_number());
                    condition.stencil = {{3, w}, {4, 0.5 * (1. - w)}, {5, 0.5 * (1. - w)}};
                    if (node == 1)
                      condition.stencil.push_back({0, 0.25});
                  }
                ++n_offered;
                n_accepted += graph.accept(condition);
              }
          }
        worst = std::max(worst, missed(graph, 6));
      }
    std::cout << "  offered " << n_offered << ", accepted " << n_accepted << ", missed by "
              << small(worst, 1e-9) << '\n';
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  one_node();
  with_multipliers();
  free_part();
  lines();
  return 0;
}

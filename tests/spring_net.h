// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_tests_spring_net_h
#define touchstone_tests_spring_net_h

// A linear system that is small, elastic-like and made without a mesh, for tests of solvers.

#include <touchstone/algebra/linear_solver.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <Epetra_Map.h>
#include <cmath>
#include <functional>
#include <memory>

namespace Touchstone
{
  using namespace dealii;

  /** Neighbours of a node of a cube, and whether they differ in the direction d. */
  inline void
  for_neighbours(const unsigned int                                            side,
                 const unsigned int                                            node,
                 const std::function<void(unsigned int node, unsigned int d)> &action)
  {
    unsigned int stride = 1;
    for (unsigned int d = 0; d < 3; ++d, stride *= side)
      {
        const unsigned int i = node / stride % side;
        if (i > 0)
          action(node - stride, d);
        if (i + 1 < side)
          action(node + stride, d);
      }
  }

  /** A net of springs between the nodes of a cube, with its lowest layer held and the upper
   * nodes coupled to their neighbours by @p friction in one triangle of the matrix only. */
  struct SpringNet
  {
    const unsigned int               side, n_nodes, n;
    Matrix                           stiffness;
    LinearSystem                     system;
    std::unique_ptr<CondensedSystem> condensed;
    std::unique_ptr<RigidMotions>    motions;

    /** @param change Adds to the system before it is condensed.
     *  @param ground Springs that hold each node in its place. */
    SpringNet(
      const double                               friction,
      const bool                                 multiplier,
      const unsigned int                         side   = 10,
      const std::function<void(LinearSystem &)> &change = [](LinearSystem &) {},
      const double                               ground = 1e-6)
      : side(side)
      , n_nodes(side * side * side)
      , n(3 * n_nodes)
    {
      const MPI_Comm     communicator = MPI_COMM_WORLD;
      const unsigned int rank         = Utilities::MPI::this_mpi_process(communicator);
      const unsigned int n_ranks      = Utilities::MPI::n_mpi_processes(communicator);
      const unsigned int begin        = n_nodes * rank / n_ranks;
      const unsigned int end          = n_nodes * (rank + 1) / n_ranks;
      IndexSet           owned(n);
      owned.add_range(3 * begin, 3 * end);

      IndexSet nodes(n_nodes);
      nodes.add_range(begin, end);
      DynamicSparsityPattern pattern(n_nodes, n_nodes, nodes);
      const auto             springs = [&](const auto &set) {
        for (unsigned int node = begin; node < end; ++node)
          for_neighbours(side, node, [&](const unsigned int other, const unsigned int d) {
            set(node, other, d);
          });
      };
      springs([&](const unsigned int node, const unsigned int other, unsigned int) {
        pattern.add(node, node);
        pattern.add(node, other);
      });
      stiffness.reinit(owned, pattern, communicator, true);
      springs([&](const unsigned int node, const unsigned int other, const unsigned int d) {
        const int          rows[]  = {stiffness.row(3 * node), -1};
        const unsigned int nodes[] = {stiffness.node(3 * node), stiffness.node(3 * other)};
        stiffness.add(2, rows, nodes, [&](const unsigned int i, const unsigned int j) {
          const double k = d == i ? 3. : 1.;
          return i != j % 3 ? 0. : j < 3 ? k + ground / 6. : -k;
        });
      });

      system.stiffness = &stiffness;
      system.tolerance = 1e-10;
      system.rhs.reinit(owned, communicator);
      for (unsigned int i = 3 * begin; i < 3 * end; ++i)
        system.rhs[i] = std::sin(1. + i);
      system.rhs.compress(VectorOperation::insert);
      AffineConstraints<double> constraints(complete_index_set(n));
      for (unsigned int i = 0; i < 3 * side * side; ++i)
        constraints.add_line(i);
      constraints.close();
      system.constraints.copy_from(constraints);
      // As the tangential force mu lambda of sliding nodes: from normal to
      // tangential unknowns and not back.
      if (friction != 0.)
        {
          system.symmetric = false;
          if (rank == 0)
            for (unsigned int node = n_nodes - side * side; node < n_nodes; ++node)
              for_neighbours(side, node, [&](const unsigned int other, unsigned int) {
                system.terms.push_back({{{3 * node, friction}}, {{3 * other + 2, 1.}}});
              });
        }
      system.first_extra = n;
      if (multiplier)
        {
          system.definite = false;
          if (rank == 0)
            {
              system.n_extra   = 1;
              system.extra_rhs = {1.};
              system.terms.push_back({{{n, 1.}}, {{n - 1, 1.}}});
              system.terms.push_back({{{n - 1, 1.}}, {{n, 1.}}});
            }
          else
            ++system.first_extra;
        }
      change(system);
      condensed = std::make_unique<CondensedSystem>(system);

      const Epetra_Map &map = stiffness.rows();
      motions.reset(new RigidMotions{Epetra_Vector(map), {}, 3});
      motions->body.resize(map.NumMyElements());
    }
  };
} // namespace Touchstone

#endif

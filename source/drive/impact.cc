// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/non_convergence.h>
#include <touchstone/drive/impact.h>

#include <deal.II/base/patterns.h>
#include <deal.II/lac/diagonal_matrix.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/solver_gmres.h>

#include <Epetra_Map.h>
#include <algorithm>
#include <cmath>
#include <set>

/**
 * @file
 * Impact without rebound (doc/time_integration.md, "Impact without rebound"): called by Dynamics at
 * the end of a converged step. The impulses p of B M^{-1} F^T p = B v - w, with w the velocity of
 * the obstacle, are found by GMRES, since F differs from B where nodes slip; each product with
 * M^{-1} is a solve by conjugate gradients, of one iteration if the mass is lumped.
 */

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Adapter: deal.II's solvers call vmult() of any class. */
    struct Operator
    {
      std::function<void(Vector &, const Vector &)> apply;

      void
      vmult(Vector &y, const Vector &x) const
      {
        apply(y, x);
      }
    };

    /**
     * Solve until the residual is @p reduction times the initial one. The absolute tolerance is
     * practically zero, as impulses may have any unit. A failure is a LinearSolverFailure on all
     * ranks: the step is cut.
     */
    template <typename Solver, typename Preconditioner>
    void
    solve(const Operator       &matrix,
          const Preconditioner &preconditioner,
          const double          reduction,
          const Vector         &rhs,
          Vector               &x)
    {
      ReductionControl control(1000, 1e-300, reduction, false, false);
      Solver           solver(control);
      try
        {
          solver.solve(matrix, x, rhs, preconditioner);
        }
      catch (const SolverControl::NoConvergence &failure)
        {
          // In digits that show it: the residual is small even where it is too large.
          throw LinearSolverFailure(
            "the velocities after an impact were not found: residual " +
            Patterns::Tools::to_string(failure.last_residual / rhs.l2_norm()) +
            " of the first one after " + std::to_string(failure.last_step) + " iterations, where " +
            Patterns::Tools::to_string(reduction) + " is asked for");
        }
    }

    /**
     * Sparse matrix whose row k is the linear form @p forms[k] of the nodal dofs, i.e. B or F. @p
     * rows distributes the constraints over the ranks, @p columns the dofs.
     */
    std::unique_ptr<Epetra_CrsMatrix>
    matrix_of(const std::vector<NodalForm> &forms,
              const IndexSet               &rows,
              const IndexSet               &columns,
              const MPI_Comm                communicator)
    {
      const Epetra_Map row_map = rows.make_trilinos_map(communicator, false);
      auto             matrix  = std::make_unique<Epetra_CrsMatrix>(Copy, row_map, 0);
      for (std::size_t k = 0; k < forms.size(); ++k)
        for (const auto &[node, coefficients] : forms[k])
          for (unsigned int d = 0; d < dim; ++d)
            {
              const int column = static_cast<int>(dim * node + d);
              matrix->InsertGlobalValues(row_map.GID(static_cast<int>(k)),
                                         1,
                                         &coefficients[d],
                                         &column);
            }
      matrix->FillComplete(columns.make_trilinos_map(communicator, false), row_map);
      return matrix;
    }

    void
    apply(const Epetra_CrsMatrix &matrix, const Vector &x, Vector &y)
    {
      matrix.Multiply(false, x.trilinos_vector(), y.trilinos_vector());
    }

    void
    apply_transposed(const Epetra_CrsMatrix &matrix, const Vector &x, Vector &y)
    {
      matrix.Multiply(true, x.trilinos_vector(), y.trilinos_vector());
    }
  } // namespace



  Impact::Impact(std::vector<VelocityConstraint>     &constraints,
                 const Mass                          &mass,
                 const Solid                         &solid,
                 const std::function<void(Vector &)> &remove_support)
    : mass(mass)
    , solid(solid)
    , remove_support(remove_support)
    , constraints(constraints)
    , rows(Utilities::MPI::create_ascending_partitioning(
        solid.communicator,
        constraints.size())[Utilities::MPI::this_mpi_process(solid.communicator)])
  {
    if (rows.size() == 0)
      return;
    // B measures relative velocities, F^T distributes impulses. They differ where nodes slip, since
    // there the force has a tangential part that is fixed by the normal one.
    std::vector<NodalForm> motions, forces;
    std::set<Index>        used;
    for (const VelocityConstraint &node : constraints)
      {
        motions.push_back(node.condition.motion_form());
        forces.push_back(node.condition.force_form());
        for (const auto &[at, coefficients] : motions.back())
          for (unsigned int d = 0; d < dim; ++d)
            used.insert(dim * at + d);
      }
    motion = matrix_of(motions, rows, solid.owned, solid.communicator);
    force  = matrix_of(forces, rows, solid.owned, solid.communicator);

    // Jacobi scaling of the impulses: the diagonal of B M^{-1} B^T with the lumped mass. Without it
    // the impulses of light and heavy bodies in one scene would differ by orders of magnitude, and
    // GMRES would stop before the light ones are found.
    inverse_mass = mass.of_nodes();
    for (double &value : inverse_mass)
      value = value > 0. ? 1. / value : 0.;
    // The nodes of a constraint may belong to other ranks.
    IndexSet needed = solid.owned;
    needed.add_indices(used.begin(), used.end());
    Vector mobility(solid.owned, needed, solid.communicator);
    mobility = inverse_mass;
    scale.reinit(rows, solid.communicator);
    for (std::size_t k = 0; k < constraints.size(); ++k)
      {
        double sum = 0.;
        for (const auto &[at, coefficients] : motions[k])
          for (unsigned int d = 0; d < dim; ++d)
            sum += coefficients[d] * coefficients[d] * mobility(dim * at + d);
        scale.begin()[k] = sum > 0. ? 1. / sum : 1.;
      }
  }



  void
  Impact::respond(Vector &impulse) const
  {
    // Projection of the equations onto the free dofs: forces on hanging nodes go to the nodes that
    // they follow, and components that supports prescribe carry no response. The operator is
    // symmetric, so that CG applies.
    const auto free = [this](Vector &vector) {
      solid.condense(vector);
      remove_support(vector);
    };
    free(impulse);
    // Velocity change M^{-1} of the impulses; x = 0 is written explicitly because the copy only
    // gives the layout.
    Vector   x(impulse), moved(impulse);
    Operator matrix{[&](Vector &y, const Vector &velocity) {
      moved = velocity;
      solid.hanging.distribute(moved);
      mass.multiply(moved, y);
      free(y);
    }};
    x = 0.;
    // The impulses are found to 1e-12; the inner solve is two digits more accurate, so that the
    // operator of GMRES is constant to its tolerance.
    solve<SolverCG<Vector>>(matrix, DiagonalMatrix<Vector>(inverse_mass), 1e-14, impulse, x);
    solid.hanging.distribute(x);
    impulse = x;
  }



  Impact::Loss
  Impact::stop(Vector &v, const bool of_velocity)
  {
    Loss loss{Vector(v), Vector(v)};
    loss.normal = loss.tangential = 0.;
    if (rows.size() == 0)
      return loss;
    Vector excess(rows, solid.communicator), impulses(excess), on_nodes(v);
    // Relative velocity, or acceleration, that contact does not allow.
    apply(*motion, v, excess);
    double largest = 0.;
    for (std::size_t k = 0; k < constraints.size(); ++k)
      {
        const double of_obstacle =
          of_velocity ? constraints[k].condition.value : constraints[k].acceleration;
        excess.begin()[k] -= of_obstacle;
        largest = std::max(largest, std::abs(of_obstacle));
      }
    Operator response{[&](Vector &y, const Vector &p) {
      apply_transposed(*force, p, on_nodes);
      respond(on_nodes);
      apply(*motion, on_nodes, y);
    }};
    // What round-off leaves of equal velocities is no impact, and its impulses are zero: where
    // supports hold both sides nothing can respond to it, and GMRES would divide by zero.
    constexpr double round_off = 1e-14;
    largest = std::max(Utilities::MPI::max(largest, solid.communicator), v.linfty_norm());
    if (!(excess.linfty_norm() <= round_off * largest))
      solve<SolverGMRES<Vector>>(response, DiagonalMatrix<Vector>(scale), 1e-12, excess, impulses);

    apply_transposed(*force, impulses, on_nodes);
    // All impulses for now: the normal part is subtracted at the end, once the supports' share has
    // been removed from both.
    loss.tangential = on_nodes;
    respond(on_nodes);
    v -= on_nodes;
    for (std::size_t k = 0; k < constraints.size(); ++k)
      {
        // The impulses are kept for the output, as contact force impulse / h of the step, and for
        // the work of obstacles over the next one. Tangential ones are then set to zero, so that
        // the product below has the normal part alone.
        (of_velocity ? constraints[k].impulse : constraints[k].excess_force) = impulses.begin()[k];
        // Impulse times velocity of the obstacle: work that moving obstacles did not do.
        const double impulse = impulses.begin()[k],
                     normal  = constraints[k].normal
                                 ? impulse * (constraints[k].condition.direction *
                                             constraints[k].of_obstacle)
                                 : 0.;
        loss.normal_of_obstacles += normal;
        loss.tangential_of_obstacles +=
          impulse * (constraints[k].condition.force() * constraints[k].of_obstacle) - normal;
        if (!constraints[k].normal)
          impulses.begin()[k] = 0.;
      }
    for (double *const part : {&loss.normal_of_obstacles, &loss.tangential_of_obstacles})
      *part = Utilities::MPI::sum(*part, solid.communicator);
    apply_transposed(*motion, impulses, loss.normal);
    for (Vector *part : {&loss.normal, &loss.tangential})
      {
        solid.condense(*part);
        remove_support(*part);
      }
    loss.tangential -= loss.normal;
    return loss;
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/non_convergence.h>
#include <touchstone/drive/body_motion.h>
#include <touchstone/drive/step_problem.h>
#include <touchstone/solid/bodies.h>

#include <deal.II/base/mpi.h>

#include <limits>

// Bodies that stand on one or two nodes can turn about the line through them, and what has no
// friction can slide: all these states are balanced, and round-off would choose one of them. The
// least motion of a static step is taken (doc/theory.md 9).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int n_motions = 2 * dim;

    /** Of a body: integrals of the products of its rigid modes at its present position, and of the
     * modes times its displacement since the start of the step; over the undeformed volume. */
    struct Moments
    {
      FullMatrix<double>     of_modes = FullMatrix<double>(n_motions, n_motions);
      dealii::Vector<double> of_step  = dealii::Vector<double>(n_motions);
    };

    /** Integrals over a cell are means over its nodes. Collective. */
    std::vector<Moments>
    moments_of_bodies(const Solid                   &solid,
                      const std::vector<RigidFrame> &frames,
                      const Vector                  &start,
                      const Vector                  &u)
    {
      constexpr unsigned int of_body = n_motions * (n_motions + 1);
      std::vector<double>    sums(of_body * frames.size());
      const auto             now = solid.ghosted(u), before = solid.ghosted(start);
      std::vector<Index>     dofs(solid.fe.n_dofs_per_cell());
      for (const auto &cell : solid.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            const RigidFrame &frame  = frames[cell->material_id()];
            double *const     sum    = &sums[of_body * cell->material_id()];
            const double      weight = cell->measure() / (dofs.size() / dim);
            cell->get_dof_indices(dofs);
            for (unsigned int i = 0; i < dofs.size(); ++i)
              if (solid.fe.system_to_component_index(i).first == 0)
                {
                  Tensor<1, dim> moved;
                  Point<dim>     position =
                    solid.mapping.transform_unit_to_real_cell(cell, solid.fe.unit_support_point(i));
                  for (unsigned int d = 0; d < dim; ++d)
                    {
                      position[d] += now(dofs[i] + d);
                      moved[d] = now(dofs[i] + d) - before(dofs[i] + d);
                    }
                  for (unsigned int j = 0; j < n_motions; ++j)
                    {
                      const Tensor<1, dim> mode =
                        rigid_mode(j, (position - frame.centre) / frame.size);
                      for (unsigned int k = 0; k < n_motions; ++k)
                        sum[n_motions * j + k] +=
                          weight * (mode * rigid_mode(k, (position - frame.centre) / frame.size));
                      sum[n_motions * n_motions + j] += weight * (mode * moved);
                    }
                }
          }
      Utilities::MPI::sum(sums, solid.communicator, sums);
      std::vector<Moments> result(frames.size());
      for (std::size_t b = 0; b < frames.size(); ++b)
        for (unsigned int j = 0; j < n_motions; ++j)
          {
            for (unsigned int k = 0; k < n_motions; ++k)
              result[b].of_modes(j, k) = sums[of_body * b + n_motions * j + k];
            result[b].of_step(j) = sums[of_body * b + n_motions * n_motions + j];
          }
      return result;
    }



    /** How much of each free motion takes the step's motion along them back. */
    dealii::Vector<double>
    parts_to_take_back(const FreeMotion &free, const std::vector<Moments> &moments)
    {
      FullMatrix<double>     matrix(free.n_modes, free.n_modes);
      dealii::Vector<double> rhs(free.n_modes), result(free.n_modes);
      for (unsigned int v = 0; v < free.n_modes; ++v)
        for (std::size_t b = 0; b < moments.size(); ++b)
          for (unsigned int j = 0; j < n_motions; ++j)
            {
              const double part = free.basis(n_motions * b + j, v);
              rhs(v) -= part * moments[b].of_step(j);
              for (unsigned int w = 0; w < free.n_modes; ++w)
                for (unsigned int k = 0; k < n_motions; ++k)
                  matrix(v, w) +=
                    part * moments[b].of_modes(j, k) * free.basis(n_motions * b + k, w);
            }
      matrix.gauss_jordan();
      matrix.vmult(result, rhs);
      return result;
    }



    /** The motions of the bodies by these parts: rotations about their axes, so that the nodes on
     * which a body stands stay where they are. */
    Motions
    motions_of_parts(const FreeMotion              &free,
                     const std::vector<RigidFrame> &frames,
                     const dealii::Vector<double>  &parts)
    {
      Motions result(frames.size());
      for (std::size_t b = 0; b < frames.size(); ++b)
        {
          BodyMotion motion;
          motion.centre = frames[b].centre;
          for (unsigned int v = 0; v < free.n_modes; ++v)
            for (unsigned int d = 0; d < dim; ++d)
              {
                motion.shift[d] += parts(v) * free.basis(n_motions * b + d, v);
                motion.turn[d] +=
                  parts(v) * free.basis(n_motions * b + dim + d, v) / frames[b].size;
              }
          // The axis of what is a translation but for round-off is far away.
          constexpr double round_off = 1e-10;
          if (const double square = motion.turn.norm_square();
              motion.turn.norm() * frames[b].size > round_off * motion.shift.norm())
            {
              motion.centre += cross_product_3d(motion.turn, motion.shift) / square;
              motion.shift = (motion.shift * motion.turn) / square * motion.turn;
            }
          result[b] = motion;
        }
      return result;
    }
  } // namespace



  unsigned int
  StepProblem::take_out_free_motion(const Newton &newton, const Newton::Observer &observer)
  {
    if (integration->dynamic())
      return 0;
    constexpr unsigned int        most_rounds = 5;
    const std::vector<RigidFrame> frames      = rigid_frames(solid);
    unsigned int                  n           = 0;
    double                        before      = std::numeric_limits<double>::max();
    for (unsigned int round = 0; round < most_rounds; ++round)
      {
        const FreeMotion free = system->undetermined_motion();
        if (free.n_modes == 0)
          break;
        const auto parts =
          parts_to_take_back(free, moments_of_bodies(solid, frames, committed_u, u));
        // What does not get less is determined after all, by what changes with the motion.
        const double size = parts.l2_norm();
        if (size <= scene.newton.gap_tolerance * system->smallest_cell() || size > 0.5 * before)
          break;
        before = size;
        const Vector balanced(u);
        move_bodies(solid, motions_of_parts(free, frames, parts), balanced, u);
        try
          {
            n += newton.solve(*this, observer, /*least=*/1);
          }
        catch (const NonConvergence &)
          {
            // No state next to the start of the step: the one that has been found is as good.
            u = balanced;
            contact.begin_again(committed_u, committed_time);
            return n + newton.solve(*this, observer, /*least=*/1);
          }
      }
    return n;
  }
} // namespace Touchstone

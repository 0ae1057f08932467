// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/motion_in_modes.h>
#include <touchstone/solid/bodies.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/full_matrix.h>

// The part of a motion that lies in given rigid motions of the bodies (doc/theory.md 9).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Of a body: integrals of the products of its rigid modes at its present position, and of the
     * modes times its displacement since the start of the step; over the undeformed volume. */
    struct Moments
    {
      FullMatrix<double>     of_modes = FullMatrix<double>(n_rigid_modes, n_rigid_modes);
      dealii::Vector<double> of_step  = dealii::Vector<double>(n_rigid_modes);
    };

    /** Integrals over a cell are means over its nodes. Collective. */
    std::vector<Moments>
    moments_of_bodies(const Solid                   &solid,
                      const std::vector<RigidFrame> &frames,
                      const Vector                  &start,
                      const Vector                  &u)
    {
      constexpr unsigned int of_body = n_rigid_modes * (n_rigid_modes + 1);
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
                  for (unsigned int j = 0; j < n_rigid_modes; ++j)
                    {
                      const Tensor<1, dim> mode =
                        rigid_mode(j, (position - frame.centre) / frame.size);
                      for (unsigned int k = 0; k < n_rigid_modes; ++k)
                        sum[n_rigid_modes * j + k] +=
                          weight * (mode * rigid_mode(k, (position - frame.centre) / frame.size));
                      sum[n_rigid_modes * n_rigid_modes + j] += weight * (mode * moved);
                    }
                }
          }
      Utilities::MPI::sum(sums, solid.communicator, sums);
      std::vector<Moments> result(frames.size());
      for (std::size_t b = 0; b < frames.size(); ++b)
        for (unsigned int j = 0; j < n_rigid_modes; ++j)
          {
            for (unsigned int k = 0; k < n_rigid_modes; ++k)
              result[b].of_modes(j, k) = sums[of_body * b + n_rigid_modes * j + k];
            result[b].of_step(j) = sums[of_body * b + n_rigid_modes * n_rigid_modes + j];
          }
      return result;
    }
  } // namespace



  dealii::Vector<double>
  motion_in_modes(const Solid &solid, const FreeMotion &modes, const Vector &start, const Vector &u)
  {
    const auto             moments = moments_of_bodies(solid, rigid_frames(solid), start, u);
    FullMatrix<double>     matrix(modes.n_modes, modes.n_modes);
    dealii::Vector<double> rhs(modes.n_modes), result(modes.n_modes);
    for (unsigned int v = 0; v < modes.n_modes; ++v)
      for (std::size_t b = 0; b < moments.size(); ++b)
        for (unsigned int j = 0; j < n_rigid_modes; ++j)
          {
            const double part = modes.basis(n_rigid_modes * b + j, v);
            rhs(v) += part * moments[b].of_step(j);
            for (unsigned int w = 0; w < modes.n_modes; ++w)
              for (unsigned int k = 0; k < n_rigid_modes; ++k)
                matrix(v, w) +=
                  part * moments[b].of_modes(j, k) * modes.basis(n_rigid_modes * b + k, w);
          }
    matrix.gauss_jordan();
    matrix.vmult(result, rhs);
    return result;
  }



  Motions
  motions_by_modes(const Solid &solid, const FreeMotion &modes, const dealii::Vector<double> &parts)
  {
    const std::vector<RigidFrame> frames = rigid_frames(solid);
    Motions                       result(frames.size());
    for (std::size_t b = 0; b < frames.size(); ++b)
      {
        BodyMotion motion;
        motion.centre = frames[b].centre;
        for (unsigned int v = 0; v < modes.n_modes; ++v)
          for (unsigned int d = 0; d < dim; ++d)
            {
              motion.shift[d] += parts(v) * modes.basis(n_rigid_modes * b + d, v);
              motion.turn[d] +=
                parts(v) * modes.basis(n_rigid_modes * b + dim + d, v) / frames[b].size;
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



  Vector
  displacement_by_modes(const Solid                  &solid,
                        const FreeMotion             &modes,
                        const dealii::Vector<double> &parts,
                        const Vector                 &u)
  {
    Vector                          result = present_positions(solid, u);
    const std::vector<RigidFrame>   frames = rigid_frames(solid);
    const std::vector<unsigned int> body   = bodies_of_unknowns(solid);
    for (std::size_t i = 0; i < body.size(); i += dim)
      {
        double *const        x        = result.begin() + i;
        const RigidFrame    &frame    = frames[body[i]];
        const Tensor<1, dim> distance = (Point<dim>(x[0], x[1], x[2]) - frame.centre) / frame.size;
        Tensor<1, dim>       moved;
        for (unsigned int v = 0; v < modes.n_modes; ++v)
          for (unsigned int k = 0; k < n_rigid_modes; ++k)
            moved +=
              parts(v) * modes.basis(n_rigid_modes * body[i] + k, v) * rigid_mode(k, distance);
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = moved[d];
      }
    return result;
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/dynamics.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <array>
#include <vector>

// Momenta of the bodies, and what a change of the mesh takes of them: a rigid motion of each body
// gives it back.
namespace Touchstone
{
  using namespace dealii;

  void
  Dynamics::adopt(const std::vector<Vector>                    &rates,
                  const StepForces                             &forces,
                  const std::vector<std::vector<BodyMomentum>> &before)
  {
    // The order of rates(): velocity, acceleration.
    v   = rates.front();
    a   = rates.back();
    old = forces;

    // Interpolation on coarsened cells conserves neither momentum nor the resultant of the forces
    // of inertia, which is that of all others: as if a force acted in the step to come. What each
    // body misses of both is given back by a rigid motion, one of those that its supports leave
    // free: half of a body on a plane of symmetry moves on as the whole one does.
    const std::vector<RigidFrame> frames = rigid_frames(solid);
    std::vector<Vector>           motions;
    for (unsigned int k = 0; k < n_rigid_modes; ++k)
      motions.push_back(moved_rigidly(k, frames));
    std::vector<std::vector<Numbers>> momenta;
    for (const Vector &motion : motions)
      momenta.push_back(rigid_momenta(momenta_of(motion), frames));
    const std::array<Vector *, 2>       now = {{&v, &a}};
    std::array<std::vector<Numbers>, 2> missing;
    for (unsigned int r = 0; r < now.size(); ++r)
      {
        missing[r]                     = rigid_momenta(before[r], frames);
        const std::vector<Numbers> are = rigid_momenta(momenta_of(*now[r]), frames);
        for (std::size_t b = 0; b < are.size(); ++b)
          for (unsigned int k = 0; k < n_rigid_modes; ++k)
            missing[r][b][k] -= are[b][k];
      }
    for (unsigned int b = 0; b < solid.bodies.size(); ++b)
      {
        const FullMatrix<double> free = free_motions(b, motions, forces.remove_support);
        if (free.n() == 0)
          continue;
        FullMatrix<double> inertia(n_rigid_modes);
        for (unsigned int k = 0; k < n_rigid_modes; ++k)
          for (unsigned int i = 0; i < n_rigid_modes; ++i)
            inertia(i, k) = momenta[k][b][i];
        for (unsigned int r = 0; r < now.size(); ++r)
          {
            const Numbers amplitudes = motion_with(missing[r][b], inertia, free);
            for (std::size_t i = 0; i < body.size(); ++i)
              if (body[i] == b)
                for (unsigned int k = 0; k < n_rigid_modes; ++k)
                  now[r]->begin()[i] += amplitudes[k] * motions[k].begin()[i];
          }
      }
    // No step has found what the supports of this mesh add.
    Vector others(old.external);
    others -= old.internal;
    others += old.normal;
    others += old.tangential;
    old.support = support_force(others, forces.remove_support);
  }



  Dynamics::Numbers
  Dynamics::motion_with(const Numbers            &momentum,
                        const FullMatrix<double> &inertia,
                        const FullMatrix<double> &free)
  {
    // In the basis of the free motions: inertia * part = momentum.
    const unsigned int     n = free.n();
    FullMatrix<double>     of_basis(n_rigid_modes, n), small(n);
    dealii::Vector<double> rhs(momentum.begin(), momentum.end()), rest(n), part(n),
      amplitudes(n_rigid_modes);
    inertia.mmult(of_basis, free);
    free.Tmmult(small, of_basis);
    free.Tvmult(rest, rhs);
    small.gauss_jordan();
    small.vmult(part, rest);
    free.vmult(amplitudes, part);
    Numbers result;
    std::copy(amplitudes.begin(), amplitudes.end(), result.begin());
    return result;
  }



  FullMatrix<double>
  Dynamics::free_motions(const unsigned int                   b,
                         const std::vector<Vector>           &motions,
                         const std::function<void(Vector &)> &remove_support) const
  {
    // What supports take away of each motion, and the products of that: motions without any are the
    // null space of this matrix.
    const unsigned int       n = motions.size();
    LAPACKFullMatrix<double> resisted(n, n);
    std::vector<Vector>      taken;
    for (const Vector &motion : motions)
      {
        Vector rest(motion);
        remove_support(rest);
        taken.push_back(motion);
        taken.back() -= rest;
      }
    double n_nodes = 0.;
    for (std::size_t i = 0; i < body.size(); i += dim)
      n_nodes += (body[i] == b);
    n_nodes = Utilities::MPI::sum(n_nodes, solid.communicator);
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int l = 0; l < n; ++l)
        {
          double sum = 0.;
          for (std::size_t i = 0; i < body.size(); ++i)
            if (body[i] == b)
              sum += taken[k].begin()[i] * taken[l].begin()[i];
          resisted(k, l) = Utilities::MPI::sum(sum, solid.communicator);
        }
    resisted.compute_svd();
    unsigned int rank = 0;
    while (rank < n && resisted.singular_value(rank) > 1e-10 * n_nodes)
      ++rank;
    FullMatrix<double> result(n, n - rank);
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int l = rank; l < n; ++l)
        result(k, l - rank) = resisted.get_svd_u()(k, l);
    return result;
  }



  std::vector<Dynamics::Numbers>
  Dynamics::rigid_momenta(const std::vector<BodyMomentum> &momenta,
                          const std::vector<RigidFrame>   &frames)
  {
    std::vector<Numbers> result(momenta.size());
    for (unsigned int b = 0; b < momenta.size(); ++b)
      {
        const Tensor<1, dim> angular =
          (momenta[b].angular - cross_product_3d(frames[b].centre, momenta[b].linear)) /
          frames[b].size;
        for (unsigned int d = 0; d < dim; ++d)
          {
            result[b][d]       = momenta[b].linear[d];
            result[b][dim + d] = angular[d];
          }
      }
    return result;
  }



  Vector
  Dynamics::moved_rigidly(const unsigned int k, const std::vector<RigidFrame> &frames) const
  {
    Vector result = present_positions(solid, committed_u);
    for (std::size_t i = 0; i < result.locally_owned_size(); i += dim)
      {
        const RigidFrame    &frame = frames[body[i]];
        const Point<dim>     x(result.begin()[i], result.begin()[i + 1], result.begin()[i + 2]);
        const Tensor<1, dim> velocity = rigid_mode(k, (x - frame.centre) / frame.size);
        for (unsigned int d = 0; d < dim; ++d)
          result.begin()[i + d] = velocity[d];
      }
    return result;
  }



  std::vector<BodyMomentum>
  Dynamics::momenta_of(const Vector &velocity) const
  {
    const Vector position = present_positions(solid, committed_u);
    Vector       momentum(v);
    mass.multiply(velocity, momentum);
    std::vector<BodyMomentum> result(solid.bodies.size());
    for (std::size_t i = 0; i < body.size(); i += dim)
      {
        Tensor<1, dim> p, x;
        for (unsigned int d = 0; d < dim; ++d)
          {
            p[d] = momentum.begin()[i + d];
            x[d] = position.begin()[i + d];
          }
        // Sum_i p_i and Sum_i x_i x p_i of the nodal momenta p = M v: exact for any mass matrix
        // that represents rigid motions.
        result[body[i]].mass += mass.of_nodes().begin()[i];
        result[body[i]].linear += p;
        result[body[i]].angular += cross_product_3d(x, p);
      }
    // A body is distributed over all ranks; a rank without a part of it adds zero.
    for (BodyMomentum &sum : result)
      {
        sum.mass    = Utilities::MPI::sum(sum.mass, solid.communicator);
        sum.linear  = Utilities::MPI::sum(sum.linear, solid.communicator);
        sum.angular = Utilities::MPI::sum(sum.angular, solid.communicator);
      }
    return result;
  }
} // namespace Touchstone

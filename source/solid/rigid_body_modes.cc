// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/bodies.h>
#include <touchstone/solid/rigid_body_modes.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Vector.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

// Bodies that only contact holds (doc/theory.md, section 9): which rigid motions the conditions
// leave free, and the diagonal shift that stabilises the tangent against them. The same six
// motions per node are the near-null space of multigrid (section 8).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Whether the eigenvalues of a positive semidefinite 6 x 6 matrix are all larger than
     * @p threshold. */
    bool
    positive_definite(const double *entries, const double threshold)
    {
      LAPACKFullMatrix<double> matrix(6, 6);
      for (unsigned int i = 0; i < 6; ++i)
        for (unsigned int j = 0; j < 6; ++j)
          matrix(i, j) = entries[6 * i + j];
      matrix.compute_svd();
      return matrix.singular_value(5) > threshold;
    }

    double
    largest_entry(const std::vector<double> &entries)
    {
      double result = 0.;
      for (const double entry : entries)
        result = std::max(result, std::abs(entry));
      return result;
    }
  } // namespace



  RigidBodyModes::RigidBodyModes(const Solid &solid)
    : solid(solid)
    , rigid(new RigidMotions{Epetra_Vector(solid.stiffness().rows()), bodies_of_unknowns(solid)})
    , frames(rigid_frames(solid))
  {
    // Multigrid takes six motions for all bodies, about the centre of the first: restricted to
    // any body they span its rigid motions just as well.
    Epetra_Vector     &position = rigid->position;
    std::vector<Index> dofs(solid.fe.n_dofs_per_cell());
    std::vector<char>  known(position.MyLength());
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        {
          cell->get_dof_indices(dofs);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            {
              const int row = position.Map().LID(static_cast<int>(dofs[i]));
              if (row < 0 || known[row])
                continue;
              known[row] = 1;
              const Tensor<1, dim> x =
                solid.mapping.transform_unit_to_real_cell(cell, solid.fe.unit_support_point(i)) -
                frames[0].centre;
              position[row] = x[dofs[i] % dim] / frames[0].size;
            }
        }
  }



  /** The Gram matrix R^T B^T B R of section 9, by rows. A condition of one body gives a row over
   * its six motions; one of contact a row over those of both bodies, with opposite signs. The
   * matrix is tiny and the same on all ranks. Collective. */
  std::vector<double>
  RigidBodyModes::gram_matrix(const std::vector<Condition> &conditions) const
  {
    const unsigned int  n_bodies = solid.bodies.size();
    const unsigned int  n        = 6 * n_bodies;
    std::vector<double> gram(n * n, 0.), own(36 * n_bodies, 0.);
    for (const Condition &condition : conditions)
      {
        std::vector<std::pair<unsigned int, double>> row;
        const auto add = [&](const unsigned int b, const Tensor<1, dim> &x, const double sign) {
          for (unsigned int k = 0; k < 6; ++k)
            row.emplace_back(6 * b + k,
                             sign * (condition.direction *
                                     rigid_mode(k, (x - frames[b].centre) / frames[b].size)));
        };
        add(condition.body, condition.position, 1.);
        // Other nodes of its own face are in the stencil of a point that touches an obstacle.
        const bool own_alone =
          condition.stencil.empty() || condition.master_body == numbers::invalid_unsigned_int;
        if (!own_alone)
          add(condition.master_body, condition.master_position, -1.);
        for (const auto &[i, vi] : row)
          for (const auto &[j, vj] : row)
            {
              gram[i * n + j] += vi * vj;
              if (own_alone)
                own[36 * condition.body + 6 * (i % 6) + j % 6] += vi * vj;
            }
      }
    Utilities::MPI::sum(gram, solid.communicator, gram);
    Utilities::MPI::sum(own, solid.communicator, own);

    // A body that its own supports constrain fully takes part in no free motion, however few its
    // supports are beside the many conditions of contact.
    for (unsigned int b = 0; b < n_bodies; ++b)
      {
        const double *block   = &own[36 * b];
        const double  highest = *std::max_element(block, block + 36);
        if (highest == 0. || !positive_definite(block, 1e-8 * highest))
          continue;
        const double all = largest_entry(gram);
        for (unsigned int k = 0; k < 6; ++k)
          gram[(6 * b + k) * n + 6 * b + k] += all;
      }
    return gram;
  }



  /** The rigid motions of all bodies that no condition resists: the null space of the Gram matrix.
   * A motion counts as free if the conditions resist it by less than one part in 1e8 of the
   * best-resisted one (a resistance over a hundredth of a body's size is 1e4 times larger).
   * Collective. */
  FreeMotion
  RigidBodyModes::free_motion(const std::vector<Condition> &conditions, const double resisted) const
  {
    const std::vector<double> gram    = gram_matrix(conditions);
    const unsigned int        n       = 6 * solid.bodies.size();
    const double              largest = largest_entry(gram);
    FreeMotion                result;
    if (largest == 0.)
      {
        result.basis   = IdentityMatrix(n);
        result.n_modes = n;
      }
    else
      {
        LAPACKFullMatrix<double> matrix(n, n);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            matrix(i, j) = gram[i * n + j];
        // Singular values are eigenvalues here. Eigenvectors of a cluster of zeros by inverse
        // iteration, as LAPACK's syevx has them, need not converge.
        matrix.compute_svd();
        const auto is_free = [&](const unsigned int k) {
          return matrix.singular_value(k) <= resisted * largest;
        };
        // In descending order.
        unsigned int first = n;
        while (first > 0 && is_free(first - 1))
          --first;
        result.n_modes = n - first;
        result.basis.reinit(n, result.n_modes);
        const LAPACKFullMatrix<double> &vectors = matrix.get_svd_u();
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int v = 0; v < result.n_modes; ++v)
            result.basis(i, v) = vectors(i, first + v);
      }
    if (result.n_modes > 0)
      describe(result);
    return result;
  }



  std::vector<Condition>
  RigidBodyModes::all_motions(const unsigned int body) const
  {
    std::vector<Condition> result;
    for (unsigned int corner = 0; corner < dim; ++corner)
      for (unsigned int d = 0; d < dim; ++d)
        {
          Condition condition;
          condition.body         = body;
          condition.position     = frames[body].centre;
          condition.direction[d] = 1.;
          condition.position[corner] += frames[body].size;
          result.push_back(condition);
        }
    return result;
  }



  /** How much of each elementary motion lies in the free space, in words. */
  void
  RigidBodyModes::describe(FreeMotion &motion) const
  {
    std::ostringstream text;
    const char        *names = "xyz";
    for (unsigned int b = 0; b < solid.bodies.size(); ++b)
      {
        std::string mixed;
        for (unsigned int k = 0; k < 6; ++k)
          {
            double share = 0.;
            for (unsigned int v = 0; v < motion.n_modes; ++v)
              share += std::pow(motion.basis(6 * b + k, v), 2);
            if (share > 1e-3)
              {
                motion.bodies.insert(b);
                mixed += (mixed.empty() ? "" : " or ");
                mixed += (k < dim ? "move in " : "turn about ");
                mixed += names[k % dim];
                if (share < 0.99)
                  mixed += " (together with other motions)";
              }
          }
        if (!mixed.empty())
          text << (text.str().empty() ? "" : "; ") << "body '" << solid.bodies[b].name << "' can "
               << mixed;
      }
    motion.description = text.str();
  }



  Vector
  RigidBodyModes::stabilisation(const FreeMotion &motion,
                                const Vector     &unbalanced,
                                const double      distance,
                                const double      smallest) const
  {
    Vector        shift(solid.zero_vector());
    const Matrix &stiffness = solid.stiffness();

    // The six motions at an unknown; the columns turn about the centre of the first body, in
    // its size.
    const auto motions_at = [&](const unsigned int row) {
      const unsigned int    b = rigid->body[row];
      std::array<double, 6> result{};
      Tensor<1, dim>        direction;
      for (unsigned int d = 0; d < dim; ++d)
        direction[d] = result[d] = (*rigid)(d, row);
      for (unsigned int k = dim; k < 2 * dim; ++k)
        result[k] = ((*rigid)(k, row) * frames[0].size +
                     rigid_mode(k, frames[0].centre - frames[b].centre) * direction) /
                    frames[b].size;
      return result;
    };

    // The shift alpha diag(K) is to limit the free motion under the unbalanced forces f to about
    // @p distance: with the free modes R, alpha = |(R' diag(K) R)^-1 R' f| / distance, with the
    // resistance estimated from the mean diagonal of each body.
    // Work of the unbalanced forces on the modes of each body; sum of diagonals.
    const unsigned int  n = 6 * solid.bodies.size();
    std::vector<double> sums(n + solid.bodies.size(), 0.);
    // Square of each unknown's displacement in the free motions, and the largest.
    std::vector<double> share(rigid->body.size(), 0.);
    double              largest = 0.;
    for (unsigned int row = 0; row < rigid->body.size(); ++row)
      {
        const unsigned int          b     = rigid->body[row];
        const std::array<double, 6> modes = motions_at(row);
        for (unsigned int k = 0; k < 6; ++k)
          sums[6 * b + k] += unbalanced.begin()[row] * modes[k];
        sums[n + b] += stiffness.diagonal(row) / dim;
        for (unsigned int v = 0; v < motion.n_modes; ++v)
          {
            double displacement = 0.;
            for (unsigned int k = 0; k < 6; ++k)
              displacement += motion.basis(6 * b + k, v) * modes[k];
            share[row] += displacement * displacement;
          }
        largest = std::max(largest, share[row]);
      }
    Utilities::MPI::sum(sums, solid.communicator, sums);
    largest = Utilities::MPI::max(largest, solid.communicator);

    // The motion under these forces, of all modes together: which basis of the free motions is
    // found is round-off.
    dealii::Vector<double> work(motion.n_modes), moved(motion.n_modes);
    FullMatrix<double>     resistance(motion.n_modes, motion.n_modes);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int v = 0; v < motion.n_modes; ++v)
        {
          work(v) += motion.basis(i, v) * sums[i];
          for (unsigned int w = 0; w < motion.n_modes; ++w)
            resistance(v, w) += motion.basis(i, v) * motion.basis(i, w) * sums[n + i / 6];
        }
    resistance.gauss_jordan();
    resistance.vmult(moved, work);
    const double fraction = std::max(smallest, moved.l2_norm() / distance);
    // Only what takes part in the motion is held back: a body that can only turn is still free to
    // be displaced by the bodies that press it.
    for (unsigned int row = 0; row < rigid->body.size(); ++row)
      if (motion.bodies.count(rigid->body[row]) > 0)
        shift.begin()[row] = fraction * stiffness.diagonal(row) * share[row] / largest;
    return shift;
  }
} // namespace Touchstone

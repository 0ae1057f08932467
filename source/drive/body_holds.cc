// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pressing_rows.h>
#include <touchstone/drive/body_holds.h>
#include <touchstone/drive/driven_bodies.h>
#include <touchstone/solid/bodies.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <array>
#include <cmath>

// What holds bodies that supports leave a motion, and the rigid motions that it asks for
// (doc/theory.md 5).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    std::optional<Tensor<1, dim>>
    motion_of(const unsigned int body, const ContactRow &row, const Motions &motions)
    {
      if (!motions[body])
        return {};
      return motions[body]->at(contact_point(row));
    }
  } // namespace



  std::optional<Tensor<1, dim>>
  motion_faced(const StepOfBodies &step, const ContactRow &row, const Motions &motions)
  {
    if (!row.on_obstacle())
      return motion_of(row.master_body, row, motions);
    const RigidMotion obstacle = step.contact.pair(row).pairing().motion(step.time);
    return obstacle.since(row.motion, contact_point(row));
  }



  namespace
  {
    void
    add_supports(const StepOfBodies &step, const Vector &u, Holds &holds)
    {
      for (const auto &support : step.conditions.prescribed_directions())
        if (step.unsupported.count(support.body) > 0)
          {
            Point<dim> position = support.position;
            for (unsigned int d = 0; d < dim; ++d)
              position[d] += step.committed_u(dim * support.node + d);
            holds.of_bodies.push_back({support.body,
                                       position,
                                       support.direction,
                                       missing_displacement(support, step.time, u),
                                       0.});
          }
    }



    void
    add_rows(const StepOfBodies &step, const Motions &motions, Holds &holds)
    {
      // All ranks ask for all of them, so that each finds the same formula without a value.
      for (unsigned int p = 0; p < step.contact.n_pairs(); ++p)
        step.contact.pair(p).pairing().motion(step.time);
      const PressingRows pressing(step.contact);
      for (const ContactRow &row : step.contact.rows())
        {
          if (!row.tied && !pressing.contain(row))
            continue;
          const bool slave  = step.unsupported.count(row.body) > 0,
                     master = !row.on_obstacle() && step.unsupported.count(row.master_body) > 0;
          if (!slave && !master)
            continue;
          const unsigned int                  body = slave ? row.body : row.master_body;
          const std::optional<Tensor<1, dim>> motion =
            slave ? motion_faced(step, row, motions) : motion_of(row.body, row, motions);
          if ((slave && master) || !motion)
            {
              holds.unknown[body] = 1;
              if (slave && master)
                holds.unknown[row.master_body] = 1;
            }
          else if (step.contact.state(row).status == ContactStatus::slip)
            holds.of_bodies.push_back(
              {body, contact_point(row), row.normal, row.normal * *motion, row.size});
          else
            for (unsigned int d = 0; d < dim; ++d)
              {
                Tensor<1, dim> axis;
                axis[d] = 1.;
                holds.of_bodies.push_back({body, contact_point(row), axis, (*motion)[d], row.size});
              }
        }
    }



    /** What a hold resists of the motions of its body: three translations and three rotations. */
    std::array<double, n_rigid_modes>
    resisted(const Hold &hold, const Point<dim> &centre, const double size)
    {
      std::array<double, n_rigid_modes> result;
      const Tensor<1, dim> moment = cross_product_3d(hold.position - centre, hold.direction) / size;
      for (unsigned int d = 0; d < dim; ++d)
        {
          result[d]       = hold.direction[d];
          result[dim + d] = moment[d];
        }
      return result;
    }

    /** The x of least length with matrix x closest to rhs. */
    dealii::Vector<double>
    least_squares(const LAPACKFullMatrix<double> &matrix, const dealii::Vector<double> &rhs)
    {
      // What resists a motion by less than this part of the largest is round-off.
      constexpr double         given = 1e-8;
      LAPACKFullMatrix<double> inverse(matrix);
      inverse.compute_inverse_svd(given);
      dealii::Vector<double> result(rhs.size());
      inverse.vmult(result, rhs);
      return result;
    }
  } // namespace



  Holds
  holds_of_bodies(const StepOfBodies &step, const Vector &u, const Motions &motions)
  {
    Holds result;
    result.unknown.resize(step.solid.n_bodies());
    add_rows(step, motions, result);
    add_supports(step, u, result);
    return result;
  }



  std::vector<BodyMotion>
  closest_rigid_motions(const std::vector<Hold> &holds,
                        const unsigned int       n_bodies,
                        const MPI_Comm           communicator)
  {
    // Number of holds, sum of their positions, then of their distances squared.
    constexpr unsigned int n_sums = dim + 2;
    std::vector<double>    sums(n_sums * n_bodies);
    for (const Hold &hold : holds)
      {
        double *const sum = &sums[n_sums * hold.body];
        sum[0] += 1.;
        for (unsigned int d = 0; d < dim; ++d)
          sum[1 + d] += hold.position[d];
      }
    Utilities::MPI::sum(sums, communicator, sums);
    std::vector<BodyMotion> result(n_bodies);
    for (unsigned int b = 0; b < n_bodies; ++b)
      for (unsigned int d = 0; d < dim; ++d)
        if (sums[n_sums * b] > 0.)
          result[b].centre[d] = sums[n_sums * b + 1 + d] / sums[n_sums * b];
    std::vector<double> squares(n_bodies);
    for (const Hold &hold : holds)
      squares[hold.body] += hold.position.distance_square(result[hold.body].centre);
    Utilities::MPI::sum(squares, communicator, squares);
    const auto size = [&](const unsigned int b) {
      return squares[b] > 0. ? std::sqrt(squares[b] / sums[n_sums * b]) : 1.;
    };

    // The normal equations of each body: its matrix, then its right-hand side.
    constexpr unsigned int of_body = n_rigid_modes * (n_rigid_modes + 1);
    std::vector<double>    equations(of_body * n_bodies);
    for (const Hold &hold : holds)
      {
        const auto    row   = resisted(hold, result[hold.body].centre, size(hold.body));
        double *const first = &equations[of_body * hold.body];
        for (unsigned int i = 0; i < n_rigid_modes; ++i)
          {
            for (unsigned int j = 0; j < n_rigid_modes; ++j)
              first[n_rigid_modes * i + j] += row[i] * row[j];
            first[n_rigid_modes * n_rigid_modes + i] += row[i] * hold.motion;
          }
      }
    Utilities::MPI::sum(equations, communicator, equations);
    for (unsigned int b = 0; b < n_bodies; ++b)
      if (sums[n_sums * b] > 0.)
        {
          LAPACKFullMatrix<double> matrix(n_rigid_modes, n_rigid_modes);
          dealii::Vector<double>   rhs(n_rigid_modes);
          const double *const      first = &equations[of_body * b];
          for (unsigned int i = 0; i < n_rigid_modes; ++i)
            {
              for (unsigned int j = 0; j < n_rigid_modes; ++j)
                matrix(i, j) = first[n_rigid_modes * i + j];
              rhs(i) = first[n_rigid_modes * n_rigid_modes + i];
            }
          const dealii::Vector<double> motion = least_squares(matrix, rhs);
          for (unsigned int d = 0; d < dim; ++d)
            {
              result[b].shift[d] = motion(d);
              result[b].turn[d]  = motion(dim + d) / size(b);
            }
        }
    return result;
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/carried_bodies.h>
#include <touchstone/drive/driven_bodies.h>
#include <touchstone/drive/translations.h>
#include <touchstone/solid/bodies.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <array>
#include <cmath>

// First guesses of steps for bodies that supports move as they are (doc/theory.md 5).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** What a support misses at time @p t in the displacement @p u, length. */
    double
    missing(const BoundaryConditions::Prescribed &support, const double t, const Vector &u)
    {
      double result = support.displacement(t);
      for (unsigned int d = 0; d < dim; ++d)
        if (support.direction[d] != 0.)
          result -= support.direction[d] * u(dim * support.node + d);
      return result;
    }



    /** The translation of each body; zero if none brings it to its supports. Collective. */
    std::vector<Tensor<1, dim>>
    driven_motions(const BoundaryConditions &conditions,
                   const Solid              &solid,
                   const double              t,
                   const Vector             &u)
    {
      Translations translations(solid.n_bodies());
      for (const auto &support : conditions.prescribed_directions())
        translations.add(support.body, support.direction, missing(support, t, u));
      translations.complete(solid.communicator);
      std::vector<Tensor<1, dim>> motions;
      for (unsigned int body = 0; body < solid.n_bodies(); ++body)
        motions.push_back(translations.closest(body));
      // What supports of a body prescribe at most, and what they miss before and after.
      std::vector<double> largest(3 * solid.n_bodies());
      for (const auto &support : conditions.prescribed_directions())
        {
          const double                miss = missing(support, t, u);
          const std::array<double, 3> here = {
            {support.displacement(t), miss, miss - support.direction * motions[support.body]}};
          for (unsigned int k = 0; k < 3; ++k)
            largest[3 * support.body + k] =
              std::max(largest[3 * support.body + k], std::abs(here[k]));
        }
      Utilities::MPI::max(largest, solid.communicator, largest);
      constexpr double round_off = 1e-10;
      for (unsigned int body = 0; body < solid.n_bodies(); ++body)
        // A formula that has no finite value somewhere is an error of whoever prescribes it.
        if (const double *const of_body = &largest[3 * body];
            of_body[1] <= round_off * of_body[0] || of_body[2] > round_off * of_body[1] ||
            !numbers::is_finite(motions[body].norm()))
          motions[body] = 0.;
      return motions;
    }



    /** For each body whether any displacement of it is prescribed, or springs hold it. Collective.
     */
    std::vector<int>
    supported_bodies(const BoundaryConditions &conditions, const Solid &solid)
    {
      std::vector<int> result(solid.n_bodies());
      for (const auto &support : conditions.prescribed_directions())
        result[support.body] = 1;
      Utilities::MPI::max(result, solid.communicator, result);
      return result;
    }



    /** The motion of what a row faces; none of an obstacle where the guess leaves the body. */
    Tensor<1, dim>
    motion_faced(const Contact                     &contact,
                 const ContactRow                  &row,
                 const std::vector<Tensor<1, dim>> &motions,
                 const double                       t)
    {
      if (!row.on_obstacle())
        return motions[row.master_body];
      return motions[row.body].norm_square() > 0. ? motion_of_obstacle(contact, row, t)
                                                  : Tensor<1, dim>();
    }



    /** Let bodies stay that would be torn from what they are tied to. Collective. */
    void
    keep_tied_together(const Contact &contact, const double t, std::vector<Tensor<1, dim>> &motions)
    {
      constexpr double round_off = 1e-10;
      const auto       differ    = [](const Tensor<1, dim> &a, const Tensor<1, dim> &b) {
        return (a - b).norm() > round_off * std::max(a.norm(), b.norm());
      };
      std::vector<int> stay(motions.size());
      do
        {
          std::fill(stay.begin(), stay.end(), 0);
          for (const ContactRow &row : contact.rows())
            if (row.tied && row.has_partner &&
                differ(motions[row.body], motion_faced(contact, row, motions, t)))
              {
                stay[row.body] = 1;
                if (!row.on_obstacle())
                  stay[row.master_body] = 1;
              }
          Utilities::MPI::max(stay, contact.communicator(), stay);
          for (std::size_t body = 0; body < motions.size(); ++body)
            if (stay[body] == 1)
              motions[body] = 0.;
        }
      while (std::count(stay.begin(), stay.end(), 1) > 0);
    }



    /** By how much motions close gaps beyond zero, in sizes of the slave faces. Collective. */
    double
    deepest_overlap(const Contact                     &contact,
                    const std::vector<Tensor<1, dim>> &motions,
                    const double                       t)
    {
      double result = 0.;
      for (const ContactRow &row : contact.rows())
        if (row.has_partner)
          {
            const Tensor<1, dim> closing =
              motion_faced(contact, row, motions, t) - motions[row.body];
            result = std::max(result, (closing * row.normal - std::max(row.gap, 0.)) / row.size);
          }
      return Utilities::MPI::max(result, contact.communicator());
    }
  } // namespace



  bool
  move_driven_bodies(const BoundaryConditions &conditions,
                     const Contact            &contact,
                     const Solid              &solid,
                     const double              t,
                     Vector                   &u)
  {
    auto motions = driven_motions(conditions, solid, t, u);
    carry_bodies(contact, supported_bodies(conditions, solid), t, motions);
    keep_tied_together(contact, t, motions);
    if (std::all_of(motions.begin(),
                    motions.end(),
                    [](const Tensor<1, dim> &motion) { return motion.norm_square() == 0.; }) ||
        deepest_overlap(contact, motions, t) > 1.)
      return false;
    const auto bodies = bodies_of_unknowns(solid);
    for (std::size_t k = 0; k < bodies.size(); ++k)
      u.begin()[k] += motions[bodies[k]][solid.owned.nth_index_in_set(k) % dim];
    return true;
  }
} // namespace Touchstone

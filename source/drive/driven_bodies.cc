// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/driven_bodies.h>
#include <touchstone/drive/translations.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <array>
#include <cmath>

// First guesses of steps for bodies that supports move as they are (doc/theory.md 5).
namespace Touchstone
{
  using namespace dealii;

  double
  missing_displacement(const BoundaryConditions::Prescribed &support,
                       const double                          t,
                       const Vector                         &u)
  {
    double result = support.displacement(t);
    for (unsigned int d = 0; d < dim; ++d)
      if (support.direction[d] != 0.)
        result -= support.direction[d] * u(dim * support.node + d);
    return result;
  }



  namespace
  {
    /** The translation of each body; zero if none brings it to its supports. Collective. */
    std::vector<Tensor<1, dim>>
    driven_motions(const BoundaryConditions &conditions,
                   const Solid              &solid,
                   const double              t,
                   const Vector             &u)
    {
      Translations translations(solid.n_bodies());
      for (const auto &support : conditions.prescribed_directions())
        translations.add(support.body, support.direction, missing_displacement(support, t, u));
      translations.complete(solid.communicator);
      std::vector<Tensor<1, dim>> motions;
      for (unsigned int body = 0; body < solid.n_bodies(); ++body)
        motions.push_back(translations.closest(body));
      // What supports of a body prescribe at most, and what they miss before and after.
      std::vector<double> largest(3 * solid.n_bodies());
      for (const auto &support : conditions.prescribed_directions())
        {
          const double                miss = missing_displacement(support, t, u);
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



    /** The motion of what a row faces. */
    Tensor<1, dim>
    motion_faced(const ContactRow &row, const std::vector<Tensor<1, dim>> &motions)
    {
      return row.on_obstacle() ? Tensor<1, dim>() : motions[row.master_body];
    }



    /** Let bodies stay that would be torn from what they are tied to. Collective. */
    void
    keep_tied_together(const Contact &contact, std::vector<Tensor<1, dim>> &motions)
    {
      std::vector<int> stay(motions.size());
      do
        {
          std::fill(stay.begin(), stay.end(), 0);
          for (const ContactRow &row : contact.rows())
            if (row.tied && row.has_partner && motions[row.body] != motion_faced(row, motions))
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
    deepest_overlap(const Contact &contact, const std::vector<Tensor<1, dim>> &motions)
    {
      double result = 0.;
      for (const ContactRow &row : contact.rows())
        if (row.has_partner)
          {
            const Tensor<1, dim> closing = motion_faced(row, motions) - motions[row.body];
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
    keep_tied_together(contact, motions);
    if (std::all_of(motions.begin(),
                    motions.end(),
                    [](const Tensor<1, dim> &motion) { return motion.norm_square() == 0.; }) ||
        deepest_overlap(contact, motions) > 1.)
      return false;
    translate_bodies(solid, motions, u);
    return true;
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/reduction.h>
#include <touchstone/contact/turned_ties.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

// Rigid ends of bodies whose law knows small rotations only (doc/theory.md 4.6).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** By pair, 1 - cos(theta) of the obstacle that it is tied to; zero for others and for bodies
     * at finite strain. Collective. */
    std::vector<double>
    strains_of_turns(const Contact &contact)
    {
      std::vector<double> result(contact.n_pairs());
      for (const ContactRow &row : contact.rows())
        if (row.tied && row.on_obstacle() && row.motion.turned &&
            !contact.solid_model().bodies[row.body].material.finite_strain())
          result[row.pair] = std::clamp(0.5 * (3. - trace(row.motion.turn)), 0., 2.);
      Reduction all;
      for (double &turn : result)
        all.max(turn);
      all.over(contact.communicator());
      return result;
    }



    /** Mean norm of the linear strain of a body. Collective. */
    double
    mean_strain(const Contact &contact, const unsigned int body)
    {
      const Solid                         &solid = contact.solid_model();
      const Vector                         u     = contact.ghosted_displacement();
      const FEValuesExtractors::Vector     displacement(0);
      FEValues<dim>                        values(solid.mapping,
                           solid.fe,
                           QGauss<dim>(solid.fe.degree),
                           update_gradients | update_JxW_values);
      std::vector<SymmetricTensor<2, dim>> strains(values.n_quadrature_points);
      double                               volume = 0., sum = 0.;
      for (const auto &cell : solid.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned() && cell->material_id() == body)
          {
            values.reinit(cell);
            values[displacement].get_function_symmetric_gradients(u, strains);
            for (const unsigned int q : values.quadrature_point_indices())
              {
                volume += values.JxW(q);
                sum += values.JxW(q) * strains[q].norm();
              }
          }
      Reduction all;
      all.sum(volume);
      all.sum(sum);
      all.over(contact.communicator());
      return sum / volume;
    }
  } // namespace



  std::vector<std::string>
  turned_ties(const Contact &contact)
  {
    // Smaller turns are those of round-off, as of a body that nothing strains.
    constexpr double          part = 0.1, round_off = 1e-8;
    const std::vector<double> turns = strains_of_turns(contact);
    std::vector<std::string>  result;
    for (unsigned int p = 0; p < turns.size(); ++p)
      if (turns[p] > round_off)
        {
          const ContactPair &pair   = contact.pair(p);
          const double       strain = mean_strain(contact, pair.slave_body());
          if (turns[p] <= part * strain)
            continue;
          const BodyParameters &body = contact.solid_model().bodies[pair.slave_body()];
          char                  text[120];
          std::snprintf(text,
                        sizeof(text),
                        "%.3g degrees: there that is a strain of %.2g, beside a mean of %.2g",
                        std::acos(1. - turns[p]) * 180. / numbers::PI,
                        turns[p],
                        strain);
          result.push_back("contact pair '" + pair.parameters().name +
                           "' holds a boundary of body '" + body.name + "', of the 'Law' '" +
                           body.material.law.name +
                           "' for small rotations, as a rigid one that has turned by " + text +
                           " in the body. Take a law that turns with it: 'St. Venant-Kirchhoff' or "
                           "'neo-Hookean', 'finite-strain von Mises' for plasticity");
        }
    return result;
  }
} // namespace Touchstone

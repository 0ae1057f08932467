// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/turned_bodies.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

// Laws of small strain where bodies turn (doc/theory.md 2.1).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The strain that a turn makes without any deformation, from which on it is told of, and from
     * which on the stresses have nothing in common with those of the body. */
    constexpr double large = 1e-3, too_large = 0.1;

    /** Up to this norm of the gradient a turn of a cell counts for nothing. */
    constexpr double small_gradient = 0.02;

    /** Linear strain that the turn of a cell makes, 1 - cos(theta). */
    double
    strain_of_turn(const Tensor<2, dim> &gradient)
    {
      const Tensor<2, dim> deformation = unit_symmetric_tensor<dim>() + gradient;
      // Cells that are turned inside out are told of elsewhere.
      if (gradient.norm() < small_gradient || determinant(deformation) <= 0.)
        return 0.;
      const Tensor<2, dim> rotation = project_onto_orthogonal_tensors(deformation);
      return 1. - std::clamp(0.5 * (trace(rotation) - 1.), -1., 1.);
    }

    /** Mean of strain_of_turn() over the volume of each body of small strain; zero for others. */
    std::vector<double>
    mean_strains(const Solid &solid, const Vector &u)
    {
      const FEValuesExtractors::Vector displacement(0);
      // Enough for a mean of which more than 1e-3 counts.
      FEValues<dim>               values(solid.mapping,
                           solid.fe,
                           QGauss<dim>(solid.fe.degree),
                           update_gradients | update_JxW_values);
      std::vector<Tensor<2, dim>> gradients(values.n_quadrature_points);
      std::vector<double>         volumes(solid.bodies.size(), 0.), result(volumes);
      for (const auto &cell : solid.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned() && !solid.bodies[cell->material_id()].material.finite_strain())
          {
            values.reinit(cell);
            values[displacement].get_function_gradients(u, gradients);
            double         volume = 0.;
            Tensor<2, dim> gradient;
            for (const unsigned int q : values.quadrature_point_indices())
              {
                volume += values.JxW(q);
                gradient += values.JxW(q) * gradients[q];
              }
            volumes[cell->material_id()] += volume;
            result[cell->material_id()] += volume * strain_of_turn(gradient / volume);
          }
      Utilities::MPI::sum(volumes, solid.communicator, volumes);
      Utilities::MPI::sum(result, solid.communicator, result);
      for (std::size_t b = 0; b < result.size(); ++b)
        if (volumes[b] > 0.)
          result[b] /= volumes[b];
      return result;
    }
  } // namespace



  TurnedBodies
  turned_bodies(const Solid &solid, const Vector &u)
  {
    TurnedBodies              result;
    const std::vector<double> strains = mean_strains(solid, u);
    for (std::size_t b = 0; b < strains.size(); ++b)
      if (const double size = strains[b]; size > large)
        {
          char text[100];
          std::snprintf(text,
                        sizeof(text),
                        "%.3g degrees on average, which in this law is a strain of %.2g",
                        std::acos(std::max(-1., 1. - size)) * 180. / numbers::PI,
                        size);
          const std::string what =
            "body '" + solid.bodies[b].name + "', of the 'Law' '" +
            solid.bodies[b].material.law.name +
            "' for small strain and small rotations, has turned by " + text +
            " that no deformation belongs to: its stresses are wrong by up to that times the "
            "modulus. Take a law that turns with the body: 'St. Venant-Kirchhoff' or "
            "'neo-Hookean', 'finite-strain von Mises' for plasticity";
          if (size > too_large && result.failure.empty())
            result.failure = what;
          else
            result.warnings.push_back(what);
        }
    return result;
  }
} // namespace Touchstone

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

    /** Means over the volume of a body. */
    struct Means
    {
      double volume = 0.;
      /** Of strain_of_turn() of the cells. */
      double         strain = 0.;
      Tensor<2, dim> gradient;
    };

    /** Of bodies of small strain; zero for others. Collective. */
    std::vector<Means>
    means(const Solid &solid, const Vector &u)
    {
      const FEValuesExtractors::Vector displacement(0);
      // Enough for a mean of which more than 1e-3 counts.
      FEValues<dim>               values(solid.mapping,
                           solid.fe,
                           QGauss<dim>(solid.fe.degree),
                           update_gradients | update_JxW_values);
      std::vector<Tensor<2, dim>> gradients(values.n_quadrature_points);
      std::vector<Means>          result(solid.bodies.size());
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
            Means &body = result[cell->material_id()];
            body.volume += volume;
            body.strain += volume * strain_of_turn(gradient / volume);
            body.gradient += gradient;
          }
      for (Means &body : result)
        {
          body.volume = Utilities::MPI::sum(body.volume, solid.communicator);
          if (body.volume == 0.)
            continue;
          body.strain   = Utilities::MPI::sum(body.strain, solid.communicator) / body.volume;
          body.gradient = Utilities::MPI::sum(body.gradient, solid.communicator) / body.volume;
        }
      return result;
    }
  } // namespace



  EndFindings
  turned_bodies(const Solid &solid, const Vector &u)
  {
    EndFindings              result;
    const std::vector<Means> of_bodies = means(solid, u);
    for (std::size_t b = 0; b < of_bodies.size(); ++b)
      if (const double size = of_bodies[b].strain; size > large)
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
          // A bar whose parts alone have turned has the deflection of linear theory.
          result.add(what, strain_of_turn(of_bodies[b].gradient) > too_large);
        }
    return result;
  }
} // namespace Touchstone

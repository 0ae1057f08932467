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

    /** Integrals over the volume of a body. */
    struct Strains
    {
      double         volume = 0.;
      Tensor<2, dim> gradient;
    };

    std::vector<Strains>
    integrate(const Solid &solid, const Vector &u)
    {
      const FEValuesExtractors::Vector displacement(0);
      // Enough for a mean of which more than 1e-3 counts.
      FEValues<dim>               values(solid.mapping,
                           solid.fe,
                           QGauss<dim>(solid.fe.degree),
                           update_gradients | update_JxW_values);
      std::vector<Tensor<2, dim>> gradients(values.n_quadrature_points);
      std::vector<Strains>        result(solid.bodies.size());
      for (const auto &cell : solid.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned() && !solid.bodies[cell->material_id()].material.finite_strain())
          {
            Strains &body = result[cell->material_id()];
            values.reinit(cell);
            values[displacement].get_function_gradients(u, gradients);
            for (const unsigned int q : values.quadrature_point_indices())
              {
                body.volume += values.JxW(q);
                body.gradient += values.JxW(q) * gradients[q];
              }
          }
      for (Strains &body : result)
        {
          body.volume   = Utilities::MPI::sum(body.volume, solid.communicator);
          body.gradient = Utilities::MPI::sum(body.gradient, solid.communicator);
        }
      return result;
    }
  } // namespace



  TurnedBodies
  turned_bodies(const Solid &solid, const Vector &u)
  {
    TurnedBodies               result;
    const Tensor<2, dim>       identity = unit_symmetric_tensor<dim>();
    const std::vector<Strains> strains  = integrate(solid, u);
    for (unsigned int b = 0; b < strains.size(); ++b)
      if (const Strains &of = strains[b]; of.volume > 0.)
        {
          const Tensor<2, dim> mean     = of.gradient / of.volume,
                               rotation = project_onto_orthogonal_tensors(identity + mean);
          const double cosine           = std::clamp(0.5 * (trace(rotation) - 1.), -1., 1.),
                       size             = 1. - cosine;
          if (size <= large)
            continue;
          char text[100];
          std::snprintf(text,
                        sizeof(text),
                        "%.3g degrees, which in this law is a strain of %.2g",
                        std::acos(cosine) * 180. / numbers::PI,
                        size);
          const std::string what =
            "body '" + solid.bodies[b].name + "', of the 'Law' '" +
            solid.bodies[b].material.law.name +
            "' for small strain and small rotations, has turned by " + text +
            " without any deformation: its stresses are wrong by up to that times the "
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

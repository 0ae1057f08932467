// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/formula.h>
#include <touchstone/solid/body_parameters.h>
#include <touchstone/solid/solid.h>
#include <touchstone/solid/thermal_strain.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

// Thermal expansion of any law (doc/materials.md, "Thermal strain").
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /**
     * @brief A law that is given what is left of the deformation when the thermal expansion is
     * taken out of it.
     *
     * Small strain: strain less a T I. Finite strain: F / s with the stretch s = 1 + a T, the
     * multiplicative split of Stojanovic, Djuric and Vujosevic (1964), Int. J. Engng Sci. 1; the
     * energy of the law counts per volume of the expanded body, s^3 of the reference volume:
     *
     *   W(F) = s^3 W_law(F / s),  P = s^2 P_law,  dP/dF = s dP_law/dF.
     *
     * History of the law is that of the mechanical part, so it knows nothing of temperatures.
     *
     * State: that of the law; the energy that the change of temperature has brought into the point
     * since the start, by the trapezoidal rule over s; s; and the derivative of W by s.
     */
    class ThermalStrain : public MaterialLaw
    {
    public:
      ThermalStrain(const MaterialParameters                 &material,
                    const std::shared_ptr<const MaterialLaw> &law)
        : law(law)
        , finite(material.finite_strain())
        , coefficient(material.thermal_coefficient)
        // A value that is not finite is a failure of the law, on all ranks.
        , temperature("Material/Thermal expansion", "Temperature", material.temperature)
      {
      }

      unsigned int
      n_state() const override
      {
        return law->n_state() + own;
      }
      void
      start(double *state) const override
      {
        law->start(state);
        std::fill(state + law->n_state(), state + n_state(), 0.);
      }
      void
      restore(double *state) const override
      {
        law->restore(state);
      }
      double
      dissipation(const double *state) const override
      {
        // Heat that does work is the opposite of dissipation: so the ledger of energy closes.
        return law->dissipation(state) - state[law->n_state()];
      }
      bool
      stiffest_at_rest() const override
      {
        return law->stiffest_at_rest();
      }
      bool
      plastic() const override
      {
        return law->plastic();
      }
      double
      plastic_strain(const double *state) const override
      {
        return law->plastic_strain(state);
      }
      bool
      symmetric() const override
      {
        return law->symmetric();
      }
      bool
      can_fail() const override
      {
        return true;
      }

      bool
      admits(const MaterialInput &input) const override
      {
        const double         s          = stretch(input);
        const Tensor<2, dim> mechanical = without_expansion(input.deformation, s);
        return possible(s) &&
               law->admits(
                 {mechanical, input.committed, input.step_length, input.position, input.time});
      }

      void
      respond(const MaterialInput &input,
              const Demand         demand,
              MaterialResponse    &response,
              double              *present) const override
      {
        const double s = stretch(input);
        if (!possible(s))
          {
            response        = MaterialResponse();
            response.solved = false;
            return;
          }
        const Tensor<2, dim> mechanical = without_expansion(input.deformation, s);
        const MaterialInput  of_law{
          mechanical, input.committed, input.step_length, input.position, input.time};
        // Both are needed for the work of the expansion, and laws give one of them only when they
        // are asked for it.
        law->respond(of_law, Demand::energy, response, present);
        const double energy = response.energy, elastic_energy = response.elastic_energy;
        law->respond(of_law, demand == Demand::energy ? Demand::stress : demand, response, present);
        response.energy         = energy;
        response.elastic_energy = elastic_energy;
        // Zero marks virgin material, whose temperature has not changed yet.
        const double *before = input.committed + law->n_state();
        double       *after  = present + law->n_state();
        after[1]             = s;
        after[2]             = finite ? 3. * s * s * response.elastic_energy -
                              s * s * scalar_product(response.stress, mechanical)
                                      : -trace(response.stress);
        after[0] =
          before[0] + (before[1] > 0. ? 0.5 * (before[2] + after[2]) * (s - before[1]) : 0.);
        if (!finite)
          return;
        response.energy *= s * s * s;
        response.elastic_energy *= s * s * s;
        response.stress *= s * s;
        response.tangent *= s;
      }

    private:
      static constexpr unsigned int own = 3;

      const std::shared_ptr<const MaterialLaw> law;
      const bool                               finite;
      const double                             coefficient;
      const Formula                            temperature;

      double
      stretch(const MaterialInput &input) const
      {
        return 1. + coefficient * temperature.value(input.position, input.time);
      }

      /** False for what is not a number, too. */
      static bool
      possible(const double s)
      {
        return s > 0. && std::isfinite(s);
      }

      Tensor<2, dim>
      without_expansion(const Tensor<2, dim> &deformation, const double s) const
      {
        if (finite)
          return deformation / s;
        Tensor<2, dim> gradient = deformation;
        for (unsigned int d = 0; d < dim; ++d)
          gradient[d][d] -= s - 1.;
        return gradient;
      }
    };
  } // namespace



  std::shared_ptr<const MaterialLaw>
  with_thermal_strain(const MaterialParameters                 &material,
                      const std::shared_ptr<const MaterialLaw> &law)
  {
    return material.thermal() ? std::make_shared<ThermalStrain>(material, law) : law;
  }



  FormulaBounds
  possible_temperatures(const MaterialParameters &material)
  {
    FormulaBounds result;
    if (!material.thermal())
      return result;
    const double limit = -1. / material.thermal_coefficient;
    (material.thermal_coefficient > 0. ? result.lower : result.upper) = limit;
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << "1 + 'Coefficient' times this, the length of the material relative to that without "
           "thermal strain, is positive only "
        << (material.thermal_coefficient > 0. ? "above " : "below ") << limit;
    result.reason = out.str();
    return result;
  }



  void
  check_temperatures(const Solid &solid, const double t)
  {
    Formulas                                    all;
    std::vector<std::shared_ptr<const Formula>> of_body;
    for (const BodyParameters &body : solid.bodies)
      of_body.push_back(body.material.thermal()
                          ? all.add(body.section() + "/Material/Thermal expansion",
                                    "Temperature",
                                    body.material.temperature,
                                    possible_temperatures(body.material))
                          : nullptr);
    // Nothing but positions is asked for: any element does.
    const FE_Q<dim> scalar_fe(1);
    FEValues<dim>   values(solid.mapping,
                         scalar_fe,
                         QGauss<dim>(solid.fe.degree + 1),
                         update_quadrature_points);
    for (const auto &cell : solid.dof_handler.get_triangulation().active_cell_iterators())
      if (cell->is_locally_owned() && of_body[cell->material_id()])
        {
          values.reinit(cell);
          for (const Point<dim> &x : values.get_quadrature_points())
            of_body[cell->material_id()]->value(x, t);
        }
    all.check(solid.communicator);
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/verification/hill_tube.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

/**
 * @file
 * Hill's thick tube (doc/theory.md 10, equations (24) and (25)), incompressible and perfectly
 * plastic, optionally around an elastic core through which the pressure acts. All functions take
 * the pressure p at the interface; where the pressure inside the core is given, p follows from
 * equation (25).
 */

namespace Touchstone
{
  namespace
  {
    const ReferenceRegistry::Entry<HillTube> hill_tube_entry(
      "hill tube",
      "A thick tube about the z axis, incompressible and perfectly plastic (von Mises), in plane "
      "strain, under pressure in its bore, loaded or unloaded (Hill 1950). Values: 'inner radius', "
      "'outer radius', 'young modulus', 'poisson ratio' (near 0.5), 'yield stress'; the pressure "
      "in the bore at the peak as 'peak pressure', or, of an elastic core in the bore, 'core inner "
      "radius', 'core young modulus', 'core poisson ratio' and 'core peak pressure' (inside of it); "
      "without any the mean contact pressure counts; 'unloaded' (1: the pressure has gone since "
      "the peak).");

    /**
     * Zero of the growing function @p f in [low, high], by bisection: robust, and 100 halvings
     * reach round-off from any interval.
     */
    template <class Function>
    double
    root(double low, double high, const Function &f)
    {
      for (unsigned int step = 0; step < 100; ++step)
        {
          const double middle           = (low + high) / 2.;
          (f(middle) < 0. ? low : high) = middle;
        }
      return (low + high) / 2.;
    }
  } // namespace



  HillTube::HillTube(const Scene &scene)
    : HillTube(ReferenceValues(scene.reference.values), reference_pair(scene))
  {
  }



  HillTube::HillTube(ReferenceValues values, const unsigned int pair)
    : inner(values.positive_number("inner radius"))
    , outer(values.positive_number("outer radius"))
    , shear_modulus(values.positive_number("young modulus") /
                    (2. * (1. + values.number("poisson ratio"))))
    , shear_yield(values.positive_number("yield stress") / std::sqrt(3.))
    , has_core(values.has("core peak pressure"))
    , unloaded(values.number("unloaded", 0.) != 0.)
    , known_peak(values.number("peak pressure", std::nan("")))
    , pair(pair)
  {
    if (!(inner < outer))
      values.fail("\"outer radius\" is not larger than \"inner radius\".", "Correct the radii.");
    // Equations (24) hold for nu = 1/2; elements cannot take it exactly with a displacement
    // formulation, so values near it are allowed.
    const double nu = values.number("poisson ratio");
    if (!(nu >= 0.49 && nu <= 0.5))
      values.fail("The solution is that of incompressible material.",
                  "Give a \"poisson ratio\" from 0.49 to 0.5, in the material too.");

    // Pressure at which the plastic zone reaches the outer surface, c = b: p = 2 k ln(b/a). Beyond
    // it there is no equilibrium.
    const double collapse = 2. * shear_yield * std::log(outer / inner);
    if (has_core)
      {
        if (!std::isnan(known_peak))
          values.fail("There are both \"peak pressure\" and \"core peak pressure\".",
                      "Give one of them: the first follows from the second.");
        core_inner           = values.positive_number("core inner radius");
        core_young           = values.positive_number("core young modulus");
        core_nu              = values.number("core poisson ratio");
        const double applied = values.positive_number("core peak pressure");
        if (!(core_inner < inner))
          values.fail("\"core inner radius\" is not smaller than \"inner radius\".",
                      "Correct the radii.");
        if (!(-1. < core_nu && core_nu <= 0.5))
          values.fail("\"core poisson ratio\" must lie between -1 and 0.5.", "Correct the number.");
        // The relation between both pressures grows monotonically up to collapse, hence bisection.
        if (applied > core_pressure(collapse))
          values.fail("\"core peak pressure\" makes the whole tube plastic.", "Make it smaller.");
        known_peak = root(0., collapse, [&](const double p) { return core_pressure(p) - applied; });
      }
    values.finish();
    if (known_peak < 0. || known_peak > collapse)
      values.fail("\"peak pressure\" must be positive, and leave a part of the tube elastic.",
                  "Make it smaller than 2/sqrt(3) yield stress log(outer radius/inner radius).");
    if (unloaded && std::isnan(known_peak))
      values.fail("\"unloaded\" needs a peak that it is unloaded from.",
                  "Give \"peak pressure\" or the values of the core.");
    // Elastic unloading is valid up to d = 2 k (1 - a^2/b^2).
    if (unloaded && known_peak > 2. * shear_yield * (1. - std::pow(inner / outer, 2)))
      values.fail(
        "From such a peak the tube would yield again when it is unloaded.",
        "Make the peak smaller, or \"outer radius\" less than 2.2 times \"inner radius\".");
  }



  double
  HillTube::plastic_radius(const double pressure) const
  {
    // Equation (24): p/k = 1 - c^2/b^2 + 2 ln(c/a), solved for c. A negative excess at c = a means
    // that the tube has yielded.
    const auto excess = [&](const double c) {
      return 1. - c * c / (outer * outer) + 2. * std::log(c / inner) - pressure / shear_yield;
    };
    return excess(inner) >= 0. ? inner : root(inner, outer, excess);
  }



  double
  HillTube::elastic_amplitude(const double pressure) const
  {
    // m of the elastic tube, in sigma = m (1/b^2 -+ 1/r^2).
    return pressure / (1. / (inner * inner) - 1. / (outer * outer));
  }



  double
  HillTube::amplitude(const double pressure) const
  {
    const double c = plastic_radius(pressure);
    // m = k c^2 while a part of the tube has yielded, otherwise that of Lame's elastic tube.
    return c > inner ? shear_yield * c * c : elastic_amplitude(pressure);
  }



  double
  HillTube::core_pressure(const double pressure) const
  {
    // Equation (25), solved for the pressure inside the core, with u_r(a) = m / (2 G a) of the
    // tube.
    const double a2 = inner * inner, i2 = core_inner * core_inner;
    const double u = amplitude(pressure) / (2. * shear_modulus * inner);
    return (u * core_young * (a2 - i2) / ((1. + core_nu) * inner) +
            pressure * ((1. - 2. * core_nu) * a2 + i2)) /
           (2. * (1. - core_nu) * i2);
  }



  HillTube::Stress
  HillTube::stress(const double r, const double peak, const double pressure) const
  {
    // Stresses of Lame's solution for the amplitude m.
    const auto elastic = [&](const double m) {
      return std::make_pair(m * (1. / (outer * outer) - 1. / (r * r)),
                            m * (1. / (outer * outer) + 1. / (r * r)));
    };
    const double c      = plastic_radius(peak);
    auto [radial, hoop] = elastic(amplitude(peak));
    if (r < c)
      {
        radial = shear_yield * (c * c / (outer * outer) - 1. - 2. * std::log(c / r));
        hoop   = radial + 2. * shear_yield;
      }
    // Unloading is elastic everywhere: Lame's stress of the change of pressure is subtracted.
    const auto [radial_change, hoop_change] = elastic(elastic_amplitude(peak - pressure));
    radial -= radial_change;
    hoop -= hoop_change;
    return {radial, hoop, (radial + hoop) / 2.};
  }



  ReferenceComparison
  HillTube::compare(const ReferenceInput &input) const
  {
    double force = 0., area = 0.;
    for (const ContactPoint &point : points_of_pair(input.points, pair))
      if (point.status >= ContactStatus::slip)
        {
          force += point.pressure * point.area;
          area += point.area;
        }
    force = dealii::Utilities::MPI::sum(force, input.communicator);
    area  = dealii::Utilities::MPI::sum(area, input.communicator);
    // Without a prescribed peak the exact solution is that of the computed mean contact pressure,
    // which itself is then not compared.
    const double mean   = area > 0. ? force / area : 0.;
    const double peak   = std::isnan(known_peak) ? mean : known_peak;
    const double now    = unloaded ? 0. : peak;
    const double change = elastic_amplitude(peak - now);

    // In the elastic zone m = (sigma_theta - sigma_r) r^2 / 2 is the same at all points (less what
    // unloading has taken away), and c = sqrt(m / k): the radius of the plastic zone is obtained
    // from stresses, not by counting plastic cells, which would resolve it to a cell only.
    enum
    {
      error_squared,
      size_squared,
      elastic_volume,
      sum_of_m
    };
    std::array<double, 4> sums{};
    input.solid->for_each_stress(
      *input.displacement,
      [&](unsigned int,
          const dealii::Point<dim>              &x,
          const dealii::SymmetricTensor<2, dim> &computed,
          const double                           volume) {
        const double r = std::hypot(x[0], x[1]);
        // Points of the core, and of facets that lie outside the exact radii.
        if (r < inner || r > outer)
          return;
        // Radial and circumferential directions at the point.
        const dealii::Tensor<1, dim> e_r({x[0] / r, x[1] / r, 0.});
        const dealii::Tensor<1, dim> e_t({-x[1] / r, x[0] / r, 0.});
        const double                 radial = e_r * (computed * e_r);
        const double                 hoop   = e_t * (computed * e_t);
        const Stress                 exact  = stress(r, peak, now);
        const auto                   square = [](const double y) { return y * y; };
        sums[error_squared] += volume * (square(radial - exact.radial) + square(hoop - exact.hoop) +
                                         square(computed[2][2] - exact.axial));
        sums[size_squared] +=
          volume * (square(exact.radial) + square(exact.hoop) + square(exact.axial));
        // Points above 95 % of the yield limit are left out: the transition is smeared over a cell.
        const double m = (hoop - radial) * r * r / 2. + change;
        if (m < 0.95 * shear_yield * r * r)
          {
            sums[elastic_volume] += volume;
            sums[sum_of_m] += volume * m;
          }
      });
    for (double &sum : sums)
      sum = dealii::Utilities::MPI::sum(sum, input.communicator);

    ReferenceComparison result;
    if (!unloaded && !std::isnan(known_peak))
      result.add("contact_pressure_mean", "contact pressure, mean", mean, peak);
    const double c = plastic_radius(peak);
    if (c > inner)
      result.add("elastic_plastic_radius",
                 "radius of the plastic zone",
                 sums[elastic_volume] > 0.
                   ? std::sqrt(sums[sum_of_m] / (sums[elastic_volume] * shear_yield))
                   : outer,
                 c);
    result.add("stress_l2",
               unloaded ? "residual stress" : "stress",
               sums[size_squared] > 0. ? std::sqrt(sums[error_squared] / sums[size_squared])
                                       : std::nan(""));
    return result;
  }
} // namespace Touchstone

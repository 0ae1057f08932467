// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/solid/hardening_law.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

// The isotropic hardening laws of doc/materials.md, "Keys": yield stress k(p) over the equivalent
// plastic strain p, its derivative, and its integral, the plastic work per reference volume that
// isotropic hardening stores or dissipates. Curves that fall are refused for all laws.
namespace Touchstone
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  namespace
  {
    [[noreturn]] void
    throw_negative(const std::string &section, const std::string &key, const double value)
    {
      // Softening without a length in the material depends on the mesh: the limit of refinement
      // is no dissipation at all (doc/materials.md, "Keys").
      throw InputError(section,
                       key,
                       Patterns::Tools::to_string(value),
                       "must not be negative: the plastic strain of softening material "
                       "concentrates in a single layer of cells, however fine the mesh",
                       "give zero or more, or 'Hardening = none'");
    }

    /** No hardening; the base class of the other laws. */
    class Perfect : public HardeningLaw
    {
    public:
      void
      declare(ParameterHandler &prm) override
      {
        prm.add_parameter("Yield stress",
                          yield_stress,
                          "Uniaxial stress at which plastic flow begins, greater than zero. "
                          "Required. [force per area]",
                          Patterns::Double(),
                          /*has_to_be_set=*/true);
      }

      void
      check(const std::string &section) const override
      {
        if (!(yield_stress > 0.))
          throw InputError(section,
                           "Yield stress",
                           Patterns::Tools::to_string(yield_stress),
                           "must be positive",
                           "give the yield stress in the scene's unit of force per area, e.g. 250 "
                           "for mild steel in N and mm");
      }

      YieldStress
      at(const double plastic_strain) const override
      {
        return {yield_stress, 0., yield_stress * plastic_strain};
      }

    protected:
      double yield_stress = 0.;
    };



    class Linear : public Perfect
    {
    public:
      void
      declare(ParameterHandler &prm) override
      {
        Perfect::declare(prm);
        prm.add_parameter("Hardening modulus",
                          modulus,
                          "Increase of the yield stress per plastic strain, at least zero. "
                          "[force per area]",
                          Patterns::Double());
      }

      void
      check(const std::string &section) const override
      {
        Perfect::check(section);
        if (!(modulus >= 0.))
          throw_negative(section, "Hardening modulus", modulus);
      }

      YieldStress
      at(const double plastic_strain) const override
      {
        // Value, derivative, integral over the plastic strain, as in all laws here.
        return {yield_stress + modulus * plastic_strain,
                modulus,
                (yield_stress + 0.5 * modulus * plastic_strain) * plastic_strain};
      }

    private:
      double modulus = 0.;
    };



    /** Voce (1955), Metallurgia 51. */
    class Voce : public Perfect
    {
    public:
      void
      declare(ParameterHandler &prm) override
      {
        Perfect::declare(prm);
        prm.add_parameter("Saturation stress",
                          saturation,
                          "Yield stress that exponential hardening tends to, at least 'Yield "
                          "stress'. Required. [force per area]",
                          Patterns::Double(),
                          /*has_to_be_set=*/true);
        prm.add_parameter("Saturation rate",
                          rate,
                          "How fast: the rest decreases by the factor e with each plastic "
                          "strain of 1 / rate; greater than zero. Required. [no unit]",
                          Patterns::Double(),
                          /*has_to_be_set=*/true);
        prm.add_parameter("Hardening modulus",
                          modulus,
                          "Linear hardening that is added, at least zero. [force per area]",
                          Patterns::Double());
      }

      void
      check(const std::string &section) const override
      {
        Perfect::check(section);
        if (!(saturation >= yield_stress))
          throw InputError(section,
                           "Saturation stress",
                           Patterns::Tools::to_string(saturation),
                           "is less than 'Yield stress', " +
                             Patterns::Tools::to_string(yield_stress) +
                             ": the material would soften",
                           "give the stress that the curve tends to, not its increase");
        if (!(rate > 0.))
          throw InputError(section,
                           "Saturation rate",
                           Patterns::Tools::to_string(rate),
                           "must be positive",
                           "give the rate of exponential hardening, e.g. 16.93");
        if (!(modulus >= 0.))
          throw_negative(section, "Hardening modulus", modulus);
      }

      YieldStress
      at(const double plastic_strain) const override
      {
        // k(p) = k_inf - (k_inf - k_0) exp(-rate p) + H p. Its integral has the term (k_inf -
        // k_0) (exp(-rate p) - 1) / rate, for which expm1 keeps the digits at small plastic
        // strain.
        const double height = saturation - yield_stress;
        const double rest   = std::exp(-rate * plastic_strain);
        return {saturation - height * rest + modulus * plastic_strain,
                height * rate * rest + modulus,
                (saturation + 0.5 * modulus * plastic_strain) * plastic_strain +
                  height / rate * std::expm1(-rate * plastic_strain)};
      }

    private:
      double saturation = 0., rate = 0., modulus = 0.;
    };



    /** Straight lines between points, and constant after the last one. */
    class Table : public HardeningLaw
    {
    public:
      void
      declare(ParameterHandler &prm) override
      {
        prm.add_parameter("Yield curve",
                          points,
                          "Pairs 'plastic strain: yield stress', ascending, the first at plastic "
                          "strain 0, e.g. '0: 250, 0.05: 310, 0.2: 350'. Straight in between, and "
                          "constant after the last one. Required. [no unit: force per area]",
                          *Patterns::Tools::Convert<Points>::to_pattern(),
                          /*has_to_be_set=*/true);
      }

      void
      check(const std::string &section) const override
      {
        // A curve must begin at plastic strain zero, with the initial yield stress: without that
        // point the elastic range would be undefined.
        const auto complain = [&](const std::string &problem, const std::string &remedy) {
          throw InputError(
            section, "Yield curve", Patterns::Tools::to_string(points), problem, remedy);
        };
        if (points.empty())
          complain("has no points", "give pairs, e.g. '0: 250, 0.05: 310, 0.2: 350'");
        if (points.front().first != 0.)
          complain("does not begin at plastic strain 0",
                   "subtract stress / Young's modulus from total strains, and let the first pair "
                   "be '0: initial yield stress'");
        if (!(points.front().second > 0.))
          complain("the first stress is not positive", "give the initial yield stress there");
        for (unsigned int k = 1; k < points.size(); ++k)
          {
            if (!(points[k].first > points[k - 1].first))
              complain("the plastic strains do not ascend", "sort the pairs by strain");
            if (!(points[k].second >= points[k - 1].second))
              complain("the stress decreases: the plastic strain of softening material "
                       "concentrates in a single layer of cells, however fine the mesh",
                       "let the curve rise or stay constant; Cauchy stress rises where "
                       "engineering stress falls");
          }
      }

      YieldStress
      at(const double plastic_strain) const override
      {
        // Work is the integral of all complete lines and of the part of the line that holds the
        // strain; the slope is that of this line, so at a point of the table that of the line
        // which begins there.
        double work = 0.;
        for (unsigned int k = 1; k < points.size(); ++k)
          {
            const auto &[begin, low] = points[k - 1];
            const auto &[end, high]  = points[k];
            const double slope       = (high - low) / (end - begin);
            const double part        = std::min(plastic_strain, end) - begin;
            work += (low + 0.5 * slope * part) * part;
            if (plastic_strain < end)
              return {low + slope * part, slope, work};
          }
        const auto &[end, high] = points.back();
        return {high, 0., work + high * (plastic_strain - end)};
      }

    private:
      using Points = std::vector<std::pair<double, double>>;
      Points points;
    };

    const HardeningLawRegistry::Entry<Perfect> none("none",
                                                    "perfect plasticity, a constant yield stress.");
    const HardeningLawRegistry::Entry<Linear>  linear("linear", "a straight line.");
    const HardeningLawRegistry::Entry<Voce>
                                             voce("Voce",
           "exponential saturation, yield + (saturation - yield) (1 - exp(-rate p)) + modulus p.");
    const HardeningLawRegistry::Entry<Table> table("table", "straight lines between given points.");
  } // namespace
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later
// Plastic laws at a point under uniaxial stress against exact solutions: monotone loading
// for each hardening, at small strain and in logarithmic strain; the reversal of kinematic
// hardening (Bauschinger); Armstrong and Frederick's back stress against its closed form,
// with halved steps; plastic work against the area under the curve. A step of any size is
// answered, and a hardening law without numbers is a failure that says so.

#include <touchstone/solid/material_law.h>
#include <touchstone/solid/von_mises.h>

#include <deal.II/lac/full_matrix.h>

#include "mesh_common.h"
#include "plasticity_support.h"
#include <limits>

using namespace Touchstone;
using namespace dealii;

namespace
{
  constexpr double E = 1000., nu = 0.3;

  /** A point that is stretched along x while the other stresses vanish. */
  class Bar
  {
  public:
    explicit Bar(const MaterialParameters &material)
      : finite(material.finite_strain())
    {
      if (finite)
        law = material.law.make<FiniteStrainRegistry>(material);
      else
        law = material.law.make<SmallStrainRegistry>(material);
      state.resize(law->n_state());
      law->start(state.data());
    }

    /** Go on to an axial strain (logarithmic at finite strain) and keep the state.
     * @return the axial stress: of Kirchhoff at finite strain. */
    double
    stretch_to(const double strain)
    {
      MaterialResponse    response;
      std::vector<double> present(state.size());
      lateral -= 0.4 * (strain - axial);
      axial = strain;
      for (unsigned int iteration = 0;; ++iteration)
        {
          Tensor<2, dim> F;
          F[0][0] = finite ? std::exp(axial) : axial;
          F[1][1] = F[2][2] = finite ? std::exp(lateral) : lateral;
          law->respond({F, state.data(), 0.}, Demand::tangent, response, present.data());
          const double residual = response.stress[1][1];
          if (std::abs(residual) < 1e-12 || iteration == 50)
            {
              if (iteration == 50 || !response.solved)
                std::cout << "no lateral strain found FAILED" << std::endl;
              state          = present;
              energy         = response.elastic_energy;
              const double P = response.stress[0][0];
              return finite ? P * F[0][0] : P;
            }
          const double slope = response.tangent[1][1][1][1] + response.tangent[1][1][2][2];
          if (finite)
            lateral = std::log(F[1][1] - residual / slope);
          else
            lateral -= residual / slope;
        }
    }

    double
    plastic_strain() const
    {
      return law->plastic_strain(state.data());
    }
    double
    plastic_work() const
    {
      return law->dissipation(state.data());
    }

    double axial = 0., lateral = 0., energy = 0.;

  private:
    const bool                         finite;
    std::shared_ptr<const MaterialLaw> law;
    std::vector<double>                state;
  };

  const std::vector<std::string> laws = {"small-strain von Mises", "finite-strain von Mises"};

  /** One step to a large strain, and on in two more: isotropic and linear kinematic
   * hardening are exact in each. */
  void
  monotone(const std::string &law)
  {
    const auto stress = [](const std::string &name, const double p) {
      return name == "none"        ? 2.
             : name == "linear"    ? 2. + 50. * p
             : name == "kinematic" ? 2. + 80. * p
             : name == "table"     ? (p < 0.01  ? 2. + 100. * p
                                      : p < 0.1 ? 3. + (p - 0.01) / 0.09
                                                : 4.)
                                   : 4. - 2. * std::exp(-30. * p) + 5. * p;
    };
    for (const HardeningCase &hardening : hardening_cases)
      if (hardening.name.find("Armstrong") == std::string::npos)
        {
          Bar    bar(plastic_material(law, hardening.entries, E, nu));
          double error = 0., sideways = 0.;
          for (const double strain : {0.001, 0.01, 0.05, 0.3})
            {
              const double sigma = bar.stretch_to(strain), p = bar.plastic_strain();
              error =
                std::max({error,
                          std::abs(sigma / (p > 0. ? stress(hardening.name, p) : E * strain) - 1.),
                          std::abs((sigma / E + p) / strain - 1.)});
              sideways =
                std::max(sideways, std::abs((-nu * sigma / E - 0.5 * p) / bar.lateral - 1.));
            }
          // int sigma dp by Simpson's rule between the corners of the table.
          double       area = 0.;
          const double end  = bar.plastic_strain();
          for (const auto &[from, to] :
               {std::make_pair(0., 0.01), std::make_pair(0.01, 0.1), std::make_pair(0.1, end)})
            for (unsigned int k = 0; k < 100; ++k)
              {
                const double h = (to - from) / 100., a = from + k * h + 1e-14, b = a + h - 2e-14;
                area += h / 6. *
                        (stress(hardening.name, a) + 4. * stress(hardening.name, 0.5 * (a + b)) +
                         stress(hardening.name, b));
              }
          std::cout << law << ", " << hardening.name << ", tension: stress " << small(error, 1e-11)
                    << ", lateral strain " << small(sideways, 1e-11) << ", plastic work "
                    << small(bar.plastic_work() / area - 1., 1e-8) << ", elastic energy "
                    << small(bar.energy / (0.5 * std::pow(stress(hardening.name, end), 2) / E) - 1.,
                             1e-11)
                    << std::endl;
        }
  }

  /** Linear kinematic hardening: after tension to sigma the material yields in compression
   * at sigma - 2 yield; with isotropic hardening at -sigma. */
  void
  bauschinger(const std::string &law)
  {
    for (const std::string name : {"linear", "kinematic"})
      {
        const auto   hardening = std::find_if(hardening_cases.begin(),
                                            hardening_cases.end(),
                                            [&](const auto &h) { return h.name == name; });
        Bar          bar(plastic_material(law, hardening->entries, E, nu));
        const double sigma = bar.stretch_to(0.02), p = bar.plastic_strain();
        const double reverse = name == "linear" ? -sigma : sigma - 4.;
        const double at      = 0.02 - (sigma - reverse) / E;
        const double before  = bar.stretch_to(at + 1e-6);
        const double elastic = bar.plastic_strain() - p;
        bar.stretch_to(at - 1e-4);
        std::cout << law << ", " << name << ", reversal: elastic down to the yield stress "
                  << small(elastic, 1e-15) << ", stress there "
                  << small((before - reverse) / (1e-6 * E) - 1., 1e-6) << ", plastic beyond "
                  << (bar.plastic_strain() > p + 1e-5 ? "yes" : "NO") << std::endl;
      }
  }

  /** Cycles of Armstrong and Frederick. On the way from a state with back stress x0 in
   * direction s: x = s C/gamma + (x0 - s C/gamma) exp(-gamma |dp|). */
  double
  cycles(const std::string &law, const unsigned int n_steps)
  {
    const auto hardening =
      std::find_if(hardening_cases.begin(), hardening_cases.end(), [](const auto &h) {
        return h.name == "Armstrong-Frederick";
      });
    Bar    bar(plastic_material(law, hardening->entries, E, nu));
    double back = 0., direction = 1., p = 0., error = 0.;
    for (const double end : {0.03, -0.03, 0.03, -0.03})
      {
        const double begin = bar.axial;
        double       sigma = 0.;
        for (unsigned int step = 1; step <= n_steps; ++step)
          sigma = bar.stretch_to(begin + (end - begin) * step / n_steps);
        back =
          direction * 2. + (back - direction * 2.) * std::exp(-40. * (bar.plastic_strain() - p));
        p     = bar.plastic_strain();
        error = std::max(error, std::abs(sigma - (back + direction * 2.)) / 4.);
        direction *= -1.;
      }
    return error;
  }

  /** Ten to a million times the strain at yield in one step, in random directions. */
  void
  large_steps()
  {
    // The jump makes Newton's method alone go to and fro between its two sides for ever.
    std::vector<HardeningCase> cases = hardening_cases;
    cases.push_back({"jump", {"Hardening=table", "Yield curve=0: 2, 0.03: 2, 0.0301: 40, 1: 40"}});
    for (const HardeningCase &hardening : cases)
      {
        const VonMises von_mises(plastic_material(laws[0], hardening.entries, E, nu));
        const auto     material = plastic_material(laws[0], hardening.entries, E, nu);
        double         error    = 0.;
        unsigned int   seed     = 1;
        for (double size = 0.02; size < 3000.; size *= 1.7)
          {
            SymmetricTensor<2, dim> trial, back;
            for (unsigned int c = 0; c < 6; ++c)
              {
                seed                      = 1664525u * seed + 1013904223u;
                trial.access_raw_entry(c) = size * (seed / 4294967296. - 0.5);
                seed                      = 1664525u * seed + 1013904223u;
                back.access_raw_entry(c)  = seed / 4294967296. - 0.5;
              }
            back = material.kinematic_modulus > 0. ? deviator(back) : 0. * back;
            const ReturnMapping point = von_mises.respond(trial, 0.02, back, true);
            const double        yield = material.hardening->at(point.plastic_strain).value;
            const double        norm =
              std::sqrt(1.5) * (deviator(point.stress) - point.back_stress).norm();
            error = std::max(error, point.solved ? std::abs(norm - yield) / (E * size) : 1.);
          }
        std::cout << hardening.name
                  << ", steps up to a million times the yield strain: on the yield surface "
                  << small(error, 1e-12) << std::endl;
      }
  }

  /** A law that has no number beyond some strain. */
  class Broken : public HardeningLaw
  {
  public:
    void
    declare(ParameterHandler &) override
    {
    }
    void
    check(const std::string &) const override
    {
    }
    YieldStress
    at(const double p) const override
    {
      return {p > 0.01 ? std::numeric_limits<double>::quiet_NaN() : 2. + p, 1., 0.};
    }
  };

  void
  failure()
  {
    MaterialParameters material = plastic_material(laws[0], {"Yield stress=2"}, E, nu);
    material.hardening          = std::make_shared<Broken>();
    const VonMises          von_mises(material);
    SymmetricTensor<2, dim> trial;
    trial[0][1]       = 0.1;
    const bool large  = von_mises.respond(trial, 0., {}, false).solved;
    trial[0][1]       = 0.002;
    const bool little = von_mises.respond(trial, 0., {}, false).solved;
    std::cout << "hardening without numbers: " << (large ? "NOT SEEN" : "seen")
              << ", within its range " << (little ? "solved" : "NOT SOLVED") << std::endl;
  }
} // namespace

int
main()
{
  for (const std::string &law : laws)
    {
      monotone(law);
      bauschinger(law);
      const double coarse = cycles(law, 50), fine = cycles(law, 100);
      std::cout << law << ", Armstrong-Frederick, two cycles: error "
                << (fine < 0.01 ? "< 0.01" : "TOO LARGE") << ", halved with the step: "
                << (fine / coarse > 0.45 && fine / coarse < 0.55 ? "yes" : "NO") << ' '
                << std::endl;
    }
  large_steps();
  failure();
  return 0;
}

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_time_parameters_h
#define touchstone_drive_time_parameters_h

#include <touchstone/base/keyword.h>
#include <touchstone/explicit/explicit_parameters.h>
#include <touchstone/solid/mass.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace Touchstone
{
  /** @brief Section "Time integration": whether the bodies have inertia, and how their
   * motion is integrated. */
  struct TimeIntegrationParameters
  {
    /** No inertia, or a member of the generalized-alpha family. */
    enum class Scheme
    {
      statics,
      newmark,
      hht,
      generalized_alpha,
      /** With the mass of slave nodes moved to their neighbours. */
      contact_stabilized,
      /** Explicit. */
      central_differences
    };
    Keyword<Scheme>   scheme{Scheme::statics,
                           {{"static", Scheme::statics},
                              {"newmark", Scheme::newmark},
                              {"hht", Scheme::hht},
                              {"generalized_alpha", Scheme::generalized_alpha},
                              {"contact_stabilized", Scheme::contact_stabilized},
                              {"central_differences", Scheme::central_differences}}};
    Keyword<MassKind> mass{MassKind::consistent,
                           {{"consistent", MassKind::consistent},
                            {"lumped", MassKind::lumped},
                            {"dispersion corrected", MassKind::dispersion_corrected}}};
    /** gamma of newmark; no unit. */
    double newmark_gamma = 0.5;
    /** beta of newmark, a number or "automatic": (gamma + 1/2)^2 / 4. */
    std::string newmark_beta = "automatic";
    /** alpha of hht, 0 to 1/3; no unit. */
    double hht_alpha = 0.05;
    /** Spectral radius at infinite frequency of generalized_alpha and
     * contact_stabilized, 0 to 1, a number or "automatic": 0.8 and 1. */
    std::string spectral_radius = "automatic";
    /** What becomes of the velocity of nodes that meet. */
    enum class Impact
    {
      automatic,
      elastic,
      plastic
    };
    Keyword<Impact> impact{Impact::automatic,
                           {{"automatic", Impact::automatic},
                            {"elastic", Impact::elastic},
                            {"plastic", Impact::plastic}}};
    /** Whether steps are shortened so that they end where bodies meet. */
    enum class Adapt
    {
      automatic,
      none,
      impacts
    };
    Keyword<Adapt> adapt{Adapt::automatic,
                         {{"automatic", Adapt::automatic},
                          {"none", Adapt::none},
                          {"impacts", Adapt::impacts}}};
    /** Energy that contact may take or give in a step without the step being
     * shortened, relative to the energy in the bodies; no unit. */
    double impact_tolerance = 1e-4;
    /** Shortest step that ends at an impact, relative to the nominal step size; no unit. */
    double smallest_step = 1e-3;
    /** Unexplained gain of energy that ends the run, relative to the largest energy so
     * far; no unit. */
    double gain_tolerance = 0.01;

    /** Of explicit schemes. */
    ExplicitParameters cycles;

    bool
    dynamic() const
    {
      return scheme != Scheme::statics;
    }

    /** @brief Whether steps are output intervals, in which many cycles run without any system of
     * equations (doc/explicit.md). */
    bool
    runs_in_cycles() const
    {
      return scheme == Scheme::central_differences;
    }

    /**
     * @brief Whether impacts are without rebound: "automatic" chooses that for schemes that do not
     * conserve energy.
     */
    bool
    plastic_impacts() const;

    /**
     * @brief Whether steps are shortened to end where bodies meet: "automatic" chooses that where
     * impacts are elastic.
     */
    bool
    adapts_to_impacts() const
    {
      return adapt == Adapt::impacts || (adapt == Adapt::automatic && !plastic_impacts());
    }

    /** @brief The numbers of the generalized-alpha family that the scheme stands for.
     *
     *   M a_{n+1-m} + C v_{n+1-f} + F(u)_{n+1-f} = F_ext_{n+1-f} + f_contact,
     * where x_{n+1-f} = (1-f) x_{n+1} + f x_n, with Newmark's formulae for u and v. */
    struct Coefficients
    {
      /** m and f; no unit. */
      double alpha_m = 0., alpha_f = 0.;
      double gamma = 0.5, beta = 0.25;
    };
    Coefficients
    coefficients() const;

    void
    declare(dealii::ParameterHandler &prm);
    /** @throws InputError */
    void
    check(const std::string &section) const;
  };
} // namespace Touchstone

#endif

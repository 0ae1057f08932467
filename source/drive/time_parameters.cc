// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/drive/time_parameters.h>

#include <deal.II/base/utilities.h>

#include <cmath>

/**
 * @file
 * Section "Time integration" of the scene: declaration, checks, and the translation of the named
 * schemes into the four coefficients of the generalized-alpha family (table in
 * doc/time_integration.md).
 */

namespace Touchstone
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  void
  TimeIntegrationParameters::declare(ParameterHandler &prm)
  {
    scheme.declare(prm,
                   "Scheme",
                   "'static': no inertia, t only orders the loads. 'newmark'; 'hht' (Hilber, "
                   "Hughes and Taylor 1977); 'generalized_alpha' (Chung and Hulbert 1993); "
                   "'contact_stabilized': the same, with the mass of slave nodes moved to "
                   "their neighbours, for impacts without chatter: with spectral radius 1 it "
                   "conserves the energy of linear bodies and contact only takes from it. "
                   "'central_differences': explicit, for impacts and other fast events; the steps "
                   "of 'Load stepping' are output intervals, in which cycles of the stable length "
                   "run.");
    mass.declare(prm,
                 "Mass",
                 "'consistent'; 'lumped' to the nodes; 'dispersion corrected': integrated such "
                 "that errors of mesh and step cancel in the speed of waves, all of them where "
                 "a wave passes a cell in a step (degree 1). 'central_differences' always has the "
                 "lumped mass.");
    prm.add_parameter("Newmark gamma",
                      newmark_gamma,
                      "Of 'newmark': 0.5 for no numerical damping, up to 1. [no unit]",
                      Patterns::Double(0.5, 1.));
    prm.add_parameter("Newmark beta",
                      newmark_beta,
                      "Of 'newmark': a number from gamma/2 to 1, or 'automatic': "
                      "(gamma + 1/2)^2 / 4. [no unit]",
                      Patterns::Anything());
    prm.add_parameter("HHT alpha",
                      hht_alpha,
                      "Numerical damping of 'hht'. [no unit]",
                      Patterns::Double(0., 1. / 3.));
    prm.add_parameter(
      "Spectral radius",
      spectral_radius,
      "Part of an infinitely fast oscillation that a step of 'generalized_alpha' or "
      "'contact_stabilized' leaves: 0 to 1, or 'automatic': 0.8 and 1. [no unit]",
      Patterns::Anything());
    impact.declare(prm,
                   "Impact",
                   "What becomes of nodes that meet. 'elastic': contact forces alone decide; "
                   "no energy is lost in steps that end where bodies meet, and single nodes "
                   "rebound. 'plastic': nodes that press lose their relative velocity, so that "
                   "contact does not chatter, at the price of the kinetic energy of these "
                   "nodes. 'automatic': 'elastic' for 'contact_stabilized' and 'Spectral "
                   "radius' 1, which conserve energy, and for the dispersion-corrected mass; "
                   "'plastic' for others.");
    adapt.declare(prm,
                  "Adapt steps",
                  "'impacts': a step in which contact takes or gives much energy is repeated "
                  "with a size that ends where the bodies meet; 'none'; 'automatic': "
                  "'impacts' where impacts are elastic.");
    prm.add_parameter("Impact tolerance",
                      impact_tolerance,
                      "Energy that contact may take or give in a step, relative to the "
                      "energy of the bodies, before the step is shortened. [no unit]",
                      Patterns::Double(0., 1.));
    prm.add_parameter("Smallest step",
                      smallest_step,
                      "The shortest step that impacts lead to, relative to the steps that are "
                      "asked for. [no unit]",
                      Patterns::Double(1e-12, 1.));
    prm.add_parameter("Gain tolerance",
                      gain_tolerance,
                      "Energy that nothing explains, relative to the largest energy so far: a "
                      "step that gains more is cut, and a run that goes on gaining ends. [no unit]",
                      Patterns::Double(0.));
    cycles.declare(prm);
  }



  namespace
  /**
   * Throw unless @p entry is "automatic" or a number in [lowest, highest]. deal.II's patterns
   * cannot combine a word and a range.
   */
  {
    /** The number in @p entry, which check_number() has accepted, or @p automatic if it says so. */
    double
    number_or(const std::string &entry, const double automatic)
    {
      return entry == "automatic" ? automatic : dealii::Utilities::string_to_double(entry);
    }

    void
    check_number(const std::string &section,
                 const std::string &key,
                 const std::string &entry,
                 const double       lowest,
                 const double       highest,
                 const std::string &remedy)
    {
      const Patterns::Double pattern(lowest, highest);
      if (entry != "automatic" && !pattern.match(entry))
        throw InputError(section,
                         key,
                         entry,
                         "is neither 'automatic' nor a number from " +
                           Patterns::Tools::to_string(lowest) + " to " +
                           Patterns::Tools::to_string(highest),
                         remedy);
    }
  } // namespace



  TimeIntegrationParameters::Coefficients
  TimeIntegrationParameters::coefficients() const
  {
    Coefficients c;
    // Newmark: m = f = 0. The automatic beta is the smallest with which all modes keep oscillating,
    // and the one that damps high frequencies most for this gamma.
    if (scheme == Scheme::newmark)
      {
        c.gamma = newmark_gamma;
        c.beta  = number_or(newmark_beta, std::pow(c.gamma + 0.5, 2) / 4.);
        return c;
      }
    // HHT evaluates the forces, but not the inertia, within the step: m = 0, f = alpha.
    if (scheme == Scheme::hht)
      c.alpha_f = hht_alpha;
    else
      {
        // Chung and Hulbert's optimal parameters for the spectral radius rho at infinite frequency;
        // rho = 1 is the midpoint rule, m = f = 1/2.
        const double rho =
          number_or(spectral_radius, scheme == Scheme::contact_stabilized ? 1. : 0.8);
        c.alpha_m = (2. * rho - 1.) / (rho + 1.);
        c.alpha_f = rho / (rho + 1.);
      }
    // gamma makes the scheme second-order accurate, beta maximises the damping of high frequencies.
    c.gamma = 0.5 - c.alpha_m + c.alpha_f;
    c.beta  = std::pow(1. - c.alpha_m + c.alpha_f, 2) / 4.;
    return c;
  }



  bool
  TimeIntegrationParameters::plastic_impacts() const
  {
    if (!dynamic() || runs_in_cycles() || impact == Impact::elastic)
      return false;
    const Coefficients c = coefficients();
    // With spectral radius 1 (the midpoint rule, m = f = 1/2) energy is conserved, and an impact
    // that takes energy would spoil that. The dispersion-corrected mass leaves some motions without
    // inertia, which an impact cannot stop.
    return impact == Impact::plastic ||
           !(mass == MassKind::dispersion_corrected || (c.alpha_m == 0.5 && c.alpha_f == 0.5));
  }



  void
  TimeIntegrationParameters::check(const std::string &section) const
  {
    // Unconditionally stable: beta >= gamma / 2 >= 1/4.
    check_number(section,
                 "Newmark beta",
                 newmark_beta,
                 newmark_gamma / 2.,
                 1.,
                 "take 'automatic': below gamma/2 large steps are not stable");
    if (impact == Impact::plastic && scheme == Scheme::contact_stabilized)
      throw InputError(section,
                       "Impact",
                       impact.word(),
                       "nodes without mass have no velocity to lose",
                       "take 'elastic', or another 'Scheme'");
    if (impact == Impact::plastic && mass == MassKind::dispersion_corrected)
      throw InputError(section,
                       "Impact",
                       impact.word(),
                       "the dispersion-corrected mass gives some motions of nodes no inertia",
                       "take 'elastic', or another 'Mass'");
    check_number(section, "Spectral radius", spectral_radius, 0., 1., "take 'automatic'");
  }
} // namespace Touchstone

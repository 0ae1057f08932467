// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/verification/interference_fit.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

/**
 * @file
 * Shrink fit of two tubes in plane strain (doc/theory.md 10, "Interference fit"). The exact
 * solution keeps the forces of both surfaces in balance; their radii differ by the overlap, and so
 * do the pressures. Textbooks set the pressures equal, whose value is printed for comparison.
 */

namespace Touchstone
{
  namespace
  {
    const ReferenceRegistry::Entry<InterferenceFit> interference_fit_entry(
      "interference fit",
      "Two tubes pressed into each other (Lame, plane strain, small overlap). Values: 'inner "
      "radius', 'inner skin radius', 'outer bore radius', 'outer radius', 'slave radius' (one of "
      "the two in the middle), 'young modulus', 'poisson ratio'; optionally 'outer young "
      "modulus', 'outer poisson ratio', and 'compare displacement' (1: yes).");

    double
    square(const double x)
    {
      return x * x;
    }
  } // namespace



  InterferenceFit::InterferenceFit(const Scene &scene)
    : InterferenceFit(ReferenceValues(scene.reference.values), reference_pair(scene))
  {
  }



  InterferenceFit::InterferenceFit(ReferenceValues values, const unsigned int pair)
    : slave_radius(values.positive_number("slave radius"))
    , skin_radius(values.positive_number("inner skin radius"))
    , bore_radius(values.positive_number("outer bore radius"))
    , with_displacement(values.number("compare displacement", 0.) != 0.)
    , pair(pair)
  {
    const double inner_radius = values.number("inner radius");
    const double outer_radius = values.positive_number("outer radius");
    const double inner_young  = values.positive_number("young modulus");
    const double inner_nu     = values.number("poisson ratio");
    const double outer_young  = values.number("outer young modulus", inner_young);
    const double outer_nu     = values.number("outer poisson ratio", inner_nu);
    values.finish();

    if (!(0. <= inner_radius && inner_radius < std::min(skin_radius, bore_radius)))
      values.fail("\"inner radius\" must lie between zero and the radii of the joint.",
                  "Correct the radii.");
    if (!(outer_radius > std::max(skin_radius, bore_radius)))
      values.fail("\"outer radius\" must be greater than the radii of the joint.",
                  "Correct the radii.");
    if (!(skin_radius > bore_radius))
      values.fail("The tubes do not overlap.",
                  "\"inner skin radius\" must be greater than \"outer bore radius\".");
    // Pressures refer to the reference area of the slave surface, so its radius decides which of
    // the two exact pressures is compared.
    if (slave_radius != skin_radius && slave_radius != bore_radius)
      values.fail("\"slave radius\" is the radius of neither surface of the joint.",
                  "Give \"inner skin radius\" or \"outer bore radius\" once more.");
    for (const double nu : {inner_nu, outer_nu})
      if (!(-1. < nu && nu <= 0.5))
        values.fail("Poisson's ratio must lie between -1 and 0.5.", "Correct the number.");
    if (!(outer_young > 0.))
      values.fail("\"outer young modulus\" must be positive.", "Correct the number.");

    // With the plane-strain factors 1/E' = (1-nu^2)/E and nu'/E' = nu(1+nu)/E,
    // which stay finite for nu = 0.5.
    inner_compliance = (1. - square(inner_nu)) / inner_young *
                         (square(skin_radius) + square(inner_radius)) /
                         (square(skin_radius) - square(inner_radius)) -
                       inner_nu * (1. + inner_nu) / inner_young;
    outer_compliance = (1. - square(outer_nu)) / outer_young *
                         (square(outer_radius) + square(bore_radius)) /
                         (square(outer_radius) - square(bore_radius)) +
                       outer_nu * (1. + outer_nu) / outer_young;
    if (!std::isfinite(inner_compliance + outer_compliance))
      values.fail("The exact solution of these values is not finite.", "Correct the numbers.");
  }



  double
  InterferenceFit::pressure(const double radius) const
  {
    // Force per angle and length q = p r is the same on both surfaces; delta = q (C_i + C_o).
    const double force_per_angle =
      (skin_radius - bore_radius) / (inner_compliance + outer_compliance);
    return force_per_angle / radius;
  }



  double
  InterferenceFit::textbook_pressure() const
  {
    return (skin_radius - bore_radius) /
           (skin_radius * inner_compliance + bore_radius * outer_compliance);
  }



  ReferenceComparison
  InterferenceFit::compare(const ReferenceInput &input) const
  {
    const double exact = pressure(slave_radius);
    // u = C r p of that tube, since compliances are per radius.
    const double exact_displacement =
      exact * slave_radius * (slave_radius == skin_radius ? inner_compliance : outer_compliance);

    double force = 0., area = 0., deviation = 0., displacement_deviation = 0.;
    for (const ContactPoint &point : points_of_pair(input.points, pair))
      {
        if (point.status >= ContactStatus::slip)
          {
            force += point.pressure * point.area;
            area += point.area;
          }
        // The largest deviation of a single node, which a mean would hide: faceted surfaces
        // oscillate.
        deviation = std::max(deviation, std::abs(point.pressure - exact));
        // The displacement of the slave surface along the master normal is positive away from the
        // other body, for the inner and the outer tube alike.
        displacement_deviation =
          std::max(displacement_deviation,
                   std::abs(point.displacement * point.normal - exact_displacement));
      }
    force     = dealii::Utilities::MPI::sum(force, input.communicator);
    area      = dealii::Utilities::MPI::sum(area, input.communicator);
    deviation = dealii::Utilities::MPI::max(deviation, input.communicator);
    displacement_deviation =
      dealii::Utilities::MPI::max(displacement_deviation, input.communicator);

    ReferenceComparison result;
    result.add("contact_pressure_mean",
               "contact pressure, mean",
               area > 0. ? force / area : 0.,
               exact);
    result.add("contact_pressure_max_deviation",
               "contact pressure, largest deviation of a node",
               deviation / exact);
    if (with_displacement)
      result.add("displacement_max",
                 "radial displacement, largest deviation of a node",
                 displacement_deviation / exact_displacement);

    char text[160];
    std::snprintf(text,
                  sizeof(text),
                  "(with equal pressure on both surfaces, as in textbooks: %.6g)",
                  textbook_pressure());
    result.lines.push_back(text);
    return result;
  }
} // namespace Touchstone

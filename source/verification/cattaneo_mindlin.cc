// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/verification/cattaneo_mindlin.h>
#include <touchstone/verification/contact_field.h>
#include <touchstone/verification/edge_fit.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

/**
 * @file
 * Partial slip of two cylinders (Cattaneo 1938, Mindlin 1949; Johnson, Contact Mechanics, chapter
 * 7, doc/theory.md reference 14). All forces are per length along the axes. The exact solution is
 * evaluated at the forces that were computed, so that errors of the profile are not mixed with
 * those of the load.
 */

namespace Touchstone
{
  namespace
  {
    const ReferenceRegistry::Entry<CattaneoMindlin> cattaneo_mindlin_entry(
      "cattaneo mindlin",
      "Two cylinders of the same material with axes along y, pressed along z and pushed along x, "
      "compared at the forces that were computed. Values: 'radius' (1/R = 1/R1 + 1/R2), 'young "
      "modulus', 'poisson ratio', 'friction coefficient', 'depth' (extent of the model along y); "
      "optionally 'tangential force' (what pushes the slave body of the model along x in the end), "
      "'peak tangential force' (its largest value before, if it has fallen since), 'centre x' "
      "(0).");

    /**
     * The half ellipse sqrt(1 - x^2/a^2), zero outside |x| < a: pressure and shear traction are
     * sums of such.
     */
    double
    half_ellipse(const double x, const double a)
    {
      return std::abs(x) < a ? std::sqrt(1. - (x / a) * (x / a)) : 0.;
    }



    /**
     * Relative L2 error from the squares of error and size; NaN if there is nothing to compare,
     * e.g. no tangential force.
     */
    double
    relative(const double error_squared, const double size_squared)
    {
      return size_squared > 0. ? std::sqrt(error_squared / size_squared) : std::nan("");
    }



    /** A line of the log. */
    std::string
    forces_per_length(const double normal, const double tangential, const double friction)
    {
      char text[128];
      std::snprintf(text,
                    sizeof(text),
                    "forces per length: P %.6g, Q %.6g, Q/(mu P) %.6g",
                    normal,
                    tangential,
                    tangential / (friction * normal));
      return text;
    }
  } // namespace



  CattaneoMindlin::CattaneoMindlin(const Scene &scene)
    : CattaneoMindlin(ReferenceValues(scene.reference.values), reference_pair(scene))
  {
  }



  CattaneoMindlin::CattaneoMindlin(ReferenceValues values, const unsigned int pair)
    : radius(values.positive_number("radius"))
    , effective_modulus(values.positive_number("young modulus") /
                        (2. * (1. - std::pow(values.number("poisson ratio"), 2))))
    , friction(values.positive_number("friction coefficient"))
    , depth(values.positive_number("depth"))
    , centre(values.number("centre x", 0.))
    , prescribed(values.number("tangential force", std::nan("")))
    , prescribed_peak(values.number("peak tangential force", std::nan("")))
    , pair(pair)
  {
    values.finish();
    if (std::abs(prescribed_peak) < std::abs(prescribed))
      values.fail("\"peak tangential force\" is less than \"tangential force\".",
                  "It is the largest value that the force has had.");
  }



  double
  CattaneoMindlin::half_width(const double normal) const
  {
    // Hertz's line contact, a^2 = 4 P R / (pi E*).
    return std::sqrt(4. * normal * radius / (dealii::numbers::PI * effective_modulus));
  }



  double
  CattaneoMindlin::peak_pressure(const double normal) const
  {
    // p_0 = 2 P / (pi a).
    return normal > 0. ? 2. * normal / (dealii::numbers::PI * half_width(normal)) : 0.;
  }



  double
  CattaneoMindlin::stick_half_width(const double normal,
                                    const double tangential,
                                    const double peak) const
  {
    // Of first loading, Q* - Q = 0, the formula is that of the peak itself.
    // First loading: c/a = sqrt(1 - Q/(mu P)). Unloading from the peak Q*: the zone of reverse slip
    // grows from the edge as for a load of half the drop, c'/a = sqrt(1 - (Q* - Q)/(2 mu P)).
    const double drop = std::abs(peak - tangential), limit = friction * normal;
    const double fraction = drop == 0. ? std::abs(peak) / limit : drop / (2. * limit);
    return half_width(normal) * std::sqrt(1. - fraction);
  }



  double
  CattaneoMindlin::shear_traction(const double x,
                                  const double normal,
                                  const double tangential,
                                  const double peak) const
  {
    // Shear traction of first loading: full slip, q = mu p, over the width a, less the same ellipse
    // over the stick zone c. Unloading adds, with opposite sign and twice the coefficient, that of
    // the reverse slip.
    const double a    = half_width(normal);
    const auto   from = [&](const double c) {
      return friction * peak_pressure(normal) *
             (half_ellipse(x, a) - (c > 0. ? c / a * half_ellipse(x, c) : 0.));
    };
    double q = from(stick_half_width(normal, peak, peak));
    if (tangential != peak)
      q -= 2. * from(stick_half_width(normal, tangential, peak));
    return std::copysign(1., peak) * q;
  }



  void
  CattaneoMindlin::compare_fields(const ReferenceInput &input,
                                  const double          normal,
                                  const double          tangential,
                                  const double          peak,
                                  ReferenceComparison  &result) const
  {
    if (!ContactField::available(input))
      return;
    const ContactField field(input, pair);
    const double       a = half_width(normal), p0 = peak_pressure(normal);
    result.add("pressure_field_l2",
               "pressure field",
               field.relative_error([](const auto &, const auto &t) { return std::abs(t[2]); },
                                    [&](const dealii::Point<dim> &x) {
                                      return p0 * half_ellipse(x[0] - centre, a);
                                    }));
    result.add("shear_traction_field_l2",
               "shear traction field",
               field.relative_error([](const auto &, const auto &t) { return -t[0]; },
                                    [&](const dealii::Point<dim> &x) {
                                      return shear_traction(x[0] - centre,
                                                            normal,
                                                            tangential,
                                                            peak);
                                    }));
  }



  ReferenceComparison
  CattaneoMindlin::compare(const ReferenceInput &input) const
  {
    // Resultant from nodal tractions times areas, over all ranks.
    const std::vector<ContactPoint> points = points_of_pair(input.points, pair);
    dealii::Tensor<1, dim>          total;
    for (const ContactPoint &point : points)
      total += point.area * point.traction;
    total = dealii::Utilities::MPI::sum(total, input.communicator);

    // What pushes the slave body is balanced by the traction of the master.
    const double normal     = std::abs(total[2]) / depth;
    const double tangential = -total[0] / depth;
    const double peak       = std::isnan(prescribed_peak) ? tangential : prescribed_peak / depth;
    const double a = half_width(normal), p0 = peak_pressure(normal);
    const double c      = stick_half_width(normal, tangential, peak);
    const double c_peak = stick_half_width(normal, peak, peak);
    // Everything below is for a positive peak.
    const double sign = std::copysign(1., peak);

    EdgeFit contact_edge, stick_edge;
    double  p_error = 0., p_size = 0., q_error = 0., q_size = 0., active = 0., stick = 0.;
    for (const ContactPoint &point : points)
      {
        const double x       = point.reference_position[0] - centre;
        const double p       = point.pressure;
        const double q       = -sign * point.traction[0];
        const double p_exact = p0 * half_ellipse(x, a);
        const double q_exact = sign * shear_traction(x, normal, tangential, peak);
        // Squares are weighted with tributary areas, an approximation of the L2 norm over the
        // contact surface.
        p_error += point.area * (p - p_exact) * (p - p_exact);
        p_size += point.area * p_exact * p_exact;
        q_error += point.area * (q - q_exact) * (q - q_exact);
        q_size += point.area * q_exact * q_exact;
        if (point.status < ContactStatus::slip)
          continue;
        // Areas of contact and stick: the fallback for edges that cannot be fitted, as area over
        // twice the depth.
        active += point.area;
        // Nodes beside the edge are left out of the fit: there an element covers both contact and
        // gap, and its pressure is not that of the half ellipse.
        if (std::abs(x) < 0.98 * a)
          contact_edge.add(point.area, x, p);
        if (point.status != ContactStatus::stick)
          continue;
        stick += point.area;
        // What the traction lacks to the limit of friction is half an ellipse over the stick zone:
        // the same fit of squares as for the pressure (EdgeFit) gives the edge of stick.
        stick_edge.add(point.area,
                       x,
                       tangential == peak
                         ? friction * p - q
                         : friction * p + q + friction * p0 * c_peak / a * half_ellipse(x, c_peak));
      }
    for (double *sum : {&p_error, &p_size, &q_error, &q_size, &active, &stick})
      *sum = dealii::Utilities::MPI::sum(*sum, input.communicator);

    ReferenceComparison result;
    result.lines.push_back(forces_per_length(normal, tangential, friction));
    result.add("contact_half_width",
               "contact half-width",
               contact_edge.edge(input.communicator, active / (2. * depth)),
               a);
    result.add("stick_half_width",
               "stick half-width",
               stick_edge.edge(input.communicator, stick / (2. * depth)),
               c);
    result.add("pressure_l2", "pressure profile", relative(p_error, p_size));
    result.add("shear_traction_l2", "shear traction profile", relative(q_error, q_size));
    compare_fields(input, normal, tangential, peak, result);
    if (!std::isnan(prescribed))
      {
        // A force that has come back to zero is compared with its peak.
        const double size = std::max({std::abs(prescribed), std::abs(peak * depth)});
        result.add("tangential_force",
                   "tangential force",
                   size > 0. ? std::abs(tangential * depth - prescribed) / size : std::nan(""));
      }
    return result;
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/verification/contact_field.h>
#include <touchstone/verification/edge_fit.h>
#include <touchstone/verification/hertz.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

/**
 * @file
 * Hertz contact of spheres (doc/theory.md 10, reference 14): a = (3 P R / 4 E*)^(1/3), p_0 = 3 P /
 * (2 pi a^2), at the computed force P. A quarter model has a quarter of the force: "symmetry
 * factor".
 */

namespace Touchstone
{
  namespace
  {
    const ReferenceRegistry::Entry<Hertz> hertz_entry(
      "hertz",
      "Contact of spheres, compared at the force that was computed. Values: 'radius' (1/R = 1/R1 "
      "+ 1/R2), 'young modulus', 'poisson ratio'; optionally 'second young modulus', 'second "
      "poisson ratio' (else the other body is rigid), 'centre x', 'centre y', 'centre z' (0), and "
      "'symmetry factor' (1; 4 for a quarter model).");
  } // namespace



  Hertz::Hertz(const Scene &scene)
    : Hertz(ReferenceValues(scene.reference.values), reference_pair(scene))
  {
  }



  Hertz::Hertz(ReferenceValues values, const unsigned int pair)
    : radius(values.positive_number("radius"))
    , symmetry_factor(values.number("symmetry factor", 1.))
    , pair(pair)
  {
    // 1/E* = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2; a rigid body has no second term.
    double compliance =
      (1. - std::pow(values.number("poisson ratio"), 2)) / values.positive_number("young modulus");
    const double second_nu = values.number("second poisson ratio", 0.);
    if (values.number("second young modulus", 0.) != 0.)
      compliance += (1. - second_nu * second_nu) / values.positive_number("second young modulus");
    else if (values.has("second poisson ratio"))
      values.fail("\"second poisson ratio\" stands alone.",
                  "Give \"second young modulus\" too, or neither for a rigid body.");
    effective_modulus = 1. / compliance;

    // Position of the first point of contact.
    const char *const names[dim] = {"centre x", "centre y", "centre z"};
    for (unsigned int d = 0; d < dim; ++d)
      centre[d] = values.number(names[d], 0.);
    values.finish();
    if (!(symmetry_factor >= 1.))
      values.fail("\"symmetry factor\" must be at least 1.",
                  "It says how many times the model makes the whole: 4 for a quarter.");
  }



  double
  Hertz::contact_radius(const double force) const
  {
    // a = (3 P R / 4 E*)^(1/3).
    return std::cbrt(3. * force * radius / (4. * effective_modulus));
  }



  double
  Hertz::peak_pressure(const double force) const
  {
    const double a = contact_radius(force);
    return a > 0. ? 3. * force / (2. * dealii::numbers::PI * a * a) : 0.;
  }



  double
  Hertz::distance(const dealii::Point<dim> &x, const unsigned int axis) const
  {
    dealii::Tensor<1, dim> r = dealii::Tensor<1, dim>(x) - centre;
    // Distance from the axis of the load.
    r[axis] = 0.;
    return r.norm();
  }



  ReferenceComparison
  Hertz::compare(const ReferenceInput &input) const
  {
    const std::vector<ContactPoint> points = points_of_pair(input.points, pair);

    // The force, and the axis along which it acts.
    dealii::Tensor<1, dim> total;
    double                 highest = 0.;
    for (const ContactPoint &point : points)
      {
        total += point.area * point.traction;
        highest = std::max(highest, point.pressure);
      }
    // The axis of contact is that of the largest component of the force: the scene need not name
    // it.
    total             = dealii::Utilities::MPI::sum(total, input.communicator);
    highest           = dealii::Utilities::MPI::max(highest, input.communicator);
    unsigned int axis = 0;
    for (unsigned int d = 1; d < dim; ++d)
      if (std::abs(total[d]) > std::abs(total[axis]))
        axis = d;

    const double force = symmetry_factor * std::abs(total[axis]);
    const double a     = contact_radius(force);
    const double peak  = peak_pressure(force);

    EdgeFit fit;
    double  error2 = 0., exact2 = 0., active_area = 0.;
    for (const ContactPoint &point : points)
      {
        const double r     = distance(point.reference_position, axis);
        const double p     = point.pressure;
        const double exact = r < a ? peak * std::sqrt(1. - (r / a) * (r / a)) : 0.;
        // All nodes count, those outside the exact contact with zero pressure: contact that spreads
        // too far is an error as well.
        error2 += point.area * (p - exact) * (p - exact);
        exact2 += point.area * exact * exact;
        if (point.status < ContactStatus::slip)
          continue;
        active_area += point.area;
        // Nodes beside the edge are left out of the fit: their pressures are averages over contact
        // and gap.
        if (r < 0.98 * a)
          fit.add(point.area, r, p);
      }
    error2      = dealii::Utilities::MPI::sum(error2, input.communicator);
    exact2      = dealii::Utilities::MPI::sum(exact2, input.communicator);
    active_area = dealii::Utilities::MPI::sum(active_area, input.communicator);
    const double fitted_radius =
      fit.edge(input.communicator, std::sqrt(symmetry_factor * active_area / dealii::numbers::PI));

    ReferenceComparison result;
    char                text[96];
    std::snprintf(text, sizeof(text), "force of the whole model: %.6g", force);
    result.lines.push_back(text);
    result.add("peak_pressure", "peak pressure", highest, peak);
    result.add("contact_radius", "contact radius", fitted_radius, a);
    result.add("pressure_l2",
               "pressure profile",
               exact2 > 0. ? std::sqrt(error2 / exact2) : std::nan(""));
    if (ContactField::available(input))
      result.add("pressure_field_l2",
                 "pressure field",
                 ContactField(input, pair)
                   .relative_error([axis](const auto &,
                                          const auto &t) { return std::abs(t[axis]); },
                                   [&](const dealii::Point<dim> &x) {
                                     const double r = distance(x, axis);
                                     return r < a ? peak * std::sqrt(1. - (r / a) * (r / a)) : 0.;
                                   }));
    return result;
  }
} // namespace Touchstone

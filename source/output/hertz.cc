#include <touchstone/output/hertz.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace Touchstone
{
  namespace
  {
    const ReferenceRegistry::Entry<Hertz> entry(
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
    double compliance =
      (1. - std::pow(values.number("poisson ratio"), 2)) / values.positive_number("young modulus");
    const double second_nu = values.number("second poisson ratio", 0.);
    if (values.number("second young modulus", 0.) != 0.)
      compliance += (1. - second_nu * second_nu) / values.positive_number("second young modulus");
    else if (values.has("second poisson ratio"))
      values.fail("\"second poisson ratio\" stands alone.",
                  "Give \"second young modulus\" too, or neither for a rigid body.");
    effective_modulus = 1. / compliance;

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
    return std::cbrt(3. * force * radius / (4. * effective_modulus));
  }



  double
  Hertz::peak_pressure(const double force) const
  {
    const double a = contact_radius(force);
    return a > 0. ? 3. * force / (2. * dealii::numbers::PI * a * a) : 0.;
  }



  double
  Hertz::distance(const ContactPoint &point, const unsigned int axis) const
  {
    dealii::Tensor<1, dim> r = dealii::Tensor<1, dim>(point.reference_position) - centre;
    r[axis]                  = 0.;
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
    total             = dealii::Utilities::MPI::sum(total, input.communicator);
    highest           = dealii::Utilities::MPI::max(highest, input.communicator);
    unsigned int axis = 0;
    for (unsigned int d = 1; d < dim; ++d)
      if (std::abs(total[d]) > std::abs(total[axis]))
        axis = d;

    const double force = symmetry_factor * std::abs(total[axis]);
    const double a     = contact_radius(force);
    const double peak  = peak_pressure(force);

    // The nodes resolve the edge of the contact no better than their distance,
    // but p^2 falls linearly with r^2 and so tells where it vanishes: moments of
    // the least-squares line, the profile error, and the area as a fallback.
    enum Sum
    {
      weight,
      r2,
      r4,
      p2,
      r2p2,
      error2,
      exact2,
      active_area,
      n_sums
    };
    std::vector<double> sums(n_sums, 0.);
    for (const ContactPoint &point : points)
      {
        const double r     = distance(point, axis);
        const double p     = point.pressure;
        const double exact = r < a ? peak * std::sqrt(1. - (r / a) * (r / a)) : 0.;
        sums[error2] += point.area * (p - exact) * (p - exact);
        sums[exact2] += point.area * exact * exact;
        if (point.status < ContactStatus::slip)
          continue;
        sums[active_area] += point.area;
        if (r < 0.98 * a)
          {
            sums[weight] += point.area;
            sums[r2] += point.area * r * r;
            sums[r4] += point.area * r * r * r * r;
            sums[p2] += point.area * p * p;
            sums[r2p2] += point.area * r * r * p * p;
          }
      }
    dealii::Utilities::MPI::sum(sums, input.communicator, sums);

    double fitted_radius     = std::sqrt(symmetry_factor * sums[active_area] / dealii::numbers::PI);
    const double determinant = sums[weight] * sums[r4] - sums[r2] * sums[r2];
    const double slope       = sums[weight] * sums[r2p2] - sums[r2] * sums[p2];
    const double constant    = sums[r4] * sums[p2] - sums[r2] * sums[r2p2];
    // With a single ring of nodes there is no line to be fitted.
    if (determinant > 1e-12 * sums[weight] * sums[r4] && slope < 0. && constant > 0.)
      fitted_radius = std::sqrt(-constant / slope);

    ReferenceComparison result;
    char                text[96];
    std::snprintf(text, sizeof(text), "force of the whole model: %.6g", force);
    result.lines.push_back(text);
    result.add("peak_pressure", "peak pressure", highest, peak);
    result.add("contact_radius", "contact radius", fitted_radius, a);
    result.add("pressure_l2",
               "pressure profile",
               sums[exact2] > 0. ? std::sqrt(sums[error2] / sums[exact2]) : std::nan(""));
    return result;
  }
} // namespace Touchstone

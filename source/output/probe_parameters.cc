// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/output/probe_parameters.h>

#include <string>

namespace Touchstone
{
  namespace Patterns = dealii::Patterns;

  std::string
  ProbeParameters::section() const
  {
    return "Probe " + name;
  }



  void
  ProbeParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
      "Body", body, "The body. Required.", Patterns::Anything(), /*has_to_be_set=*/true);
    place.declare(prm,
                  "Place",
                  "Displacement and stress at a 'point', at points along a 'line', or their means "
                  "over a 'boundary', in each step, go to the file probe_NAME.csv.");
    prm.add_parameter("Point",
                      point,
                      "The point, or the first of the line, before deformation: x, y, z. [length]");
    prm.add_parameter("End point", end, "The last point of the line: x, y, z. [length]");
    prm.add_parameter("Points",
                      n_points,
                      "Points of the line, its ends included, at equal distances.",
                      Patterns::Integer(2, 100000));
    prm.add_parameter("Boundary",
                      boundary,
                      "The boundary, by name or number.",
                      Patterns::Anything());
  }



  void
  ProbeParameters::check() const
  {
    if ((place == Place::boundary) != !boundary.empty())
      throw InputError(section(),
                       "Boundary",
                       boundary,
                       boundary.empty() ? "the boundary is missing"
                                        : "means nothing unless 'Place' is 'boundary'",
                       boundary.empty() ? "name a boundary of the body"
                                        : "set that, or remove this key");
    if (place == Place::boundary && point.norm() > 0.)
      throw InputError(section(),
                       "Point",
                       Patterns::Tools::to_string(point),
                       "means nothing while 'Place' is 'boundary'",
                       "set that to 'point', or remove this key");
    if (place == Place::line && (end - point).norm() == 0.)
      throw InputError(section(),
                       "End point",
                       Patterns::Tools::to_string(end),
                       "the line has no length",
                       "give another point than 'Point'");
    if (place != Place::line && n_points != ProbeParameters().n_points)
      throw InputError(section(),
                       "Points",
                       std::to_string(n_points),
                       "means nothing unless 'Place' is 'line'",
                       "set that, or remove this key");
    if (place != Place::line && end.norm() > 0.)
      throw InputError(section(),
                       "End point",
                       Patterns::Tools::to_string(end),
                       "means nothing unless 'Place' is 'line'",
                       "set that, or remove this key");
  }
} // namespace Touchstone

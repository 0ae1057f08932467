// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/mesh/axes.h>
#include <touchstone/mesh/body_mesh.h>

#include <deal.II/grid/manifold_lib.h>

#include <cmath>

// Tubes, sectors of tubes and cones as a structured block in cylindrical coordinates.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Angle that a cell may span, degrees. */
    constexpr double widest_cell = 120.;

    /** @brief A tube or a sector of it, cylindrical or conical. */
    class Tube : public Geometry
    {
    public:
      void
      declare(ParameterHandler &prm) override;
      void
      check(const std::string &section) const override;
      BodyMesh
      create(double factor, const std::string &, const std::string &) const override;

    private:
      std::string axis = "z";
      Point<3>    origin;
      double      start = 0., end = 1.;
      double      inner_radius = 1., inner_slope = 0.;
      double      outer_radius = 2., outer_slope = 0.;
      double      first_angle = 0., angle = 90.;

      std::vector<unsigned int> cells          = {2, 8, 1};
      double                    radial_grading = 1.;

      double
      inner(const double s) const
      {
        // Radius at the distance s from the origin of the axis, so that tubes that share an axis
        // can share the same formula of their common cone, wherever each of them starts.
        return inner_radius + inner_slope * s;
      }

      double
      outer(const double s) const
      {
        return outer_radius + outer_slope * s;
      }
    };



    void
    Tube::declare(ParameterHandler &prm)
    {
      prm.add_parameter("Axis",
                        axis,
                        "Direction of the axis: x, y or z.",
                        Patterns::Selection("x|y|z"));
      prm.add_parameter("Origin",
                        origin,
                        "Point of the axis from which positions along it are measured; "
                        "x, y, z; length.");
      prm.add_parameter("Start", start, "Where the tube starts along the axis; length.");
      prm.add_parameter("End", end, "Where the tube ends along the axis; length.");
      prm.add_parameter("Inner radius",
                        inner_radius,
                        "Radius of the bore at the origin of the axis; length.");
      prm.add_parameter("Inner slope",
                        inner_slope,
                        "Growth of the inner radius along the axis, r = radius + slope s "
                        "with s from the origin, not from the start; no unit.");
      prm.add_parameter("Outer radius",
                        outer_radius,
                        "Radius of the outer surface at the origin of the axis; length.");
      prm.add_parameter("Outer slope",
                        outer_slope,
                        "Growth of the outer radius along the axis; no unit.");
      prm.add_parameter("First angle",
                        first_angle,
                        "Where the sector begins; degrees from y to z for axis x, from z to "
                        "x for axis y, from x to y for axis z.");
      prm.add_parameter("Angle",
                        angle,
                        "Angle of the sector; degrees; 360 gives the closed tube.",
                        Patterns::Double(0., 360.));
      prm.add_parameter("Cells",
                        cells,
                        "Number of cells in radial, angular and axial direction.",
                        Patterns::List(Patterns::Integer(1), 3, 3));
      prm.add_parameter("Radial grading",
                        radial_grading,
                        "Thickness of the outermost cell over that of the innermost; no "
                        "unit; 1 is uniform.",
                        Patterns::Double(1e-6, 1e6));
    }



    void
    Tube::check(const std::string &section) const
    {
      if (!(end > start))
        throw InputError(section,
                         "End",
                         Patterns::Tools::to_string(end),
                         "the tube ends before it starts",
                         "make it larger than 'Start' (" + Patterns::Tools::to_string(start) + ")");
      // Radii are linear along the axis, so the two ends tell for the whole tube.
      // The radii are linear along the axis, so if they are admissible at both ends they are so
      // between.
      for (const double s : {start, end})
        {
          const std::string where = " at the position " + Patterns::Tools::to_string(s);
          if (!(inner(s) > 0.))
            throw InputError(section,
                             "Inner radius",
                             Patterns::Tools::to_string(inner_radius),
                             "the bore has no positive radius" + where + " of the axis",
                             "make the radius larger or change 'Inner slope'; for a body "
                             "without bore use the geometry 'cylinder'");
          if (!(outer(s) > inner(s)))
            throw InputError(section,
                             "Outer radius",
                             Patterns::Tools::to_string(outer_radius),
                             "it is not larger than the inner radius" + where + " of the axis",
                             "change the radii or slopes: r = radius + slope s");
        }
      if (!(angle > 0.))
        throw InputError(section,
                         "Angle",
                         Patterns::Tools::to_string(angle),
                         "a sector needs a positive angle",
                         "give 0 < angle <= 360 degrees");
      if (angle / cells[1] > widest_cell)
        throw InputError(section,
                         "Cells",
                         Patterns::Tools::to_string(cells),
                         "a cell spans more than 120 degrees",
                         "give more cells in angular direction (the second number)");
    }



    BodyMesh
    Tube::create(const double factor, const std::string &, const std::string &) const
    {
      std::array<unsigned int, 3> n;
      for (unsigned int d = 0; d < 3; ++d)
        n[d] = scaled_cells(cells[d], factor);
      // A factor below one must not leave cells wider than check() allows.
      // A factor below one must not leave cells wider than check() allows.
      n[1] = std::max<unsigned int>(n[1], std::ceil(angle / widest_cell));

      const Axes axes(axis, origin);
      const auto fraction = graded_positions(0., 1., n[0], radial_grading);
      const bool closed   = angle == 360.;

      // The directions of the block are radius, angle and axis, which are right-handed in this
      // order; ids are given for the sides of each of them.
      BodyMesh mesh =
        make_block(n,
                   closed,
                   [&](const unsigned int i, const unsigned int j, const unsigned int k) {
                     const double s = start + (end - start) * k / n[2];
                     const double r = inner(s) * (1. - fraction[i]) + outer(s) * fraction[i];
                     return axes.polar(r, first_angle + angle * j / n[1], s);
                   },
                   {{0, 1, 4, 5, 2, 3}});

      mesh.boundary_names = {{"inner", 0}, {"outer", 1}, {"start", 2}, {"end", 3}};
      if (!closed)
        {
          mesh.boundary_names["first cut"]  = 4;
          mesh.boundary_names["second cut"] = 5;
        }

      // Radius, angle and position are averaged each for itself, so refinement
      // and quadratic mappings stay on cones exactly.
      mesh.manifolds[0] = std::make_shared<CylindricalManifold<3>>(axes.direction(), origin);
      for (CellData<3> &cell : mesh.cells)
        cell.manifold_id = 0;

      mesh.surfaces[0] = make_cone(origin, axes.direction(), inner_radius, inner_slope, false);
      mesh.surfaces[1] = make_cone(origin, axes.direction(), outer_radius, outer_slope, true);
      return mesh;
    }

    const GeometryRegistry::Entry<Tube> tube_entry(
      "tube",
      "A tube or a sector of it, with straight or conical walls and the boundaries inner, "
      "outer, start, end, and for a sector first cut, second cut.");
  } // namespace
} // namespace Touchstone

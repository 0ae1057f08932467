// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/base/keyword.h>
#include <touchstone/mesh/axes.h>
#include <touchstone/mesh/body_mesh.h>
#include <touchstone/mesh/round_lattice.h>

#include <deal.II/grid/manifold_lib.h>

#include <cmath>

// A solid cylinder from a lattice with a square core, without the degenerate cells that a polar
// mesh has on its axis.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** @brief A solid cylinder, or the half or quarter of one. */
    class Cylinder : public Geometry
    {
    public:
      void
      declare(ParameterHandler &prm) override;
      void
      check(const std::string &section) const override;
      BodyMesh
      create(double factor, const std::string &, const std::string &) const override;

    private:
      enum : types::boundary_id
      {
        side,
        start_face,
        end_face,
        first_cut,
        second_cut
      };

      enum class Part
      {
        full,
        half,
        quarter
      };
      Keyword<Part> part{Part::full,
                         {{"full", Part::full}, {"half", Part::half}, {"quarter", Part::quarter}}};
      std::string   axis = "z";
      Point<3>      origin;
      double        start = 0., end = 1., radius = 1.;

      std::vector<unsigned int> cells   = {2, 2, 2};
      double                    grading = 1., radial_grading = 1.;
    };



    void
    Cylinder::declare(ParameterHandler &prm)
    {
      prm.add_parameter("Axis",
                        axis,
                        "Direction of the axis: x, y or z.",
                        Patterns::Selection("x|y|z"));
      prm.add_parameter("Origin",
                        origin,
                        "Point of the axis from which positions along it are measured; "
                        "x, y, z; length.");
      prm.add_parameter("Start", start, "Where it starts along the axis; length.");
      prm.add_parameter("End", end, "Where it ends along the axis; length.");
      prm.add_parameter("Radius", radius, "Radius; length.", Patterns::Double(0.));
      part.declare(prm,
                   "Part",
                   "The full cylinder, the half between the angles 0 and 180 degrees, "
                   "or the quarter between 0 and 90 degrees, where angles go from y to "
                   "z for axis x, from z to x for axis y, from x to y for axis z.");
      prm.add_parameter("Cells",
                        cells,
                        "Number of cells from the axis to the side of the square core, "
                        "which is about half of the radius, from there to the surface, and "
                        "along the axis. A quarter of the circumference has twice the "
                        "first number of cells.",
                        Patterns::List(Patterns::Integer(1), 3, 3));
      prm.add_parameter("Radial grading",
                        radial_grading,
                        "Thickness of the last cell at the surface over that of the first "
                        "outside of the core; the cells between grow geometrically. No unit; 1 "
                        "is uniform, less than 1 is finer at the surface.",
                        Patterns::Double(1e-6, 1e6));
      prm.add_parameter("Axial grading",
                        grading,
                        "Length of the last cell along the axis over that of the first; the "
                        "cells between grow geometrically. No unit; 1 is uniform.",
                        Patterns::Double(1e-6, 1e6));
    }



    void
    Cylinder::check(const std::string &section) const
    {
      // Written such that values that are not numbers fail, too.
      if (!(end > start))
        throw InputError(section,
                         "End",
                         Patterns::Tools::to_string(end),
                         "the cylinder ends before it starts",
                         "make it larger than 'Start' (" + Patterns::Tools::to_string(start) + ")");
      if (!(radius > 0.))
        throw InputError(section,
                         "Radius",
                         Patterns::Tools::to_string(radius),
                         "a cylinder needs a positive radius",
                         "give the radius as a length");
    }



    BodyMesh
    Cylinder::create(const double factor, const std::string &, const std::string &) const
    {
      // The section's first direction is mirrored unless it is a quarter, the second unless it is
      // a half or quarter.
      const std::vector<std::string> keep = {part == Part::quarter ? "+" : "both",
                                             part == Part::full ? "both" : "+"};
      const unsigned int        layers = scaled_cells(cells[2], factor);
      const RoundLattice        lattice(2,
                                 keep,
                                 scaled_cells(cells[0], factor),
                                 scaled_cells(cells[1], factor),
                                 layers,
                                 radial_grading);
      const Axes                axes(axis, origin);
      const std::vector<double> along = graded_positions(start, end, layers, grading);

      BodyMesh mesh;
      mesh.cells = lattice.cells;
      for (const Tensor<1, 3> &x : lattice.points)
        mesh.vertices.push_back(
          axes.point(radius * x[0], radius * x[1], along[std::lround(x[2] * layers)]));

      // Lattice coordinates are exactly 0 or 1 on flat faces, so comparisons need no tolerance;
      // what is left is the side.
      add_boundary_faces(mesh, [&](const FaceVertices &face) {
        const auto all = [&](const unsigned int d, const double value) {
          for (const unsigned int v : face)
            if (lattice.points[v][d] != value)
              return false;
          return true;
        };
        const auto flat = [](const types::boundary_id id) {
          return std::make_pair(id, numbers::flat_manifold_id);
        };
        if (all(2, 0.))
          return flat(start_face);
        if (all(2, 1.))
          return flat(end_face);
        if (keep[1] == "+" && all(1, 0.))
          return flat(first_cut);
        if (keep[0] == "+" && all(0, 0.))
          return flat(second_cut);
        return std::make_pair<types::boundary_id, types::manifold_id>(side, 0);
      });

      mesh.boundary_names = {{"side", side}, {"start", start_face}, {"end", end_face}};
      if (part != Part::full)
        mesh.boundary_names["first cut"] = first_cut;
      if (part == Part::quarter)
        mesh.boundary_names["second cut"] = second_cut;

      // Only the faces of the side are curved: cylindrical coordinates are singular on the axis,
      // which the core contains, so that cells inside must not be refined by them.
      mesh.manifolds[0]   = std::make_shared<CylindricalManifold<3>>(axes.direction(), origin);
      mesh.surfaces[side] = make_cone(origin, axes.direction(), radius, 0., true);
      return mesh;
    }

    const GeometryRegistry::Entry<Cylinder> cylinder_entry(
      "cylinder",
      "A solid cylinder, or the half or quarter of one, with the boundaries side, start, "
      "end, and where it is cut first cut (angle 0, for the half also 180 degrees) and "
      "second cut (90 degrees).");
  } // namespace
} // namespace Touchstone

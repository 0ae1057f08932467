// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/mesh/body_mesh.h>
#include <touchstone/mesh/rounded_rectangle.h>

#include <deal.II/grid/manifold_lib.h>

#include <algorithm>
#include <cmath>

// A plate of constant thickness with one rounded corner: the plane section is meshed by
// RoundedRectangle and extruded.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** @brief A rectangular plate with one corner rounded. */
    class RoundedPlate : public Geometry
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
        first_side,
        fillet,
        second_side,
        far_first_side,
        far_second_side,
        back,
        front
      };

      Point<3>                  corner;
      Tensor<1, 3>              first       = Tensor<1, 3>({1., 0., 0.});
      Tensor<1, 3>              second      = Tensor<1, 3>({0., 1., 0.});
      std::vector<double>       lengths     = {1., 1.};
      double                    thickness   = 0.1;
      double                    radius      = 0.1;
      std::vector<unsigned int> cells       = {8, 8};
      unsigned int              fillet_half = 2;
      unsigned int              rows        = 2;
      unsigned int              layers      = 1;
      double                    grading     = 1.;
    };



    void
    RoundedPlate::declare(ParameterHandler &prm)
    {
      prm.add_parameter("Corner",
                        corner,
                        "Where the rounded corner would be if it were sharp, in the middle of "
                        "the thickness; x, y, z; length.");
      prm.add_parameter("First direction",
                        first,
                        "Direction from the corner along the first side; x, y, z; the length "
                        "does not count.");
      prm.add_parameter("Second direction",
                        second,
                        "Direction from the corner along the second side, perpendicular to the "
                        "first; x, y, z.");
      prm.add_parameter("Side lengths",
                        lengths,
                        "Lengths of the first and the second side, from the corner as if it "
                        "were sharp.",
                        Patterns::List(Patterns::Double(0.), 2, 2));
      prm.add_parameter("Thickness", thickness, "Thickness; length.", Patterns::Double(0.));
      prm.add_parameter("Corner radius",
                        radius,
                        "Radius of the rounded corner, and the distance from the corner at "
                        "which the rounding starts; length.",
                        Patterns::Double(0.));
      prm.add_parameter("Cells",
                        cells,
                        "Number of cells along the straight part of the first side and of the "
                        "second side.",
                        Patterns::List(Patterns::Integer(1), 2, 2));
      prm.add_parameter("Fillet cells",
                        fillet_half,
                        "Cells along each half of the rounding.",
                        Patterns::Integer(1));
      prm.add_parameter("Rows",
                        rows,
                        "Rows of cells that follow the first side, the rounding and the second "
                        "side, each as high as a cell of the rounding is long. The rest is "
                        "meshed in rows and columns, so a section has (n1 + f)(n2 + f) + "
                        "r (n1 + n2 + 2 f) cells with 'Cells' n1, n2, 'Fillet cells' f and r "
                        "rows.",
                        Patterns::Integer(1));
      prm.add_parameter("Layers",
                        layers,
                        "Cells of equal size through the thickness.",
                        Patterns::Integer(1));
      prm.add_parameter("Grading",
                        grading,
                        "Size of the last cell of a side over that of the first one beside the "
                        "rounding; the cells between grow geometrically. No unit; 1 is uniform.",
                        Patterns::Double(1e-6, 1e6));
    }



    void
    RoundedPlate::check(const std::string &section) const
    {
      const auto text = [](const auto &x) { return Patterns::Tools::to_string(x); };
      // The section is meshed in coordinates along both directions, which therefore must be
      // perpendicular; their lengths do not matter, for they are normalised in create().
      if (first.norm() == 0.)
        throw InputError(section,
                         "First direction",
                         text(first),
                         "it has no length",
                         "give the direction of the first side, e.g. 1, 0, 0");
      if (!(std::abs(first * second) <= 1e-10 * first.norm() * second.norm()) ||
          second.norm() == 0.)
        throw InputError(section,
                         "Second direction",
                         text(second),
                         "it is not perpendicular to 'First direction' (" + text(first) + ")",
                         "give a direction at right angles with it");
      if (!(thickness > 0.))
        throw InputError(section,
                         "Thickness",
                         text(thickness),
                         "a plate needs a positive thickness",
                         "give it as a length");
      if (!(radius > 0.) || !(radius < std::min(lengths[0], lengths[1])))
        throw InputError(section,
                         "Corner radius",
                         text(radius),
                         "it does not lie between 0 and the shorter one of the sides",
                         "give a radius less than the 'Side lengths' (" + text(lengths) +
                           "); a plate with sharp corners is the geometry 'box'");

      // Half of it leaves room for the numbers of cells that a factor rounds.
      const double height = rows * numbers::PI / 4. * radius / fillet_half;
      if (!(height < 0.5 * std::min(lengths[0], lengths[1])))
        throw InputError(section,
                         "Rows",
                         text(rows),
                         "the rows that follow the sides are " + text(height) +
                           " high together, half of the plate or more",
                         "take fewer, or more 'Fillet cells' (" + text(fillet_half) + ")");
    }



    BodyMesh
    RoundedPlate::create(const double factor, const std::string &, const std::string &) const
    {
      // An upper bound of the cells of a section, times layers, before anything is allocated.
      check_number_of_cells(
        (scaled_cells(cells[0], factor) + 2. * scaled_cells(fillet_half, factor)) *
        (scaled_cells(cells[1], factor) + 2. * scaled_cells(fillet_half, factor)) *
        scaled_cells(layers, factor));
      const RoundedRectangle section({{lengths[0], lengths[1]}},
                                     radius,
                                     {{scaled_cells(cells[0], factor),
                                       scaled_cells(cells[1], factor)}},
                                     scaled_cells(fillet_half, factor),
                                     scaled_cells(rows, factor),
                                     grading);
      const unsigned int     n      = scaled_cells(layers, factor);
      const unsigned int     points = section.points.size();
      const Tensor<1, 3>     a      = first / first.norm();
      const Tensor<1, 3>     b      = second / second.norm();
      const Tensor<1, 3>     normal = cross_product_3d(a, b);

      // The section is extruded: vertex v of the section in layer k has the number v + k points,
      // so v % points tells where in the section a vertex of a boundary face lies.
      BodyMesh mesh;
      for (unsigned int k = 0; k <= n; ++k)
        for (const Point<2> &x : section.points)
          mesh.vertices.push_back(corner + x[0] * a + x[1] * b +
                                  thickness * (double(k) / n - 0.5) * normal);
      for (unsigned int k = 0; k < n; ++k)
        for (const CellData<2> &quad : section.cells)
          {
            CellData<3> cell;
            for (unsigned int v = 0; v < 8; ++v)
              cell.vertices[v] = quad.vertices[v % 4] + points * (k + v / 4);
            mesh.cells.push_back(cell);
          }

      add_boundary_faces(mesh, [&](const FaceVertices &face) {
        const auto all = [&](const auto &condition) {
          return std::all_of(face.begin(), face.end(), condition);
        };
        const auto on = [&](const std::set<unsigned int> &side) {
          return all([&](const unsigned int v) { return side.count(v % points) > 0; });
        };
        // The fillet comes before the sides, whose first vertices are the ends of the rounding.
        // Only the fillet is curved.
        using Ids = std::pair<types::boundary_id, types::manifold_id>;
        if (all([&](const unsigned int v) { return v < points; }))
          return Ids(back, numbers::flat_manifold_id);
        if (all([&](const unsigned int v) { return v >= n * points; }))
          return Ids(front, numbers::flat_manifold_id);
        if (on(section.fillet))
          return Ids(fillet, 0);
        if (on(section.first_side))
          return Ids(first_side, numbers::flat_manifold_id);
        if (on(section.second_side))
          return Ids(second_side, numbers::flat_manifold_id);
        return Ids(on(section.far_first_side) ? far_first_side : far_second_side,
                   numbers::flat_manifold_id);
      });
      mesh.boundary_names = {{"first side", first_side},
                             {"fillet", fillet},
                             {"second side", second_side},
                             {"far first side", far_first_side},
                             {"far second side", far_second_side},
                             {"back", back},
                             {"front", front}};

      const Point<3> centre = corner + radius * (a + b);
      // Cells inside have no manifold: refined vertices lie on the cylinder at the fillet only.
      mesh.manifolds[0]     = std::make_shared<CylindricalManifold<3>>(normal, centre);
      mesh.surfaces[fillet] = make_cone(centre, normal, radius, 0., true);
      return mesh;
    }

    const GeometryRegistry::Entry<RoundedPlate> rounded_plate_entry(
      "rounded plate",
      "A rectangular plate with one corner rounded, with the boundaries first side and "
      "second side (the two that meet in the rounded corner), fillet (the rounding), far "
      "first side and far second side (opposite to these), back and front (back is where "
      "the cross product of both directions points away from).");
  } // namespace
} // namespace Touchstone

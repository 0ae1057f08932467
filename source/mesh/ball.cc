// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/mesh/body_mesh.h>
#include <touchstone/mesh/round_lattice.h>

#include <deal.II/grid/manifold_lib.h>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** @brief A ball, or the half, quarter or octant of one. */
    class Ball : public Geometry
    {
    public:
      void
      declare(ParameterHandler &prm) override
      {
        prm.add_parameter("Centre", centre, "Centre of the ball, x, y, z; length.");
        prm.add_parameter("Radius", radius, "Radius; length.", Patterns::Double(0.));
        prm.add_parameter("Keep",
                          keep,
                          "Which part is meshed, for x, y, z: 'both' sides of the centre, "
                          "'+' or '-'. '+, +, +' is an octant.",
                          Patterns::List(Patterns::Selection("both|+|-"), 3, 3));
        prm.add_parameter("Cells",
                          cells,
                          "Number of cells from the centre to the side of the core, which "
                          "is about half of the radius, and from there to the surface.",
                          Patterns::List(Patterns::Integer(1), 2, 2));
        prm.add_parameter("Radial grading",
                          grading,
                          "Thickness of the last cell at the surface over that of the first "
                          "outside of the core; the cells between grow geometrically. No unit; 1 "
                          "is uniform, less than 1 is finer at the surface.",
                          Patterns::Double(1e-6, 1e6));
      }

      void
      check(const std::string &section) const override
      {
        if (!(radius > 0.))
          throw InputError(section,
                           "Radius",
                           Patterns::Tools::to_string(radius),
                           "a ball needs a positive radius",
                           "give the radius as a length");
      }

      BodyMesh
      create(const double factor, const std::string &, const std::string &) const override
      {
        // The lattice is made on the unit ball around the origin, whose coordinates are exactly
        // zero in the cut planes, so that faces of cuts can be told by comparison with zero; only
        // the vertices of the mesh are scaled and moved.
        const RoundLattice lattice(
          3, keep, scaled_cells(cells[0], factor), scaled_cells(cells[1], factor), 1, grading);

        BodyMesh mesh;
        mesh.cells = lattice.cells;
        for (const Tensor<1, 3> &x : lattice.points)
          mesh.vertices.push_back(centre + radius * x);

        add_boundary_faces(mesh, [&](const FaceVertices &face) {
          for (unsigned int d = 0; d < 3; ++d)
            {
              bool plane = keep[d] != "both";
              for (const unsigned int v : face)
                plane = plane && lattice.points[v][d] == 0.;
              if (plane)
                return std::make_pair(1 + d, numbers::flat_manifold_id);
            }
          return std::make_pair(0u, types::manifold_id(0));
        });

        // Boundaries of cuts exist only where there are cuts, so that a condition on a missing
        // one is an error.
        mesh.boundary_names = {{"surface", 0}};
        for (unsigned int d = 0; d < 3; ++d)
          if (keep[d] != "both")
            mesh.boundary_names[std::string(1, "xyz"[d]) + " cut"] = 1 + d;

        // New vertices on the surface lie on the sphere by the manifold, contact takes gaps from
        // the exact surface.
        mesh.manifolds[0] = std::make_shared<SphericalManifold<3>>(centre);
        mesh.surfaces[0]  = make_sphere(centre, radius, true);
        return mesh;
      }

    private:
      Point<3>                  centre;
      double                    radius  = 1.;
      std::vector<std::string>  keep    = {"both", "both", "both"};
      std::vector<unsigned int> cells   = {2, 2};
      double                    grading = 1.;
    };

    const GeometryRegistry::Entry<Ball>
      ball_entry("ball",
                 "A ball, or the half, quarter or octant of one, with the boundaries surface and, "
                 "where it is cut, x cut, y cut, z cut.");
  } // namespace
} // namespace Touchstone

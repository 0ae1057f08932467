// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/base/keyword.h>
#include <touchstone/mesh/body_mesh.h>
#include <touchstone/mesh/edge_grading.h>

#include <deal.II/base/numbers.h>
#include <deal.II/grid/manifold_lib.h>

#include <algorithm>
#include <cmath>

// A round block for contact of Hertz's type whose mesh follows the edge of the contact: rings
// around the axis that are narrowest at the edge, where the pressure has a vertical tangent. Cells
// that are halved alike in all directions would need as many around the edge as it is long; rings
// need no more of them than the smooth solution around the axis does.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** How much of a circle and of a square the outline of the core is: with these the angles of
     * its outer corner cells stay below 150 degrees. */
    constexpr double core_circle = 0.6, core_square = 0.8;

    /** @brief The mesh in x and y: a square core, and rings that become circles at once. */
    struct Plan
    {
      /** @param n Cells from the axis to the side of the core. @param radii Of the rings, from that
       * of the core. */
      Plan(unsigned int n, const std::vector<double> &radii);

      struct Cell
      {
        std::array<unsigned int, 4> corners;
        bool                        circular;
      };
      std::vector<Tensor<1, 2>> points;
      std::vector<Cell>         cells;
      /** Points from here on are those of the outermost ring. */
      unsigned int last_ring;
    };



    /** @brief A quarter of a round block with a spherical or flat contact face. */
    class RoundCap : public Geometry
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
        contact,
        far,
        side,
        x_cut,
        y_cut
      };

      Point<3>    apex;
      double      radius = 0., width = 1., height = 1., core = 0.1;
      EdgeGrading grading;
      enum class Side
      {
        bottom,
        top
      };
      Keyword<Side> contact_side{Side::bottom, {{"bottom", Side::bottom}, {"top", Side::top}}};
      unsigned int  cells = 4;

      /** Boundaries of the @p mesh that has been made from the @p plan. */
      void
      add_faces(BodyMesh &mesh, const Plan &plan, unsigned int layers) const;

      /** Depth of the contact face below the apex's tangent plane, without cancellation. */
      double
      sag(const double r) const
      {
        return radius > 0. ? r * r / (radius + std::sqrt(radius * radius - r * r)) : 0.;
      }
    };



    void
    RoundCap::declare(ParameterHandler &prm)
    {
      prm.add_parameter("Apex", apex, "Point of first contact, x, y, z; length.");
      prm.add_parameter("Radius",
                        radius,
                        "Radius of the contact face; length; 0 makes it flat.",
                        Patterns::Double(0.));
      contact_side.declare(prm,
                           "Contact side",
                           "Whether the contact face is the bottom, with the body above it, "
                           "or the top.");
      prm.add_parameter("Width",
                        width,
                        "Radius of the block around its axis; length.",
                        Patterns::Double(0.));
      prm.add_parameter("Height",
                        height,
                        "Extent in z from the apex to the flat far face; length.",
                        Patterns::Double(0.));
      grading.declare(prm);
      prm.add_parameter("Core radius",
                        core,
                        "Radius of the core, which has square cells where rings would have "
                        "wedges; length.",
                        Patterns::Double(0.));
      prm.add_parameter("Cells",
                        cells,
                        "Cells from the axis to the side of the core; the quarter of a ring has "
                        "twice as many.",
                        Patterns::Integer(1));
    }



    void
    RoundCap::check(const std::string &section) const
    {
      const auto text = [](const double x) { return Patterns::Tools::to_string(x); };
      if (!(core > 0.))
        throw InputError(section,
                         "Core radius",
                         text(core),
                         "the core has no extent",
                         "take a third of the smallest of 'Edges'");
      grading.check(section, core, std::min(width, height));
      if (radius > 0. && width >= 0.99 * radius)
        throw InputError(section,
                         "Width",
                         text(width),
                         "the block reaches beyond the equator of the contact face",
                         "take less than 0.99 times 'Radius' (" + text(radius) + ")");
      if (height <= 1.01 * sag(width))
        throw InputError(section,
                         "Height",
                         text(height),
                         "the contact face cuts the far face: at the side of the block it is " +
                           text(sag(width)) + " away from the apex",
                         "make 'Height' larger or 'Width' smaller");
    }



    Plan::Plan(const unsigned int n, const std::vector<double> &radii)
    {
      const unsigned int row = n + 1, ring = 2 * n + 1, rings = radii.size() - 1;
      // Angles are measured from the axis that is closer, such that points on the axes have a
      // coordinate of exactly zero.
      const auto circle = [n](const double s) {
        const double angle = numbers::PI / (4. * n);
        return Tensor<1, 2>({std::sin(angle * (2. * n - s)), std::sin(angle * s)});
      };
      for (unsigned int j = 0; j <= n; ++j)
        for (unsigned int i = 0; i <= n; ++i)
          {
            // Squares around the axis, ever more of a circle towards the outline.
            const double m = std::max(i, j), t = m / n, c = core_circle * t;
            Tensor<1, 2> x;
            if (m > 0)
              x = core_square * (1. - c) / n * Tensor<1, 2>({double(i), double(j)}) +
                  c * t * circle(i == m ? j / m * n : (2. - i / m) * n);
            points.push_back(radii[0] * x);
          }
      for (unsigned int k = 1; k <= rings; ++k)
        for (unsigned int s = 0; s < ring; ++s)
          points.push_back(radii[k] * circle(s));
      last_ring = points.size() - ring;

      const auto at = [&](const unsigned int k, const unsigned int s) {
        if (k > 0)
          return row * row + (k - 1) * ring + s;
        return s <= n ? s * row + n : n * row + 2 * n - s;
      };
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          {
            const unsigned int first = j * row + i;
            cells.push_back({{{first, first + 1, first + row, first + row + 1}}, false});
          }
      for (unsigned int k = 0; k < rings; ++k)
        for (unsigned int s = 0; s + 1 < ring; ++s)
          cells.push_back({{{at(k, s), at(k + 1, s), at(k, s + 1), at(k + 1, s + 1)}}, k > 0});
    }



    BodyMesh
    RoundCap::create(const double factor, const std::string &, const std::string &) const
    {
      const unsigned int        n     = scaled_cells(cells, factor);
      const std::vector<double> radii = grading.along(core, width, factor),
                                down  = grading.down(height, factor);
      const unsigned int layers       = down.size() - 1;
      check_number_of_cells(double(n) * (n + 2. * (radii.size() - 1)) * layers);

      const Plan         plan(n, radii);
      const bool         top  = contact_side == Side::top;
      const unsigned int size = plan.points.size();
      BodyMesh           mesh;
      for (unsigned int k = 0; k <= layers; ++k)
        for (const Tensor<1, 2> &x : plan.points)
          {
            const double s = sag(x.norm()), depth = down[top ? layers - k : k] / height,
                         z = (top ? -1. : 1.) * (s + depth * (height - s));
            mesh.vertices.push_back(apex + Tensor<1, 3>({x[0], x[1], z}));
          }
      for (const Plan::Cell &cell : plan.cells)
        for (unsigned int k = 0; k < layers; ++k)
          {
            mesh.cells.emplace_back();
            for (unsigned int v = 0; v < 8; ++v)
              mesh.cells.back().vertices[v] = cell.corners[v % 4] + (k + v / 4) * size;
            // Halved cells of the rings stay circular.
            mesh.cells.back().manifold_id = cell.circular ? 1 : numbers::flat_manifold_id;
          }
      add_faces(mesh, plan, layers);
      return mesh;
    }



    void
    RoundCap::add_faces(BodyMesh &mesh, const Plan &plan, const unsigned int layers) const
    {
      const bool         top  = contact_side == Side::top;
      const unsigned int size = plan.points.size();
      add_boundary_faces(mesh, [&](const FaceVertices &face) {
        const auto all = [&](const auto &condition) {
          return std::all_of(face.begin(), face.end(), condition);
        };
        const auto layer = [&](const unsigned int k) {
          return all([k, size](const unsigned int v) { return v / size == k; });
        };
        const auto cut = [&](const unsigned int d) {
          return all([&, d](const unsigned int v) { return plan.points[v % size][d] == 0.; });
        };
        using Ids = std::pair<types::boundary_id, types::manifold_id>;
        if (layer(top ? layers : 0))
          return Ids(contact, radius > 0. ? 0 : numbers::flat_manifold_id);
        if (layer(top ? 0 : layers))
          return Ids(far, numbers::flat_manifold_id);
        if (cut(0))
          return Ids(x_cut, numbers::flat_manifold_id);
        return cut(1) ? Ids(y_cut, numbers::flat_manifold_id) : Ids(side, 1);
      });
      mesh.boundary_names = {
        {"contact", contact}, {"far", far}, {"side", side}, {"x cut", x_cut}, {"y cut", y_cut}};
      mesh.manifolds[1] =
        std::make_shared<CylindricalManifold<3>>(Tensor<1, 3>({0., 0., 1.}), apex);
      if (radius > 0.)
        {
          const Point<3> centre  = apex + Tensor<1, 3>({0., 0., top ? -radius : radius});
          mesh.manifolds[0]      = std::make_shared<SphericalManifold<3>>(centre);
          mesh.surfaces[contact] = make_sphere(centre, radius, true);
        }
    }

    const GeometryRegistry::Entry<RoundCap> round_cap_entry(
      "round cap",
      "A quarter of a round block with a spherical or flat contact face, whose mesh is finest in a "
      "ring around the axis, where the edge of the contact is; with the boundaries contact, far "
      "(opposite), side, x cut and y cut.");
  } // namespace
} // namespace Touchstone

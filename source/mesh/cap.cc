#include <touchstone/mesh/body_mesh.h>
#include <touchstone/scene/input_error.h>

#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /**
     * @brief Coordinates of the cap: plan position and the fraction of the depth
     * between the spherical contact face (0) and the flat far face (1).
     *
     * Averages of these keep refined and quadratic cells on the sphere and in
     * the pattern of the graded mesh.
     */
    class CapManifold : public ChartManifold<3>
    {
    public:
      CapManifold(const Point<3> &apex,
                  const double    radius,
                  const double    height,
                  const double    direction)
        : apex(apex)
        , radius(radius)
        , height(height)
        , direction(direction)
      {
      }

      std::unique_ptr<Manifold<3>>
      clone() const override
      {
        return std::make_unique<CapManifold>(apex, radius, height, direction);
      }

      /** Depth of the sphere below the apex's tangent plane. */
      double
      sag(const double x, const double y) const
      {
        // The same as R - sqrt(R^2 - d), without its cancellation.
        const double d = x * x + y * y;
        return radius > 0. ? d / (radius + std::sqrt(radius * radius - d)) : 0.;
      }

      Point<3>
      push_forward(const Point<3> &chart) const override
      {
        const double s = sag(chart[0], chart[1]);
        return apex + Tensor<1, 3>({chart[0], chart[1], direction * (s + chart[2] * (height - s))});
      }

      Point<3>
      pull_back(const Point<3> &x) const override
      {
        const Tensor<1, 3> d = x - apex;
        const double       s = sag(d[0], d[1]);
        return Point<3>(d[0], d[1], (direction * d[2] - s) / (height - s));
      }

      DerivativeForm<1, 3, 3>
      push_forward_gradient(const Point<3> &chart) const override
      {
        const double            s = sag(chart[0], chart[1]);
        DerivativeForm<1, 3, 3> gradient;
        for (unsigned int d = 0; d < 2; ++d)
          {
            gradient[d][d] = 1.;
            if (radius > 0.)
              gradient[2][d] = direction * (1. - chart[2]) * chart[d] / (radius - s);
          }
        gradient[2][2] = direction * (height - s);
        return gradient;
      }

    private:
      const Point<3> apex;
      const double   radius, height, direction;
    };



    /** @brief A block with a spherical contact face and a mesh that is fine where
     * the contact is. */
    class Cap : public Geometry
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
        x_cut,
        y_cut,
        x_side,
        y_side
      };

      Point<3>    apex;
      double      radius = 0., width = 1., height = 1.;
      std::string side = "bottom", part = "quarter";
      double      fine = 0.25;

      unsigned int fine_cells = 4, outer_cells = 4, fine_layers = 4, outer_layers = 4;
    };



    void
    Cap::declare(ParameterHandler &prm)
    {
      prm.add_parameter("Apex", apex, "Point of first contact, x, y, z; length.");
      prm.add_parameter("Radius",
                        radius,
                        "Radius of the contact face, a sphere; length; 0 makes it flat.",
                        Patterns::Double(0.));
      prm.add_parameter("Contact side",
                        side,
                        "Whether the contact face is the bottom, with the body above it, "
                        "or the top.",
                        Patterns::Selection("bottom|top"));
      prm.add_parameter("Part",
                        part,
                        "The quarter where x and y are not less than at the apex, or the "
                        "whole block.",
                        Patterns::Selection("quarter|whole"));
      prm.add_parameter("Width",
                        width,
                        "Extent in x and y from the apex; length.",
                        Patterns::Double(0.));
      prm.add_parameter("Height",
                        height,
                        "Extent in z from the apex to the flat far face; length.",
                        Patterns::Double(0.));
      prm.add_parameter("Contact width",
                        fine,
                        "Extent of the fine mesh in x, y and z from the apex; length.",
                        Patterns::Double(0.));
      prm.add_parameter("Contact cells",
                        fine_cells,
                        "Cells of equal size over the contact width in x and y.",
                        Patterns::Integer(1));
      prm.add_parameter("Outer cells",
                        outer_cells,
                        "Cells that grow geometrically from there to the width.",
                        Patterns::Integer(1));
      prm.add_parameter("Contact layers",
                        fine_layers,
                        "Cells of equal size over the contact width in z.",
                        Patterns::Integer(1));
      prm.add_parameter("Outer layers",
                        outer_layers,
                        "Cells that grow geometrically from there to the far face.",
                        Patterns::Integer(1));
    }



    void
    Cap::check(const std::string &section) const
    {
      const auto text = [](const double x) { return Patterns::Tools::to_string(x); };
      if (!(fine > 0. && fine < width && fine < height))
        throw InputError(section,
                         "Contact width",
                         text(fine),
                         "it does not lie between 0 and the smaller of 'Width' and 'Height'",
                         "take about two radii of the contact area that you expect");
      if (radius > 0. && 2. * width * width >= 0.99 * radius * radius)
        throw InputError(section,
                         "Width",
                         text(width),
                         "the block's corner reaches beyond the sphere's equator",
                         "take at most 0.7 times 'Radius' (" + text(radius) + ")");
      const double sag =
        radius > 0. ? radius - std::sqrt(radius * radius - 2. * width * width) : 0.;
      if (height <= 1.01 * sag)
        throw InputError(section,
                         "Height",
                         text(height),
                         "the sphere cuts the far face: at the block's corner it is " + text(sag) +
                           " away from the apex",
                         "make 'Height' larger or 'Width' smaller");
    }



    /** Positions from 0: @p n_fine equal cells up to @p fine, then @p n_outer
     * cells up to @p end, each larger than the one before by the same factor. */
    std::vector<double>
    fine_then_growing(const double       fine,
                      const unsigned int n_fine,
                      const double       end,
                      const unsigned int n_outer)
    {
      const double h       = fine / n_fine;
      const auto   reached = [&](const double growth) {
        double x = fine, size = h;
        for (unsigned int i = 0; i < n_outer; ++i)
          x += size *= growth;
        return x;
      };
      double low = 0., high = (end - fine) / h + 1.;
      for (unsigned int step = 0; step < 200; ++step)
        {
          const double middle                  = (low + high) / 2.;
          (reached(middle) < end ? low : high) = middle;
        }

      std::vector<double> positions;
      for (unsigned int i = 0; i <= n_fine; ++i)
        positions.push_back(fine * i / n_fine);
      double size = h;
      for (unsigned int i = 0; i < n_outer; ++i)
        positions.push_back(positions.back() + (size *= low));
      positions.back() = end;
      return positions;
    }



    BodyMesh
    Cap::create(const double factor, const std::string &, const std::string &) const
    {
      std::vector<double> plan  = fine_then_growing(fine,
                                                   scaled_cells(fine_cells, factor),
                                                   width,
                                                   scaled_cells(outer_cells, factor));
      std::vector<double> depth = fine_then_growing(fine,
                                                    scaled_cells(fine_layers, factor),
                                                    height,
                                                    scaled_cells(outer_layers, factor));

      const bool whole = part == "whole";
      if (whole)
        {
          std::vector<double> mirrored;
          for (unsigned int i = plan.size() - 1; i > 0; --i)
            mirrored.push_back(-plan[i]);
          plan.insert(plan.begin(), mirrored.begin(), mirrored.end());
        }

      const bool top       = side == "top";
      const auto manifold  = std::make_shared<CapManifold>(apex, radius, height, top ? -1. : 1.);
      const unsigned int n = plan.size() - 1, layers = depth.size() - 1;

      BodyMesh mesh =
        make_block({{n, n, layers}},
                   false,
                   [&](const unsigned int i, const unsigned int j, const unsigned int k) {
                     return manifold->push_forward(
                       Point<3>(plan[i], plan[j], depth[top ? layers - k : k] / height));
                   },
                   {{whole ? x_side : x_cut,
                     x_side,
                     whole ? y_side : y_cut,
                     y_side,
                     top ? far : contact,
                     top ? contact : far}});

      mesh.boundary_names = {{"contact", contact},
                             {"far", far},
                             {"x side", x_side},
                             {"y side", y_side}};
      if (!whole)
        {
          mesh.boundary_names["x cut"] = x_cut;
          mesh.boundary_names["y cut"] = y_cut;
        }

      if (radius > 0.)
        {
          mesh.manifolds[0] = manifold;
          for (CellData<3> &cell : mesh.cells)
            cell.manifold_id = 0;
          mesh.surfaces[contact] =
            make_sphere(apex + Tensor<1, 3>({0., 0., top ? -radius : radius}), radius, true);
        }
      return mesh;
    }

    const GeometryRegistry::Entry<Cap>
      entry("cap",
            "A block with a spherical or flat contact face, meshed finely around the point of "
            "first contact, with the boundaries contact, far (opposite), x side, y side, and for "
            "the quarter x cut, y cut.");
  } // namespace
} // namespace Touchstone

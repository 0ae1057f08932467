// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/base/keyword.h>
#include <touchstone/mesh/body_mesh.h>

#include <cmath>

// A block with a curved face for contact of Hertz's type: equal small cells around the apex,
// where the pressure is, and cells that grow from there to the sides and the far face, which
// should be many contact radii away.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /**
     * @brief Coordinates of the cap: plan position and the fraction of the depth
     * between the curved contact face (0) and the flat far face (1).
     *
     * Averages of these keep refined and quadratic cells on the sphere or cylinder
     * and in the pattern of the graded mesh.
     */
    class CapManifold : public ChartManifold<3>
    {
    public:
      CapManifold(const Point<3> &apex,
                  const bool      cylinder,
                  const double    radius,
                  const double    height,
                  const double    direction)
        : apex(apex)
        , curved(cylinder ? 1 : 2)
        , radius(radius)
        , height(height)
        , direction(direction)
      {
      }

      std::unique_ptr<Manifold<3>>
      clone() const override
      {
        return std::make_unique<CapManifold>(apex, curved == 1, radius, height, direction);
      }

      /** Depth of the contact face below the apex's tangent plane. */
      double
      sag(const double x, const double y) const
      {
        // The same as R - sqrt(R^2 - d), without its cancellation.
        const double d = curved == 1 ? x * x : x * x + y * y;
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
            // The slope of the surface is x/(R - sag): at the depth fraction z it is attenuated
            // by 1 - z.
            if (radius > 0. && d < curved)
              gradient[2][d] = direction * (1. - chart[2]) * chart[d] / (radius - s);
          }
        gradient[2][2] = direction * (height - s);
        return gradient;
      }

    private:
      const Point<3> apex;
      /** The number of directions in which the face is curved: x, or x and y. */
      const unsigned int curved;
      const double       radius, height, direction;
    };



    /** @brief A block with a spherical or cylindrical contact face and a mesh that
     * is fine where the contact is. */
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

      Point<3> apex;
      double   radius = 0., width = 1., height = 1., depth = 1.;
      enum class Part
      {
        quarter,
        half,
        whole
      };
      enum class Shape
      {
        sphere,
        cylinder
      };
      enum class Side
      {
        bottom,
        top
      };
      Keyword<Shape> shape{Shape::sphere,
                           {{"sphere", Shape::sphere}, {"cylinder", Shape::cylinder}}};
      /** Where the contact face is. */
      Keyword<Side> side{Side::bottom, {{"bottom", Side::bottom}, {"top", Side::top}}};
      Keyword<Part> part{Part::quarter,
                         {{"quarter", Part::quarter},
                          {"half", Part::half},
                          {"whole", Part::whole}}};
      double        fine = 0.25;

      unsigned int fine_cells = 4, outer_cells = 4, fine_layers = 4, outer_layers = 4,
                   depth_cells = 1;

      bool
      is_cylinder() const
      {
        return shape == Shape::cylinder;
      }
    };



    void
    Cap::declare(ParameterHandler &prm)
    {
      prm.add_parameter("Apex", apex, "Point of first contact, x, y, z; length.");
      shape.declare(prm,
                    "Shape",
                    "The contact face is part of a sphere, or of a cylinder with its axis "
                    "along y: then the body is a slice, which 'Symmetry = y cut, y side' "
                    "puts into plane strain.");
      prm.add_parameter("Radius",
                        radius,
                        "Radius of the contact face; length; 0 makes it flat.",
                        Patterns::Double(0.));
      side.declare(prm,
                   "Contact side",
                   "Whether the contact face is the bottom, with the body above it, "
                   "or the top.");
      part.declare(prm,
                   "Part",
                   "The quarter where x and y are not less than at the apex, for a "
                   "cylinder the half where x is not less, or the whole block.");
      prm.add_parameter("Width",
                        width,
                        "Extent in x and y from the apex, for a cylinder in x; length.",
                        Patterns::Double(0.));
      prm.add_parameter("Depth",
                        depth,
                        "Extent of a cylinder in y from the apex; length.",
                        Patterns::Double(0.));
      prm.add_parameter("Depth cells",
                        depth_cells,
                        "Cells of equal size over the depth of a cylinder.",
                        Patterns::Integer(1));
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



    /** Conditions under which the map of CapManifold is invertible: the contact face stays below
     * the equator and does not meet the far face. The margins keep the cells at the corner from
     * degenerating. */
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
      if (part == (is_cylinder() ? Part::quarter : Part::half))
        throw InputError(section,
                         "Part",
                         part.word(),
                         "a block with 'Shape = " + shape.word() + "' has no such part",
                         is_cylinder() ? "take half or whole" : "take quarter or whole");
      if (is_cylinder() && !(depth > 0.))
        throw InputError(section,
                         "Depth",
                         text(depth),
                         "a cylinder needs a positive depth",
                         "give its extent in y as a length");
      // Of the corner of a sphere's block, or the edge of a cylinder's.
      const double squared = (is_cylinder() ? 1. : 2.) * width * width;
      if (radius > 0. && squared >= 0.99 * radius * radius)
        throw InputError(section,
                         "Width",
                         text(width),
                         "the block's corner reaches beyond the equator of the contact face",
                         std::string("take at most ") + (is_cylinder() ? "0.99" : "0.7") +
                           " times 'Radius' (" + text(radius) + ")");
      const double sag = radius > 0. ? radius - std::sqrt(radius * radius - squared) : 0.;
      if (height <= 1.01 * sag)
        throw InputError(section,
                         "Height",
                         text(height),
                         "the contact face cuts the far face: at the block's corner it is " +
                           text(sag) + " away from the apex",
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
      // The growth factor by bisection of the monotone function reached(growth): for n cells it
      // is the root of a polynomial without a formula. At the upper end already the first of the
      // outer cells reaches beyond the end.
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
      // Without the round-off of the bisection, so that sides are exactly plane.
      positions.back() = end;
      return positions;
    }



    BodyMesh
    Cap::create(const double factor, const std::string &, const std::string &) const
    {
      // The plan is meshed for the quarter with x, y >= 0 and mirrored for the whole, so that the
      // mesh is symmetric to the last digit and symmetric problems have symmetric solutions.
      std::vector<double> plan = fine_then_growing(fine,
                                                   scaled_cells(fine_cells, factor),
                                                   width,
                                                   scaled_cells(outer_cells, factor));
      std::vector<double> down = fine_then_growing(fine,
                                                   scaled_cells(fine_layers, factor),
                                                   height,
                                                   scaled_cells(outer_layers, factor));

      // A cylinder has equal cells along its axis (y), a sphere the same positions in x and y.
      std::vector<double> across;
      if (is_cylinder())
        across = graded_positions(0., depth, scaled_cells(depth_cells, factor), 1.);
      const bool whole = part == Part::whole;
      if (whole)
        {
          std::vector<double> mirrored;
          for (unsigned int i = plan.size() - 1; i > 0; --i)
            mirrored.push_back(-plan[i]);
          plan.insert(plan.begin(), mirrored.begin(), mirrored.end());
        }
      if (!is_cylinder())
        across = plan;

      const bool top = side == Side::top;
      const auto manifold =
        std::make_shared<CapManifold>(apex, is_cylinder(), radius, height, top ? -1. : 1.);
      const unsigned int n = plan.size() - 1, m = across.size() - 1, layers = down.size() - 1;

      BodyMesh mesh =
        make_block({{n, m, layers}},
                   false,
                   [&](const unsigned int i, const unsigned int j, const unsigned int k) {
                     return manifold->push_forward(
                       Point<3>(plan[i], across[j], down[top ? layers - k : k] / height));
                   },
                   {{whole ? x_side : x_cut,
                     x_side,
                     whole && !is_cylinder() ? y_side : y_cut,
                     y_side,
                     top ? far : contact,
                     top ? contact : far}});

      mesh.boundary_names = {{"contact", contact},
                             {"far", far},
                             {"x side", x_side},
                             {"y side", y_side}};
      if (!whole)
        mesh.boundary_names["x cut"] = x_cut;
      if (!whole || is_cylinder())
        mesh.boundary_names["y cut"] = y_cut;

      if (radius > 0.)
        {
          // All cells have the manifold, not just the surface, so that refinement keeps the
          // layers parallel to the curved face near it.
          mesh.manifolds[0] = manifold;
          for (CellData<3> &cell : mesh.cells)
            cell.manifold_id = 0;
          const Point<3> centre = apex + Tensor<1, 3>({0., 0., top ? -radius : radius});
          mesh.surfaces[contact] =
            is_cylinder() ? make_cone(centre, Tensor<1, 3>({0., 1., 0.}), radius, 0., true)
                          : make_sphere(centre, radius, true);
        }
      return mesh;
    }

    const GeometryRegistry::Entry<Cap> cap_entry(
      "cap",
      "A block with a spherical, cylindrical or flat contact face, meshed finely around the "
      "point or line of first contact, with the boundaries contact, far (opposite), x side, "
      "y side, and where it is cut x cut, y cut; a cylinder lies between y cut and y side.");
  } // namespace
} // namespace Touchstone

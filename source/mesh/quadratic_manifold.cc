// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/quadratic_manifold.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <stdexcept>

namespace Touchstone
{
  using namespace dealii;

  Point<3>
  evaluate(const QuadraticCell &cell, const Point<3> &unit, Tensor<2, 3> &jacobian)
  {
    double value[3][3], slope[3][3];
    for (unsigned int d = 0; d < 3; ++d)
      {
        const double t = unit[d];
        value[d][0]    = (2. * t - 1.) * (t - 1.);
        value[d][1]    = 4. * t * (1. - t);
        value[d][2]    = t * (2. * t - 1.);
        slope[d][0]    = 4. * t - 3.;
        slope[d][1]    = 4. - 8. * t;
        slope[d][2]    = 4. * t - 1.;
      }
    Point<3>     x;
    Tensor<2, 3> columns;
    for (unsigned int k = 0, n = 0; k < 3; ++k)
      for (unsigned int j = 0; j < 3; ++j)
        for (unsigned int i = 0; i < 3; ++i, ++n)
          {
            x += value[0][i] * value[1][j] * value[2][k] * cell[n];
            columns[0] += slope[0][i] * value[1][j] * value[2][k] * cell[n];
            columns[1] += value[0][i] * slope[1][j] * value[2][k] * cell[n];
            columns[2] += value[0][i] * value[1][j] * slope[2][k] * cell[n];
          }
    jacobian = transpose(columns);
    return x;
  }



  namespace
  {
    /** How far beyond a cell, in unit coordinates, a point may lie that still counts as its own:
     * vertices that exact surfaces have moved. */
    constexpr double reach = 0.1;

    /** What all clones of the manifold share. */
    class QuadraticCells
    {
    public:
      /** A point of a cell. */
      struct Place
      {
        unsigned int cell;
        Point<3>     unit;
        /** How far it lies beyond the cell, in unit coordinates. */
        double beyond;
      };

      explicit QuadraticCells(const std::vector<QuadraticCell> &all)
        : cells(all)
      {
        std::vector<std::pair<BoundingBox<3>, unsigned int>> boxes;
        for (unsigned int c = 0; c < cells.size(); ++c)
          {
            BoundingBox<3> box(std::vector<Point<3>>(cells[c].begin(), cells[c].end()));
            double         size = 0.;
            for (unsigned int d = 0; d < 3; ++d)
              size = std::max(size, box.side_length(d));
            // The cell may reach beyond its nodes, and points beyond the cell.
            box.extend(0.25 * size);
            boxes.emplace_back(box, c);
          }
        tree = pack_rtree(boxes);
      }

      const std::vector<QuadraticCell> cells;

      /** The cells that have this point, in ascending order. Vertices of the mesh come again
       * and again, so places are kept. */
      const std::vector<Place> &
      places(const Point<3> &x) const
      {
        const std::lock_guard<std::mutex> lock(mutex);
        const auto [known, is_new] = found.insert({{{x[0], x[1], x[2]}}, {}});
        if (is_new)
          known->second = search(x);
        return known->second;
      }

    private:
      RTree<std::pair<BoundingBox<3>, unsigned int>> tree;
      /** References to its entries stay valid when others are added. */
      mutable std::map<std::array<double, 3>, std::vector<Place>> found;
      mutable std::mutex                                          mutex;

      std::vector<Place>
      search(const Point<3> &x) const
      {
        namespace bgi = boost::geometry::index;
        std::vector<std::pair<BoundingBox<3>, unsigned int>> near;
        tree.query(bgi::intersects(x), std::back_inserter(near));
        std::vector<Place> result;
        for (const auto &candidate : near)
          {
            Place place{candidate.second, Point<3>(.5, .5, .5), 0.};
            if (invert_map(cells[place.cell], x, place.unit))
              {
                for (unsigned int d = 0; d < 3; ++d)
                  place.beyond = std::max({place.beyond, -place.unit[d], place.unit[d] - 1.});
                // Round-off decides nothing.
                place.beyond = place.beyond < 1e-8 ? 0. : place.beyond;
                if (place.beyond < reach)
                  result.push_back(place);
              }
          }
        std::sort(result.begin(), result.end(), [](const Place &a, const Place &b) {
          return a.cell < b.cell;
        });
        return result;
      }

      /** Newton's iteration; steps are bounded, as the map means nothing far outside. */
      static bool
      invert_map(const QuadraticCell &cell, const Point<3> &x, Point<3> &unit)
      {
        Tensor<2, 3> jacobian;
        for (unsigned int i = 0; i < 50; ++i)
          {
            const Tensor<1, 3> residual = x - evaluate(cell, unit, jacobian);
            if (!(std::abs(determinant(jacobian)) > 0.))
              return false;
            Tensor<1, 3> step = invert(jacobian) * residual;
            const double size = step.norm();
            if (!(size < 1e6))
              return false;
            step *= std::min(1., 0.5 / std::max(size, 1e-300));
            unit += step;
            if (size < 1e-15)
              return true;
            if (unit.distance(Point<3>(.5, .5, .5)) > 3.)
              return false;
            // Round-off of the position allows no more.
            if (i > 8 && size < 1e-11)
              return true;
          }
        return false;
      }
    };



    class QuadraticManifold : public Manifold<3>
    {
    public:
      explicit QuadraticManifold(const std::shared_ptr<const QuadraticCells> &cells)
        : cells(cells)
      {
      }

      std::unique_ptr<Manifold<3>>
      clone() const override
      {
        return std::make_unique<QuadraticManifold>(cells);
      }

      Point<3>
      get_new_point(const ArrayView<const Point<3>> &points,
                    const ArrayView<const double>   &weights) const override
      {
        Table<2, double> table(1, weights.size());
        for (unsigned int i = 0; i < weights.size(); ++i)
          table(0, i) = weights[i];
        Point<3> result;
        get_new_points(points, table, ArrayView<Point<3>>(&result, 1));
        return result;
      }

      void
      get_new_points(const ArrayView<const Point<3>> &points,
                     const Table<2, double>          &weights,
                     ArrayView<Point<3>>              new_points) const override
      {
        std::vector<Point<3>> units;
        const QuadraticCell  &cell = common_cell(points, units);
        Tensor<2, 3>          jacobian;
        for (unsigned int n = 0; n < new_points.size(); ++n)
          {
            Point<3> unit;
            for (unsigned int i = 0; i < points.size(); ++i)
              unit += weights(n, i) * units[i];
            new_points[n] = evaluate(cell, unit, jacobian);
          }
      }

      Point<3>
      get_intermediate_point(const Point<3> &p1, const Point<3> &p2, const double w) const override
      {
        const std::array<Point<3>, 2> points{{p1, p2}};
        const std::array<double, 2>   weights{{1. - w, w}};
        return get_new_point(ArrayView<const Point<3>>(points.data(), 2),
                             ArrayView<const double>(weights.data(), 2));
      }

      Tensor<1, 3>
      get_tangent_vector(const Point<3> &x1, const Point<3> &x2) const override
      {
        const std::array<Point<3>, 2> points{{x1, x2}};
        std::vector<Point<3>>         units;
        const QuadraticCell &cell = common_cell(ArrayView<const Point<3>>(points.data(), 2), units);
        Tensor<2, 3>         jacobian;
        evaluate(cell, units[0], jacobian);
        return jacobian * (units[1] - units[0]);
      }

    private:
      const std::shared_ptr<const QuadraticCells> cells;

      /** The coarse cell that has all of the points, which belong to one of its descendants or to
       * a face or edge of it: any that has them gives the same result; that with the lowest
       * number is taken. */
      const QuadraticCell &
      common_cell(const ArrayView<const Point<3>> &points, std::vector<Point<3>> &units) const
      {
        using Places = std::vector<QuadraticCells::Place>;
        std::vector<const Places *> of_point;
        for (const Point<3> &x : points)
          of_point.push_back(&cells->places(x));
        double                best = reach;
        unsigned int          cell = 0;
        std::vector<Point<3>> there;
        for (const QuadraticCells::Place &first : *of_point[0])
          {
            there.clear();
            double beyond = 0.;
            for (const Places *places : of_point)
              {
                const auto place =
                  std::lower_bound(places->begin(),
                                   places->end(),
                                   first.cell,
                                   [](const auto &a, const unsigned int c) { return a.cell < c; });
                if (place == places->end() || place->cell != first.cell)
                  break;
                there.push_back(place->unit);
                beyond = std::max(beyond, place->beyond);
              }
            if (there.size() == of_point.size() && beyond < best)
              {
                best  = beyond;
                cell  = first.cell;
                units = there;
              }
          }
        if (units.empty())
          throw std::runtime_error("No cell of degree 2 of the mesh file has these points.");
        return cells->cells[cell];
      }
    };
  } // namespace



  std::unique_ptr<Manifold<3>>
  make_quadratic_manifold(const std::vector<QuadraticCell> &cells)
  {
    return std::make_unique<QuadraticManifold>(std::make_shared<QuadraticCells>(cells));
  }
} // namespace Touchstone

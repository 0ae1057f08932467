// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/mesh/body_mesh.h>
#include <touchstone/mesh/edge_grading.h>

#include <algorithm>
#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  void
  EdgeGrading::declare(ParameterHandler &prm)
  {
    prm.add_parameter(
      "Edges",
      edges,
      "Distances from the apex at which cells are smallest, ascending: those of the "
      "edge of the contact and, with friction, before it that of the stick zone; "
      "length.",
      Patterns::List(Patterns::Double(0.), 1));
    prm.add_parameter("Edge size",
                      edge_size,
                      "Width of the cells there, and thickness of the layer at the contact face; "
                      "length.",
                      Patterns::Double(0.));
    prm.add_parameter("Largest size",
                      largest,
                      "Cells within the last edge are no wider than this; length.",
                      Patterns::Double(0.));
    prm.add_parameter("Growth",
                      growth,
                      "Factor from the width of one cell to the next away from an edge, within the "
                      "last one. No unit.",
                      Patterns::Double(1., 10.));
    prm.add_parameter("Outer growth",
                      outer_growth,
                      "The same beyond the last edge. No unit.",
                      Patterns::Double(1., 10.));
    prm.add_parameter("Layer growth",
                      layer_growth,
                      "Factor from one layer to the next away from the contact face. No unit.",
                      Patterns::Double(1., 10.));
  }



  void
  EdgeGrading::check(const std::string &section, const double start, const double end) const
  {
    const auto text = [](const double x) { return Patterns::Tools::to_string(x); };
    double     last = start;
    for (const double edge : edges)
      {
        if (!(edge > last && edge < end))
          throw InputError(section,
                           "Edges",
                           text(edge),
                           "it does not lie between " + text(last) + " and " + text(end),
                           "give ascending distances within 'Width' and 'Height', of a round cap "
                           "beyond 'Core radius'");
        // Cells of this size on both sides of each edge.
        if (!(edge_size > 0. && 2. * edge_size <= edge - last))
          throw InputError(section,
                           "Edge size",
                           text(edge_size),
                           "two cells of this size do not fit in between " + text(last) + " and " +
                             text(edge),
                           "take a hundredth of the last of 'Edges'");
        last = edge;
      }
    if (!(largest >= edge_size))
      throw InputError(section,
                       "Largest size",
                       text(largest),
                       "it is less than 'Edge size'",
                       "take a twentieth of the last of 'Edges'");
  }



  namespace
  {
    /** Distances from 0 to @p length: intervals that begin with @p first and grow by @p growth up
     * to
     * @p largest, all scaled alike so that they end there. */
    std::vector<double>
    growing(const double length, const double first, const double growth, const double largest)
    {
      std::vector<double> result = {0.};
      for (double size = first; result.back() < (1. - 1e-10) * length;
           size        = std::min(growth * size, largest))
        {
                 // Without growth the number of intervals is not bounded by a logarithm.
          check_number_of_cells(result.size());
          result.push_back(result.back() + size);
        }
      const double scale = length / result.back();
      for (double &x : result)
        x *= scale;
      result.back() = length;
      return result;
    }
  } // namespace



  std::vector<double>
  EdgeGrading::along(const double start, const double end, const double factor) const
  {
    const double        first = edge_size / factor, ratio = std::pow(growth, 1. / factor);
    std::vector<double> result = {start};
    const auto          up     = [&](const double from, const std::vector<double> &distances) {
      for (unsigned int i = 1; i < distances.size(); ++i)
        result.push_back(from + distances[i]);
    };
    const auto down_to = [&](const double to, const std::vector<double> &distances) {
      for (unsigned int i = distances.size() - 1; i-- > 0;)
        result.push_back(to - distances[i]);
    };
    for (unsigned int e = 0; e < edges.size(); ++e)
      {
        const double last   = e == 0 ? start : edges[e - 1];
        const double length = e == 0 ? edges[e] - start : (edges[e] - last) / 2.;
        const auto   half   = growing(length, first, ratio, largest / factor);
        // Between two edges cells grow from both up to the middle.
        if (e > 0)
          up(last, half);
        down_to(edges[e], half);
      }
    const double last = edges.back();
    up(last, growing(end - last, first, std::pow(outer_growth, 1. / factor), end - last));
    return result;
  }



  std::vector<double>
  EdgeGrading::down(const double height, const double factor) const
  {
    return growing(height, edge_size / factor, std::pow(layer_growth, 1. / factor), height);
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/exact_surface.h>

#include <deal.II/base/utilities.h>
#include <deal.II/grid/manifold_lib.h>

#include <sstream>
#include <stdexcept>

namespace Touchstone
{
  using namespace dealii;

  const char *const exact_surface_documentation =
    "'NAME: SHAPE WORDS; NAME: ...' with the shapes cylinder, cone and sphere and the words "
    "'axis x', 'axis y', 'axis z' or 'axis a b c' (direction), 'point x y z' (of the axis, "
    "or the centre; length), 'radius r' (for a cone at the point; length), 'slope m' (of a "
    "cone: growth of the radius along the axis; no unit), and 'outside' or 'inside', "
    "whether one looks at the surface from outside, as at a shaft, or from inside, as at a "
    "bore. E.g. 'bore: cylinder axis z radius 1 inside'. The name 'cells' gives the shape "
    "to all cells of the body, which then refine like those of a tube or ball.";

  namespace
  {
    template <int n>
    Tensor<1, n>
    numbers(std::istream &in, const std::string &word)
    {
      Tensor<1, n> values;
      for (unsigned int d = 0; d < n; ++d)
        // Messages name the word whose numbers are missing; the caller adds section and key.
        if (!(in >> values[d]))
          throw std::runtime_error("the word '" + word + "' needs " + std::to_string(n) +
                                   (n == 1 ? " number." : " numbers."));
      return values;
    }



    /** A unit vector from 'x', 'y', 'z' or three numbers; the next character decides which. */
    Tensor<1, 3>
    direction(std::istream &in)
    {
      const int first = (in >> std::ws).peek();
      if (first >= 'x' && first <= 'z')
        {
          in.get();
          Tensor<1, 3> axis;
          axis[first - 'x'] = 1.;
          return axis;
        }
      const Tensor<1, 3> axis = numbers<3>(in, "axis");
      if (axis.norm() == 0.)
        throw std::runtime_error("the axis has no direction.");
      return axis / axis.norm();
    }



    /** One surface from its words, in any order, with the manifold by which its mesh is refined. A
     * cone is refined in cylindrical coordinates: these average radius and position along the
     * axis, and the mean of two points of a cone is on the cone. */
    ExactSurface
    parse_one(const std::string &text)
    {
      std::istringstream in(text);
      std::string        shape;
      in >> shape;
      if (shape != "cylinder" && shape != "cone" && shape != "sphere")
        throw std::runtime_error("'" + shape + "' is not a cylinder, cone or sphere.");

      Point<3>     point;
      Tensor<1, 3> axis({0., 0., 1.});
      double       radius = 0., slope = 0.;
      bool         outside = true;
      // A word that another shape would need, as 'slope' for a cylinder, is an error like an
      // unknown one.
      for (std::string word; in >> word;)
        if (word == "axis" && shape != "sphere")
          axis = direction(in);
        else if (word == "point")
          point = Point<3>(numbers<3>(in, word));
        else if (word == "radius")
          radius = numbers<1>(in, word)[0];
        else if (word == "slope" && shape == "cone")
          slope = numbers<1>(in, word)[0];
        else if (word == "inside" || word == "outside")
          outside = word == "outside";
        else
          throw std::runtime_error("a " + shape + " does not know the word '" + word + "'.");
      if (!(radius > 0.))
        throw std::runtime_error("a " + shape + " needs 'radius' and a positive number.");

      if (shape == "sphere")
        return {make_sphere(point, radius, outside), std::make_shared<SphericalManifold<3>>(point)};
      return {make_cone(point, axis, radius, slope, outside),
              std::make_shared<CylindricalManifold<3>>(axis, point)};
    }
  } // namespace



  std::map<std::string, ExactSurface>
  parse_exact_surfaces(const std::string &text)
  {
    // Entries are separated by semicolons, each a name, a colon, and the words of a surface.
    std::map<std::string, ExactSurface> result;
    for (const std::string &entry : Utilities::split_string_list(text, ';'))
      {
        if (entry.empty())
          continue;
        const auto colon = entry.find(':');
        if (colon == std::string::npos)
          throw std::runtime_error("'" + entry + "' has no colon after a name.");
        const std::string name = Utilities::trim(entry.substr(0, colon));
        if (result.count(name) > 0)
          throw std::runtime_error("'" + name + "' is named twice.");
        result[name] = parse_one(entry.substr(colon + 1));
      }
    return result;
  }
} // namespace Touchstone

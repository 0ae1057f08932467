// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/mesh/body_mesh.h>
#include <touchstone/mesh/mesh_copies.h>
#include <touchstone/mesh/placed_geometry.h>
#include <touchstone/mesh/rotation.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace Touchstone
{
  using namespace dealii;

  PlacedGeometry::PlacedGeometry(const std::shared_ptr<Geometry> &inner)
    : inner(inner)
  {
  }



  void
  PlacedGeometry::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Scale",
                      scale,
                      "Factor of all lengths, or three of x, y, z, for bodies without exact curved "
                      "surfaces. 'Scale', 'Mirror', 'Rotate', 'Move' and 'Array' act in this "
                      "order. [no unit]",
                      Patterns::List(Patterns::Double(), 1, 3));
    prm.add_parameter("Mirror",
                      mirror,
                      "Mirror the body at the plane through the origin with this normal: 'x', 'y', "
                      "'z' or three numbers; empty: do not.",
                      Patterns::Anything());
    prm.add_parameter("Rotate axis",
                      axis,
                      "Direction of the axis of 'Rotate angle'; its length does not count.");
    prm.add_parameter("Rotate point", turned_about, "A point of that axis. [length]");
    prm.add_parameter("Rotate angle",
                      angle,
                      "Turn the body by this angle, counter-clockwise for one whom the axis points "
                      "at. [degrees]",
                      Patterns::Double());
    prm.add_parameter("Move", move, "Move the body by this vector. [length]");
    prm.add_parameter("Array",
                      copies,
                      "How many times the body is there, in x, y, z: one body of several parts "
                      "whose boundaries have the same names.",
                      Patterns::List(Patterns::Integer(1), 3, 3));
    prm.add_parameter("Array spacing",
                      spacing,
                      "From each of them to the next, in x, y, z. [length]");
  }



  Tensor<1, 3>
  PlacedGeometry::mirror_normal() const
  {
    Tensor<1, 3> normal;
    if (mirror == "x" || mirror == "y" || mirror == "z")
      normal[mirror[0] - 'x'] = 1.;
    else if (!mirror.empty())
      normal = Patterns::Tools::Convert<Tensor<1, 3>>::to_value(mirror);
    return normal;
  }



  bool
  PlacedGeometry::uniform() const
  {
    return std::all_of(scale.begin(), scale.end(), [this](const double s) {
      return s == scale[0];
    });
  }



  void
  PlacedGeometry::check(const std::string &section) const
  {
    const auto refuse = [&](const std::string &key,
                            const std::string &value,
                            const std::string &problem,
                            const std::string &remedy) {
      throw InputError(section, key, value, problem, remedy);
    };
    const std::string factors = Patterns::Tools::to_string(scale);
    if (scale.size() == 2)
      refuse("Scale", factors, "these are two numbers", "give one number or three");
    for (const double factor : scale)
      if (!(factor > 0.))
        refuse("Scale", factors, "must be positive", "use 'Mirror' to turn the body over");
    if (!mirror.empty() && mirror != "x" && mirror != "y" && mirror != "z" &&
        !Patterns::List(Patterns::Double(), 3, 3).match(mirror))
      refuse("Mirror", mirror, "this is no normal of a plane", "give x, y, z or three numbers");
    if (!mirror.empty() && mirror_normal().norm() == 0.)
      refuse("Mirror", mirror, "must not be zero", "give x, y, z or three numbers");
    if (axis.norm() == 0.)
      refuse("Rotate axis",
             Patterns::Tools::to_string(axis),
             "must not be zero",
             "give the direction of the axis");
    if (angle == 0. && axis != PlacedGeometry(nullptr).axis)
      refuse("Rotate axis",
             Patterns::Tools::to_string(axis),
             "means nothing without 'Rotate angle'",
             "give the angle or remove the axis");
    if (angle == 0. && turned_about.norm() > 0.)
      refuse("Rotate point",
             Patterns::Tools::to_string(turned_about),
             "means nothing without 'Rotate angle'",
             "give the angle or remove the point");
    for (unsigned int d = 0; d < 3; ++d)
      if ((copies[d] > 1) != (spacing[d] != 0.))
        refuse("Array spacing",
               Patterns::Tools::to_string(spacing),
               std::string(copies[d] > 1 ? "is zero where there are several bodies"
                                         : "is not zero where there is one body") +
                 ", in " + "xyz"[d],
               "give the distance from one to the next for each direction in which 'Array' is more "
               "than 1, and 0 else");
  }



  AffineMap
  PlacedGeometry::map() const
  {
    Tensor<2, 3> matrix;
    for (unsigned int d = 0; d < 3; ++d)
      matrix[d][d] = scale[scale.size() == 3 ? d : 0];
    if (!mirror.empty())
      {
        const Tensor<1, 3> n = mirror_normal() / mirror_normal().norm();
        matrix -= 2. * outer_product(n, n) * matrix;
      }
    Tensor<1, 3> shift = move;
    if (angle != 0.)
      {
        const Tensor<2, 3> turn = rotation(axis / axis.norm(), angle);
        matrix                  = turn * matrix;
        shift += turned_about - turn * turned_about;
      }
    return {matrix, shift};
  }



  BodyMesh
  PlacedGeometry::create(const double       factor,
                         const std::string &section,
                         const std::string &folder) const
  {
    BodyMesh     mesh = inner->create(factor, section, folder);
    Tensor<2, 3> none;
    for (unsigned int d = 0; d < 3; ++d)
      none[d][d] = 1.;
    const AffineMap place = map();
    // Not even round-off for bodies that stay as they are.
    if (place.linear() != none || place(Point<3>()) != Point<3>())
      {
        if (!uniform() && !mesh.surfaces.empty())
          throw InputError(section,
                           "Scale",
                           Patterns::Tools::to_string(scale),
                           "a body with exact curved surfaces cannot be stretched, for they would "
                           "not be spheres, cylinders or cones any more",
                           "give one number");
        move_mesh(place, uniform(), mesh);
      }

    const std::size_t n = std::size_t(copies[0]) * copies[1] * copies[2];
    if (n == 1)
      return mesh;
    check_number_of_cells(static_cast<double>(n) * mesh.cells.size());
    const BodyMesh original = mesh;
    for (std::size_t i = 1; i < n; ++i)
      {
        Tensor<1, 3> to;
        to[0] = spacing[0] * (i % copies[0]);
        to[1] = spacing[1] * (i / copies[0] % copies[1]);
        to[2] = spacing[2] * (i / copies[0] / copies[1]);
        append_copy(original, AffineMap(none, to), mesh);
      }
    double size = 0.;
    for (const Point<3> &x : original.vertices)
      size = std::max(size, x.distance(original.vertices[0]));
    if (vertices_coincide(mesh, original.vertices.size(), 1e-9 * size))
      throw InputError(section,
                       "Array spacing",
                       Patterns::Tools::to_string(spacing),
                       "the copies have vertices in common places, but would not be connected",
                       "leave a distance between them, or make one body of more cells");
    return mesh;
  }



  std::string
  PlacedGeometry::fingerprint(const std::string &folder) const
  {
    return inner->fingerprint(folder);
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/face_geometry.h>
#include <touchstone/contact/tolerances.h>

#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  FaceGeometry::FaceGeometry(const Face            &face,
                             const AnalyticSurface *exact,
                             const MasterNormal     kind)
    : data(face)
    , exact(exact)
    , kind(kind)
  {
    if (kind == MasterNormal::smoothed && exact == nullptr)
      patch.emplace(face);
    else if (face.degree == 1)
      {
        const auto components = [](const auto &values) {
          return [&values](const unsigned int m, const unsigned int d) { return values[m][d]; };
        };
        reference    = Bilinear<dim>(components(face.reference));
        displacement = Bilinear<dim>(components(face.displacement));
      }
  }



  FacePoint
  FaceGeometry::evaluate(const std::array<double, 2> &xi) const
  {
    if (patch)
      return patch->evaluate(xi);
    if (data.degree > 1)
      return Touchstone::evaluate(data, exact, xi);
    FacePoint                     point;
    Tensor<1, dim>                u;
    std::array<Tensor<1, dim>, 2> du;
    reference.evaluate(xi, point.x, point.tangents);
    displacement.evaluate(xi, u, du);
    if (exact)
      point.x = exact->project_with(point.x, point.tangents);
    point.x += u;
    for (unsigned int a = 0; a < 2; ++a)
      point.tangents[a] += du[a];
    return point;
  }



  Point<dim>
  FaceGeometry::position(const std::array<double, 2> &xi, const FaceShapes &shapes) const
  {
    if (patch)
      return patch->evaluate(xi).x;
    Point<dim>     x;
    Tensor<1, dim> u;
    if (data.degree == 1)
      {
        reference.evaluate(xi, x);
        displacement.evaluate(xi, u);
      }
    else
      for (unsigned int m = 0; m < data.n_nodes(); ++m)
        {
          x += shapes.value[m] * data.reference[m];
          u += shapes.value[m] * data.displacement[m];
        }
    return (exact ? exact->project(x) : x) + u;
  }



  std::pair<Point<dim>, Tensor<1, dim>>
  FaceGeometry::position_and_normal(const std::array<double, 2> &xi, const FaceShapes &shapes) const
  {
    const FacePoint point =
      patch || data.degree == 1 ? evaluate(xi) : Touchstone::evaluate(data, exact, shapes);
    return {point.x, interpolates_normals() ? interpolated_normal(shapes, point) : point.normal()};
  }



  std::array<Tensor<1, dim>, 3>
  FaceGeometry::second_derivatives(const std::array<double, 2> &xi) const
  {
    if (patch)
      return patch->second_derivatives(xi);
    const auto                    hessians = shape_hessians(data.degree, xi);
    std::array<Tensor<1, dim>, 3> of_reference, result;
    for (unsigned int m = 0; m < data.n_nodes(); ++m)
      for (unsigned int a = 0; a < 3; ++a)
        {
          of_reference[a] += hessians[m][a] * data.reference[m];
          result[a] += hessians[m][a] * data.displacement[m];
        }
    if (exact)
      {
        // d/dxi_b (grad P T_a) = (grad P)' [T_b] T_a + grad P T_a,b.
        const FaceShapes shapes(data.degree, xi);
        Point<dim>       x;
        Tensor<1, dim>   t[2];
        for (unsigned int m = 0; m < data.n_nodes(); ++m)
          {
            x += shapes.value[m] * data.reference[m];
            for (unsigned int a = 0; a < 2; ++a)
              t[a] += shapes.gradient[m][a] * data.reference[m];
          }
        const Tensor<2, dim> gradient = exact->projection_gradient(x);
        const double         step     = 1e-5; // in xi, where a face measures 2
        Tensor<2, dim>       change[2];
        for (unsigned int b = 0; b < 2; ++b)
          change[b] = (exact->projection_gradient(x + step * t[b]) -
                       exact->projection_gradient(x - step * t[b])) /
                      (2. * step);
        result[0] += change[0] * t[0];
        result[1] += change[1] * t[0];
        result[2] += change[1] * t[1];
        for (unsigned int a = 0; a < 3; ++a)
          result[a] += gradient * of_reference[a];
      }
    else
      for (unsigned int a = 0; a < 3; ++a)
        result[a] += of_reference[a];
    return result;
  }



  Tensor<1, dim>
  FaceGeometry::interpolated_normal(const FaceShapes &shapes, const FacePoint &point) const
  {
    Tensor<1, dim> result;
    if (!exact)
      for (unsigned int m = 0; m < data.n_nodes(); ++m)
        result += shapes.value[m] * data.normals[m];
    else
      {
        result = point.normal();
        for (unsigned int m = 0; m < data.n_nodes(); ++m)
          result += shapes.value[m] * (data.normals[m] - data.own_normals[m]);
      }
    return result / result.norm();
  }



  Tensor<1, dim>
  FaceGeometry::normal(const std::array<double, 2> &xi) const
  {
    return position_and_normal(xi, FaceShapes(data.degree, xi)).second;
  }



  bool
  FaceGeometry::sharp(const std::array<double, 2> &xi, Tensor<1, dim> &mean) const
  {
    const FaceShapes shapes(data.degree, xi);
    mean = Tensor<1, dim>();
    for (unsigned int m = 0; m < data.n_nodes(); ++m)
      mean += shapes.value[m] * data.edge_normals[m];
    return interpolated_normal(shapes, evaluate(xi)) * mean <
           Tolerances::same_normal_cosine * mean.norm();
  }
} // namespace Touchstone

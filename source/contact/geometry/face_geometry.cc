// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/face_geometry.h>
#include <touchstone/contact/tolerances.h>

#include <cmath>

// The surface over a face to which gaps are measured: facet, exact surface or Gregory patch, and
// its normal by the key "Master normal" (doc/theory.md 4). The position on bilinear faces has its
// own path without shape functions, since searches evaluate it most often.
namespace Touchstone
{
  using namespace dealii;

  FaceGeometry::FaceGeometry(const Face            &face,
                             const AnalyticSurface *exact,
                             const MasterNormal     kind,
                             const Arch             arch)
    : data(face)
    , exact(exact)
    , kind(kind)
  {
    // Where the exact surface is known a patch would only approximate it.
    if (kind == MasterNormal::smoothed && exact == nullptr)
      {
        patch.emplace(face);
        return;
      }
    if (exact)
      {
        rotation = facet_rotation(face);
        moved    = relative_displacement(face, rotation);
        if (arch == Arch::with_normals)
          following.emplace(face, rotation);
      }
    else
      moved = face.displacement;
    if (face.degree == 1)
      {
        const auto components = [](const auto &values) {
          return [&values](const unsigned int m, const unsigned int d) { return values[m][d]; };
        };
        reference    = Bilinear<dim>(components(face.reference));
        displacement = Bilinear<dim>(components(moved));
      }
  }



  FacePoint
  FaceGeometry::evaluate(const std::array<double, 2> &xi) const
  {
    // A Gregory patch has its displacement in its control points.
    if (patch)
      return patch->evaluate(xi);
    FacePoint point = on_facet(xi);
    if (following)
      FollowingArch::add(following->at(FaceShapes(data.degree, xi), point), point);
    return point;
  }



  FollowingArch::Part
  FaceGeometry::following_part(const FaceShapes &shapes, const std::array<double, 2> &xi) const
  {
    return following ? following->at(shapes, on_facet(xi)) : FollowingArch::Part();
  }



  FacePoint
  FaceGeometry::on_facet(const std::array<double, 2> &xi) const
  {
    // Reference position and displacement are evaluated apart, as only the former is projected onto
    // the exact surface and turned.
    FacePoint                     point;
    Tensor<1, dim>                u;
    std::array<Tensor<1, dim>, 2> du;
    if (data.degree == 1)
      {
        reference.evaluate(xi, point.x, point.tangents);
        displacement.evaluate(xi, u, du);
      }
    else
      {
        const FaceShapes shapes(data.degree, xi);
        for (unsigned int m = 0; m < data.n_nodes(); ++m)
          {
            point.x += shapes.value[m] * data.reference[m];
            u += shapes.value[m] * moved[m];
            for (unsigned int a = 0; a < 2; ++a)
              {
                point.tangents[a] += shapes.gradient[m][a] * data.reference[m];
                du[a] += shapes.gradient[m][a] * moved[m];
              }
          }
      }
    // Project the reference position, map its tangents and turn both before the displacement is
    // added: equation (8) of doc/theory.md 4.
    if (exact)
      {
        point.x = Point<dim>(rotation * exact->project_with(point.x, point.tangents));
        for (Tensor<1, dim> &tangent : point.tangents)
          tangent = rotation * tangent;
      }
    point.x += u;
    for (unsigned int a = 0; a < 2; ++a)
      point.tangents[a] += du[a];
    return point;
  }



  Point<dim>
  FaceGeometry::position(const std::array<double, 2> &xi, const FaceShapes &shapes) const
  {
    if (follows_normals())
      return evaluate(xi).x;
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
          u += shapes.value[m] * moved[m];
        }
    return (exact ? Point<dim>(rotation * exact->project(x)) : x) + u;
  }



  std::array<Tensor<1, dim>, 3>
  FaceGeometry::second_derivatives(const std::array<double, 2> &xi) const
  {
    if (patch)
      return patch->second_derivatives(xi);
    const auto hessians = shape_hessians(data.degree, xi);
    // 11, 12, 22 of the reference position and of the displacement.
    std::array<Tensor<1, dim>, 3> of_reference, result;
    for (unsigned int m = 0; m < data.n_nodes(); ++m)
      for (unsigned int a = 0; a < 3; ++a)
        {
          of_reference[a] += hessians[m][a] * data.reference[m];
          result[a] += hessians[m][a] * moved[m];
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
        // A central difference, since surfaces give their projection and its gradient but no second
        // derivative. Its error is of the order of the square of the step.
        const double   step = 1e-5; // in xi, where a face measures 2
        Tensor<2, dim> change[2];
        for (unsigned int b = 0; b < 2; ++b)
          change[b] = (exact->projection_gradient(x + step * t[b]) -
                       exact->projection_gradient(x - step * t[b])) /
                      (2. * step);
        // The mixed derivative from one order of differentiation only; both agree up to the error
        // of the difference.
        const Tensor<1, dim> curved[3] = {change[0] * t[0], change[1] * t[0], change[1] * t[1]};
        for (unsigned int a = 0; a < 3; ++a)
          result[a] += rotation * (curved[a] + gradient * of_reference[a]);
        if (following)
          {
            const auto motion = following->second_derivatives(xi, on_facet(xi), result);
            for (unsigned int a = 0; a < 3; ++a)
              result[a] += motion[a];
          }
      }
    else
      for (unsigned int a = 0; a < 3; ++a)
        result[a] += of_reference[a];
    return result;
  }



  const FaceGeometry::NodeNormals &
  FaceGeometry::own_normals() const
  {
    if (!following)
      return data.own_normals;
    if (!following_normals)
      {
        following_normals.emplace();
        for (unsigned int m = 0; m < data.n_nodes(); ++m)
          (*following_normals)[m] = evaluate(node_coordinates(data, m)).normal();
      }
    return *following_normals;
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
        // The own normal of the moved exact surface jumps at the edges between faces, because
        // displacements are only continuous. Adding the interpolated difference to the averaged
        // nodal normals makes it continuous (doc/theory.md 4, "Normals").
        const NodeNormals &own = own_normals();
        result                 = point.normal();
        for (unsigned int m = 0; m < data.n_nodes(); ++m)
          result += shapes.value[m] * (data.normals[m] - own[m]);
      }
    return result / result.norm();
  }



  Tensor<1, dim>
  FaceGeometry::normal(const std::array<double, 2> &xi) const
  {
    return normal(FaceShapes(data.degree, xi), evaluate(xi));
  }



  bool
  FaceGeometry::sharp(const std::array<double, 2> &xi, Tensor<1, dim> &mean) const
  {
    const FaceShapes shapes(data.degree, xi);
    mean = Tensor<1, dim>();
    for (unsigned int m = 0; m < data.n_nodes(); ++m)
      mean += shapes.value[m] * data.edge_normals[m];
    // At a sharp edge the averages for this face leave out the faces beyond the edge, so its
    // interpolated normal differs from the mean over all faces (the pseudonormal); elsewhere both
    // are the same.
    return interpolated_normal(shapes, evaluate(xi)) * mean <
           Tolerances::same_normal_cosine * mean.norm();
  }
} // namespace Touchstone

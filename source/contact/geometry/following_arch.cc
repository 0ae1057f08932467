// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/following_arch.h>

// Surfaces that are continuous over the edges of faces: the arch over a facet turns with the
// normals that faces have in common (doc/theory.md 4, equation (8)).
namespace Touchstone
{
  using namespace dealii;

  FollowingArch::FollowingArch(const Face &face, const Tensor<2, dim> &rotation)
    : face(&face)
  {
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      turned[m] = rotation * face.made_normals[m];
  }



  FollowingArch::Part
  FollowingArch::at(const FaceShapes &shapes, const FacePoint &on_facet) const
  {
    Part result;
    result.arch    = on_facet.x;
    result.arch_xi = on_facet.tangents;
    for (unsigned int m = 0; m < face->n_nodes(); ++m)
      {
        const Point<dim> x = face->position(m);
        result.arch -= shapes.value[m] * x;
        result.normal += shapes.value[m] * face->normals[m];
        result.turned += shapes.value[m] * turned[m];
        for (unsigned int b = 0; b < 2; ++b)
          {
            result.arch_xi[b] -= shapes.gradient[m][b] * x;
            result.normal_xi[b] += shapes.gradient[m][b] * face->normals[m];
            result.turned_xi[b] += shapes.gradient[m][b] * turned[m];
          }
      }
    const double square = result.turned.norm_square();
    // Degenerate faces have no normals.
    if (square == 0.)
      return {};
    result.value = result.arch * result.turned / square;
    for (unsigned int b = 0; b < 2; ++b)
      result.value_xi[b] = (result.arch_xi[b] * result.turned + result.arch * result.turned_xi[b] -
                            2. * result.value * (result.turned * result.turned_xi[b])) /
                           square;
    return result;
  }



  void
  FollowingArch::add(const Part &part, FacePoint &point)
  {
    const Tensor<1, dim> motion = part.normal - part.turned;
    point.x += part.value * motion;
    for (unsigned int b = 0; b < 2; ++b)
      point.tangents[b] +=
        part.value_xi[b] * motion + part.value * (part.normal_xi[b] - part.turned_xi[b]);
  }



  std::array<Tensor<1, dim>, 3>
  FollowingArch::second_derivatives(const std::array<double, 2>         &xi,
                                    const FacePoint                     &on_facet,
                                    const std::array<Tensor<1, dim>, 3> &second) const
  {
    const FaceShapes                    shapes(face->degree, xi);
    const auto                          hessians  = shape_hessians(face->degree, xi);
    const Part                          part      = at(shapes, on_facet);
    const Tensor<1, dim>               &along     = part.turned;
    const double                        square    = along.norm_square();
    const std::array<unsigned int, 2>   of[3]     = {{{0, 0}}, {{0, 1}}, {{1, 1}}};
    const std::array<Tensor<1, dim>, 2> motion_xi = {
      {part.normal_xi[0] - part.turned_xi[0], part.normal_xi[1] - part.turned_xi[1]}};
    std::array<Tensor<1, dim>, 3> result;
    if (square == 0.)
      return result;
    for (unsigned int i = 0; i < 3; ++i)
      {
        const auto [b, c]        = of[i];
        Tensor<1, dim> arch_xixi = second[i], along_xixi, normal_xixi;
        for (unsigned int m = 0; m < face->n_nodes(); ++m)
          {
            arch_xixi -= hessians[m][i] * face->position(m);
            along_xixi += hessians[m][i] * turned[m];
            normal_xixi += hessians[m][i] * face->normals[m];
          }
        // Of a = p / q, p = A . N and q = N . N: a,bc q = p,bc - a,b q,c - a,c q,b - a q,bc.
        const Tensor<1, dim> &along_b = part.turned_xi[b], &along_c = part.turned_xi[c];
        const double p = arch_xixi * along + part.arch_xi[b] * along_c + part.arch_xi[c] * along_b +
                         part.arch * along_xixi,
                     q     = 2. * (along_b * along_c + along * along_xixi),
                     value = (p - 2. * part.value_xi[b] * (along * along_c) -
                              2. * part.value_xi[c] * (along * along_b) - part.value * q) /
                             square;
        result[i] = value * (part.normal - along) + part.value_xi[b] * motion_xi[c] +
                    part.value_xi[c] * motion_xi[b] + part.value * (normal_xixi - along_xixi);
      }
    return result;
  }
} // namespace Touchstone

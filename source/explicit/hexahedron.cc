// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/hexahedron.h>

#include <algorithm>
#include <cmath>

// Shapes of hexahedra of degree 1, with arithmetic that depends on the cell alone.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Of Gauss's rule with two points, on [0, 1]. */
    double
    coordinate(const unsigned int side)
    {
      static const double distance = 0.5 / std::sqrt(3.);
      return side == 0 ? 0.5 - distance : 0.5 + distance;
    }

    double
    linear(const unsigned int side, const double x)
    {
      return side == 0 ? 1. - x : x;
    }

    /** Shape @p a, or its derivative by coordinate @p derivative, at @p x of the unit cell. */
    double
    evaluate(const unsigned int a, const std::array<double, dim> &x, const int derivative)
    {
      double product = 1.;
      for (int d = 0; d < dim; ++d)
        {
          const unsigned int side = (a >> d) & 1;
          product *= d == derivative ? (side == 0 ? -1. : 1.) : linear(side, x[d]);
        }
      return product;
    }

    std::array<double, dim>
    point(const unsigned int q)
    {
      return {{coordinate(q & 1), coordinate((q >> 1) & 1), coordinate((q >> 2) & 1)}};
    }

    /** Values and derivatives at the points, and derivatives at the centre. */
    struct Tables
    {
      double value[8][8], derivative[8][8][dim], centre[8][dim];

      Tables()
      {
        for (unsigned int a = 0; a < 8; ++a)
          for (unsigned int q = 0; q < 8; ++q)
            {
              value[q][a] = evaluate(a, point(q), -1);
              for (int d = 0; d < dim; ++d)
                {
                  derivative[q][a][d] = evaluate(a, point(q), d);
                  centre[a][d]        = evaluate(a, {{0.5, 0.5, 0.5}}, d);
                }
            }
      }
    };

    const Tables &
    tables()
    {
      static const Tables all;
      return all;
    }

    Tensor<2, dim>
    jacobian(const Hexahedron::Corners &x, const double (&derivative)[8][dim])
    {
      Tensor<2, dim> result;
      for (unsigned int a = 0; a < 8; ++a)
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int d = 0; d < dim; ++d)
            result[i][d] += x[a][i] * derivative[a][d];
      return result;
    }
  } // namespace



  double
  Hexahedron::shape(const unsigned int q, const unsigned int a)
  {
    return tables().value[q][a];
  }



  double
  Hexahedron::reinit(const Corners &positions)
  {
    double smallest = std::numeric_limits<double>::max();
    total           = 0.;
    for (unsigned int q = 0; q < n_points; ++q)
      {
        const Tensor<2, dim> J = jacobian(positions, tables().derivative[q]);
        determinants[q]        = determinant(J);
        smallest               = std::min(smallest, determinants[q]);
        weights[q]             = 0.125 * determinants[q];
        total += weights[q];
        const Tensor<2, dim> inverse = inverses[q] = invert(J);
        for (unsigned int a = 0; a < n_nodes; ++a)
          for (unsigned int i = 0; i < dim; ++i)
            gradients[q][a][i] = tables().derivative[q][a][0] * inverse[0][i] +
                                 tables().derivative[q][a][1] * inverse[1][i] +
                                 tables().derivative[q][a][2] * inverse[2][i];
      }
    const Tensor<2, dim> J = jacobian(positions, tables().centre);
    centre_determinant     = determinant(J);
    centre_inverse         = invert(J);
    return smallest;
  }



  Tensor<1, dim>
  Hexahedron::mode_gradient(const unsigned int q, const unsigned int k) const
  {
    // Mode k is 1 - (2 x_k - 1)^2; with the Jacobian of the centre, and scaled by the ratio of
    // determinants, its gradient integrates to zero (doc/theory.md 2.1).
    return centre_determinant / determinants[q] * (-4.) * (2. * point(q)[k] - 1.) *
           centre_inverse[k];
  }



  Tensor<1, dim>
  Hexahedron::mean_gradient(const unsigned int a) const
  {
    Tensor<1, dim> sum;
    for (unsigned int q = 0; q < n_points; ++q)
      sum += weights[q] / total * gradients[q][a];
    return sum;
  }



  double
  Hexahedron::nodal_volume(const unsigned int a) const
  {
    double sum = 0.;
    for (unsigned int q = 0; q < n_points; ++q)
      sum += weights[q] * shape(q, a);
    return sum;
  }



  Hexahedron::Corners
  corners(const NodeMap &map, const NodeMap::CellNodes &nodes, const NodeField *u)
  {
    Hexahedron::Corners result;
    for (unsigned int a = 0; a < Hexahedron::n_nodes; ++a)
      {
        result[a] = map.positions()[nodes[a]];
        if (u != nullptr)
          result[a] += (*u)[nodes[a]];
      }
    return result;
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/gregory_patch.h>
#include <touchstone/contact/geometry/vector3.h>

#include <Sacado.hpp>
#include <cmath>

// Gregory patches: smooth surfaces over bilinear faces that meet with a common tangent plane at
// their edges (doc/theory.md 4, "Smoothing"; Chiyokura and Kimura 1983). The control points are
// templates of the number type, so that the same code gives positions and, with Sacado numbers,
// their derivatives.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Inner coefficients D_1, D_2 of the derivative across an edge, a cubic
     * between its values D_0 and D_3 at the ends of the edge: the combination
     * k g + h c' of the edge's own directions c' and g, with k and h linear.
     * @param c Control points of the edge. @param n Normals at its ends. */
    template <typename Number>
    std::array<Vector3<Number>, 2>
    inner_coefficients(const std::array<Vector3<Number>, 4> &c,
                       const std::array<Vector3<Number>, 2> &n,
                       const Vector3<Number>                &d0,
                       const Vector3<Number>                &d3)
    {
      // The derivative c' of the cubic boundary curve is a quadratic Bezier curve with these
      // coefficients.
      Vector3<Number> along[3];
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int d = 0; d < dim; ++d)
          along[i][d] = 3. * (c[i + 1][d] - c[i][d]);
      // In the tangent plane, perpendicular to the curve: g = n x c' at both ends. The given
      // derivatives d0 and d3 across the edge are split into components along g and c', which k and
      // h interpolate linearly.
      const Vector3<Number> g0 = cross(n[0], along[0]), g1 = cross(n[1], along[2]);
      const Number          k0 = dot(d0, g0) / dot(g0, g0);
      const Number          k1 = dot(d3, g1) / dot(g1, g1);
      const Number          h0 = dot(d0, along[0]) / dot(along[0], along[0]);
      const Number          h1 = dot(d3, along[2]) / dot(along[2], along[2]);

      std::array<Vector3<Number>, 2> result;
      for (unsigned int d = 0; d < dim; ++d)
        {
          // Bernstein coefficients 1 and 2 of the cubic k g + h c': a product of a linear and a
          // linear (k g) or quadratic (h c') function, raised to degree 3.
          const Number mixed = k0 * g1[d] + k1 * g0[d];
          result[0][d]       = (k0 * g0[d] + mixed + 2. * h0 * along[1][d] + h1 * along[0][d]) / 3.;
          result[1][d]       = (k1 * g1[d] + mixed + 2. * h1 * along[1][d] + h0 * along[2][d]) / 3.;
        }
      return result;
    }

    /** Index of the control point (i, j). The inner ones that belong to the edges
     * xi_2 = +-1 are numbered like this, those of the edges xi_1 = +-1 from 16. */
    constexpr unsigned int
    control(const unsigned int i, const unsigned int j)
    {
      return i + 4 * j;
    }

    constexpr unsigned int
    second_control(const unsigned int i, const unsigned int j)
    {
      return 16 + (i - 1) + 2 * (j - 1);
    }

    /** The unit vector @p n mirrored along the chord from @p a to @p b, as normals of a circle
     * are at both ends of a chord. */
    template <typename Number>
    Vector3<Number>
    mirrored(const Vector3<Number> &n, const Vector3<Number> &a, const Vector3<Number> &b)
    {
      Vector3<Number> chord = b;
      for (unsigned int d = 0; d < dim; ++d)
        chord[d] -= a[d];
      // Householder reflection: a circle has its normals at the ends of a chord mirrored along it.
      const Number    along  = 2. * dot(n, chord) / dot(chord, chord);
      Vector3<Number> result = n;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] -= along * chord[d];
      return result;
    }

    /** At the edge of the whole surface nodal normals are averages over faces on one side only and
     * wrong by half the angle between faces. There the normal of the next node inward
     * is mirrored, as on a circle; neighbours along the edge do the same. Where two such edges
     * meet, the normal of the node across is mirrored over one of its neighbours and over the
     * other: the mean of both prefers no direction of the mesh. */
    template <typename Number>
    std::array<Vector3<Number>, 4>
    mirror_at_outer_edges(const unsigned int                    outer_edges,
                          const std::array<Vector3<Number>, 4> &x,
                          const std::array<Vector3<Number>, 4> &n)
    {
      std::array<Vector3<Number>, 4> result = n;
      for (unsigned int m = 0; m < 4; ++m)
        {
          // The nodes inward of the edges xi_1 = +-1 and xi_2 = +-1.
          const unsigned int first = m ^ 1u, second = m ^ 2u, across = m ^ 3u;
          const bool         at_first = outer_edges & (1u << (m % 2)),
                     at_second        = outer_edges & (4u << (m / 2));
          // Where both edges of a strip are outer the facet's normal stays.
          if (at_first && at_second)
            {
              const auto over = [&](const unsigned int between) {
                return mirrored(mirrored(n[across], x[between], x[across]), x[m], x[between]);
              };
              const Vector3<Number> a = over(first), b = over(second);
              for (unsigned int d = 0; d < dim; ++d)
                result[m][d] = a[d] + b[d];
              using std::sqrt;
              const Number length = sqrt(dot(result[m], result[m]));
              for (unsigned int d = 0; d < dim; ++d)
                result[m][d] /= length;
            }
          else if (at_first || at_second)
            {
              const unsigned int inward = at_first ? first : second;
              result[m]                 = mirrored(n[inward], x[m], x[inward]);
            }
        }
      return result;
    }

    template <typename Number>
    std::array<Vector3<Number>, GregoryPatch::n_control_points>
    control_points(const std::array<Vector3<Number>, 4> &x, const std::array<Vector3<Number>, 4> &n)
    {
      std::array<Vector3<Number>, GregoryPatch::n_control_points> p;
      // Boundary curves, for each of two directions and two edges: from node a to b.
      const auto index = [](const bool along_first, const unsigned int i, const unsigned int j) {
        return along_first ? control(i, j) : control(j, i);
      };
      for (const bool first : {true, false})
        for (const unsigned int side : {0, 1})
          {
            const unsigned int a     = first ? 2 * side : side;
            const unsigned int b     = first ? a + 1 : a + 2;
            const unsigned int row   = 3 * side;
            Vector3<Number>    chord = x[b];
            for (unsigned int d = 0; d < dim; ++d)
              chord[d] -= x[a][d];
            const Number at_a = dot(chord, n[a]), at_b = dot(chord, n[b]);
            for (unsigned int d = 0; d < dim; ++d)
              {
                // A cubic Bezier curve: its inner control points are a third of the chord,
                // projected on the tangent planes of the nodes, from the ends.
                p[index(first, 0, row)][d] = x[a][d];
                p[index(first, 1, row)][d] = x[a][d] + (chord[d] - at_a * n[a][d]) / 3.;
                p[index(first, 2, row)][d] = x[b][d] - (chord[d] - at_b * n[b][d]) / 3.;
                p[index(first, 3, row)][d] = x[b][d];
              }
          }
      for (const bool first : {true, false})
        for (const unsigned int side : {0, 1})
          {
            const unsigned int             a   = first ? 2 * side : side;
            const unsigned int             b   = first ? a + 1 : a + 2;
            const unsigned int             row = 3 * side, inner = 1 + side;
            std::array<Vector3<Number>, 4> c;
            for (unsigned int i = 0; i < 4; ++i)
              c[i] = p[index(first, i, row)];
            // Derivatives across the edge at its ends are those of the two boundary curves that
            // leave it there.
            Vector3<Number> d0 = p[index(first, 0, inner)], d3 = p[index(first, 3, inner)];
            for (unsigned int d = 0; d < dim; ++d)
              {
                d0[d] = 3. * (d0[d] - c[0][d]);
                d3[d] = 3. * (d3[d] - c[3][d]);
              }
            const auto across =
              inner_coefficients<Number>(c, std::array<Vector3<Number>, 2>{{n[a], n[b]}}, d0, d3);
            for (const unsigned int i : {1, 2})
              {
                // Each inner control point exists twice, once for either adjacent edge, since both
                // conditions of tangent planes cannot be met by one point.
                auto &point = p[first ? control(i, inner) : second_control(inner, i)];
                for (unsigned int d = 0; d < dim; ++d)
                  point[d] = c[i][d] + across[i - 1][d] / 3.;
              }
          }
      return p;
    }
  } // namespace



  GregoryPatch::GregoryPatch(const Face &face)
  {
    std::array<Vector3<double>, 4> x, n;
    for (unsigned int m = 0; m < 4; ++m)
      for (unsigned int d = 0; d < dim; ++d)
        {
          x[m][d] = face.reference[m][d] + face.displacement[m][d];
          n[m][d] = face.normals[m][d];
        }
    const auto p = control_points(x, mirror_at_outer_edges(face.ends(), x, n));
    for (unsigned int k = 0; k < n_control_points; ++k)
      for (unsigned int d = 0; d < dim; ++d)
        points[k][d] = p[k][d];
  }



  GregoryPatch::Derivative
  GregoryPatch::differentiate(const Face &face)
  {
    // Forward derivatives by four positions and four normals.
    constexpr int n_variables = 8 * dim;
    using Number              = Sacado::Fad::SFad<double, n_variables>;
    std::array<Vector3<Number>, 4> x, n;
    for (unsigned int m = 0; m < 4; ++m)
      for (unsigned int d = 0; d < dim; ++d)
        {
          x[m][d] =
            Number(n_variables, dim * m + d, face.reference[m][d] + face.displacement[m][d]);
          n[m][d] = Number(n_variables, dim * (4 + m) + d, face.normals[m][d]);
        }
    const auto p = control_points(x, mirror_at_outer_edges(face.ends(), x, n));
    Derivative result;
    for (unsigned int k = 0; k < n_control_points; ++k)
      for (unsigned int m = 0; m < 8; ++m)
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            result[k][m][c][d] = p[k][c].fastAccessDx(dim * m + d);
    return result;
  }



  GregoryPatch::Basis::Basis(const std::array<double, 2> &xi)
  {
    // Bernstein polynomials of [0,1] with derivatives.
    double b[2][4], db[2][4], ddb[2][4], t[2];
    for (unsigned int a = 0; a < 2; ++a)
      {
        t[a]           = 0.5 * (1. + xi[a]);
        const double u = t[a], w = 1. - t[a];
        b[a][0]   = w * w * w;
        b[a][1]   = 3. * u * w * w;
        b[a][2]   = 3. * u * u * w;
        b[a][3]   = u * u * u;
        db[a][0]  = -3. * w * w;
        db[a][1]  = 3. * w * w - 6. * u * w;
        db[a][2]  = 6. * u * w - 3. * u * u;
        db[a][3]  = 3. * u * u;
        ddb[a][0] = 6. * w;
        ddb[a][1] = 6. * u - 12. * w;
        ddb[a][2] = 6. * w - 12. * u;
        ddb[a][3] = 6. * u;
      }
    for (unsigned int j = 0; j < 4; ++j)
      for (unsigned int i = 0; i < 4; ++i)
        {
          // d/dxi is half of d/du.
          const double f  = b[0][i] * b[1][j];
          const double f1 = 0.5 * db[0][i] * b[1][j], f2 = 0.5 * b[0][i] * db[1][j];
          const double f11 = 0.25 * ddb[0][i] * b[1][j], f12 = 0.25 * db[0][i] * db[1][j],
                       f22 = 0.25 * b[0][i] * ddb[1][j];
          const bool inner = (i == 1 || i == 2) && (j == 1 || j == 2);
          if (!inner)
            {
              value[control(i, j)]    = f;
              gradient[control(i, j)] = {{f1, f2}};
              hessian[control(i, j)]  = {{f11, f12, f22}};
              continue;
            }
          // Share of the edge xi_2 = +-1: p / (p + q) with p, q the distances from
          // the corner along both edges.
          const double sign[2] = {i == 1 ? 0.5 : -0.5, j == 1 ? 0.5 : -0.5};
          const double p = i == 1 ? t[0] : 1. - t[0], q = j == 1 ? t[1] : 1. - t[1];
          const double s = p + q;
          // At a corner r has no limit, but its f vanishes there with its first derivatives: the
          // mean is as good as any value.
          double r = 0.5, r1 = 0., r2 = 0., r11 = 0., r12 = 0., r22 = 0.;
          if (s > 0.)
            {
              r   = p / s;
              r1  = sign[0] * q / (s * s);
              r2  = -sign[1] * p / (s * s);
              r11 = -2. * sign[0] * sign[0] * q / (s * s * s);
              r12 = sign[0] * sign[1] * (p - q) / (s * s * s);
              r22 = 2. * sign[1] * sign[1] * p / (s * s * s);
            }
          const unsigned int k = control(i, j), l = second_control(i, j);
          // The two copies of an inner control point share its Bernstein polynomial f with the
          // rational weights r and 1 - r; product rule for the derivatives.
          value[k]    = r * f;
          gradient[k] = {{r * f1 + r1 * f, r * f2 + r2 * f}};
          hessian[k]  = {{r * f11 + 2. * r1 * f1 + r11 * f,
                          r * f12 + r1 * f2 + r2 * f1 + r12 * f,
                          r * f22 + 2. * r2 * f2 + r22 * f}};
          value[l]    = f - value[k];
          gradient[l] = {{f1 - gradient[k][0], f2 - gradient[k][1]}};
          hessian[l]  = {{f11 - hessian[k][0], f12 - hessian[k][1], f22 - hessian[k][2]}};
        }
  }



  FacePoint
  GregoryPatch::evaluate(const std::array<double, 2> &xi) const
  {
    const Basis basis(xi);
    FacePoint   result;
    for (unsigned int k = 0; k < n_control_points; ++k)
      {
        result.x += basis.value[k] * points[k];
        for (unsigned int a = 0; a < 2; ++a)
          result.tangents[a] += basis.gradient[k][a] * points[k];
      }
    return result;
  }



  std::array<Tensor<1, dim>, 3>
  GregoryPatch::second_derivatives(const std::array<double, 2> &xi) const
  {
    const Basis                   basis(xi);
    std::array<Tensor<1, dim>, 3> result;
    for (unsigned int k = 0; k < n_control_points; ++k)
      for (unsigned int a = 0; a < 3; ++a)
        result[a] += basis.hessian[k][a] * points[k];
    return result;
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/vectorised.h>
#include <touchstone/explicit/general/moving_faces.h>

// Directions that tell faces and nodes apart, of four corners or four triangles at once
// (doc/general_contact.md, section 2).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    using FourNumbers = Simd<double, 4>::type;
    /** By axis. */
    struct Vectors
    {
      FourNumbers c[dim];

      __attribute__((always_inline)) inline FourNumbers &
      operator[](const unsigned int d)
      {
        return c[d];
      }

      __attribute__((always_inline)) inline const FourNumbers &
      operator[](const unsigned int d) const
      {
        return c[d];
      }
    };

    __attribute__((always_inline)) inline FourNumbers
    lesser(const FourNumbers &a, const FourNumbers &b)
    {
      return a < b ? a : b;
    }

    __attribute__((always_inline)) inline FourNumbers
    greater(const FourNumbers &a, const FourNumbers &b)
    {
      return a > b ? a : b;
    }

    __attribute__((always_inline)) inline double
    most_of(const FourNumbers &a)
    {
      const FourNumbers b = greater(a, TOUCHSTONE_SHUFFLE(a, a, 2, 3, 0, 1));
      return greater(b, TOUCHSTONE_SHUFFLE(b, b, 1, 0, 3, 2))[0];
    }

    /** Corners seen from a point. */
    template <class Origin>
    __attribute__((always_inline)) inline void
    seen_from(const Origin &origin, const std::array<std::array<double, 4>, dim> &x, Vectors &to)
    {
      for (unsigned int d = 0; d < dim; ++d)
        to[d] = *reinterpret_cast<const FourNumbers *>(x[d].data()) - origin[d];
    }

    /** A direction is of numbers, or of vectors that have one for each entry. */
    template <class Direction>
    __attribute__((always_inline)) inline FourNumbers
    along(const Direction &d, const Vectors &x)
    {
      return d[0] * x[0] + d[1] * x[1] + d[2] * x[2];
    }

    __attribute__((always_inline)) inline void
    widen(FourNumbers &extent, const Vectors &x)
    {
      for (unsigned int d = 0; d < dim; ++d)
        extent = greater(extent, greater(x[d], -x[d]));
    }

    __attribute__((always_inline)) inline void
    cross(const Vectors &a, const Vectors &b, Vectors &result)
    {
      result[0] = a[1] * b[2] - a[2] * b[1];
      result[1] = a[2] * b[0] - a[0] * b[2];
      result[2] = a[0] * b[1] - a[1] * b[0];
    }

    /** Coefficients for Bernstein's polynomials of the product of a direction and a point. */
    template <class Direction>
    __attribute__((always_inline)) inline void
    coefficients(const Direction &start,
                 const Direction &end,
                 const Vectors   &x,
                 const Vectors   &y,
                 FourNumbers (&k)[3])
    {
      k[0] = along(start, x);
      k[1] = 0.5 * (along(start, y) + along(end, x));
      k[2] = along(end, y);
    }

    /** Coefficients of four corners, each seen from a point that moves as well; and the extent of
     * all that was seen. */
    template <class Origin>
    __attribute__((always_inline)) inline void
    look(const Origin           &from,
         const Origin           &to,
         const MovingCorners    &corners,
         const TurningDirection &direction,
         FourNumbers (&k)[3],
         FourNumbers &extent)
    {
      Vectors x, y;
      seen_from(from, corners.from, x);
      seen_from(to, corners.to, y);
      coefficients(direction.start, direction.end, x, y, k);
      widen(extent, x);
      widen(extent, y);
    }

    /** The distance at the start, or -1 if it is not more than a part of the extent all the time.
     */
    __attribute__((always_inline)) inline double
    certain(const double (&in_front)[3],
            const double            extent,
            const TurningDirection &direction,
            const double            margin)
    {
      double least       = in_front[0] < in_front[1] ? in_front[0] : in_front[1];
      least              = least < in_front[2] ? least : in_front[2];
      const double start = direction.start.norm_square(), end = direction.end.norm_square(),
                   most = start > end ? start : end;
      if (!(least > 0. && least * least > margin * margin * extent * extent * most))
        return -1.;
      return in_front[0] / std::sqrt(start);
    }
  } // namespace



  void
  MovingCorners::set(const std::array<Point<dim>, 4> &x,
                     const std::array<Point<dim>, 4> &y,
                     const double                     largest)
  {
    frame.set(x.data(), y.data());
    size = largest;
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int a = 0; a < 4; ++a)
        {
          from[d][a] = x[a][d];
          to[d][a]   = y[a][d];
        }
  }



  Point<dim>
  MovingCorners::corner(const unsigned int a, const bool at_end) const
  {
    const auto &x = at_end ? to : from;
    return {x[0][a], x[1][a], x[2][a]};
  }



  TOUCHSTONE_VECTORISED double
  TwoFaces::distance_in_front(const TurningDirection &direction, const double margin) const
  {
    const double origin[dim] = {other.from[0][0], other.from[1][0], other.from[2][0]};
    FourNumbers  front[3], behind[3], extent = {};
    look(origin, origin, one, direction, front, extent);
    look(origin, origin, other, direction, behind, extent);
    double in_front[3];
    for (unsigned int k = 0; k < 3; ++k)
      in_front[k] = -most_of(-front[k]) - most_of(behind[k]);
    return certain(in_front, most_of(extent), direction, margin);
  }



  Tensor<1, dim>
  TwoFaces::shortest_difference(const bool at_end) const
  {
    std::array<Point<dim>, 8> x;
    for (unsigned int a = 0; a < 4; ++a)
      {
        x[a]     = one.corner(a, at_end);
        x[4 + a] = other.corner(a, at_end);
      }
    return Touchstone::shortest_difference(x.data(), 4, 8);
  }



  TOUCHSTONE_VECTORISED double
  NodeAndFace::distance_in_front(const TurningDirection &direction, const double margin) const
  {
    FourNumbers behind[3], extent = {};
    look(from, to, face, direction, behind, extent);
    double in_front[3];
    for (unsigned int k = 0; k < 3; ++k)
      in_front[k] = -most_of(behind[k]);
    return certain(in_front, most_of(extent), direction, margin);
  }



  Tensor<1, dim>
  NodeAndFace::shortest_difference(const bool at_end) const
  {
    std::array<Point<dim>, 5> x;
    x[0] = at_end ? to : from;
    for (unsigned int a = 0; a < 4; ++a)
      x[1 + a] = face.corner(a, at_end);
    return Touchstone::shortest_difference(x.data(), 1, 5);
  }



  // All points are seen from the node, so that a triangle is behind it where the products with its
  // corners are negative. One entry of a vector is of one triangle.
  TOUCHSTONE_VECTORISED unsigned int
  NodeAndFace::triangles_in_reach(const Point<dim> &middle_from,
                                  const Point<dim> &middle_to,
                                  const double      margin) const
  {
    // By corner of a triangle, at the start and the end.
    Vectors     x[3], y[3];
    FourNumbers extent = {};
    seen_from(from, face.from, x[0]);
    seen_from(to, face.to, y[0]);
    for (unsigned int d = 0; d < dim; ++d)
      {
        x[1][d] = TOUCHSTONE_SHUFFLE(x[0][d], x[0][d], 1, 2, 3, 0);
        y[1][d] = TOUCHSTONE_SHUFFLE(y[0][d], y[0][d], 1, 2, 3, 0);
        x[2][d] = FourNumbers{} + (middle_from[d] - from[d]);
        y[2][d] = FourNumbers{} + (middle_to[d] - to[d]);
      }
    Vectors edges_from[3], edges_to[3], normal_from, normal_to;
    for (unsigned int i = 0; i < 3; ++i)
      {
        widen(extent, x[i]);
        widen(extent, y[i]);
        for (unsigned int d = 0; d < dim; ++d)
          {
            edges_from[i][d] = x[(i + 1) % 3][d] - x[i][d];
            edges_to[i][d]   = y[(i + 1) % 3][d] - y[i][d];
          }
      }
    cross(edges_from[0], edges_from[1], normal_from);
    cross(edges_to[0], edges_to[1], normal_to);
    // Towards the side where the node is.
    const FourNumbers zero = {}, one = zero + 1.,
                      side = along(normal_from, x[0]) > zero ? -one : one;
    auto apart             = zero > one;
    for (unsigned int direction = 0; direction < 4; ++direction)
      {
        Vectors start, end;
        if (direction == 3)
          for (unsigned int d = 0; d < dim; ++d)
            {
              start[d] = side * normal_from[d];
              end[d]   = side * normal_to[d];
            }
        else
          {
            cross(edges_from[direction], normal_from, start);
            cross(edges_to[direction], normal_to, end);
          }
        FourNumbers in_front = zero;
        for (unsigned int i = 0; i < 3; ++i)
          {
            FourNumbers k[3];
            coefficients(start, end, x[i], y[i], k);
            for (unsigned int j = 0; j < 3; ++j)
              in_front = i + j == 0 ? -k[j] : lesser(in_front, -k[j]);
          }
        const FourNumbers bound  = margin * margin * extent * extent,
                          length = greater(along(start, start), along(end, end));
        apart |= (in_front > zero) & (in_front * in_front > bound * length);
      }
    unsigned int result = 0;
    for (unsigned int t = 0; t < 4; ++t)
      if (!apart[t])
        result |= 1U << t;
    return result;
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/overlap.h>
#include <touchstone/contact/geometry/projected_face.h>

#include <algorithm>
#include <cmath>

// Quadrature on the common part of a slave and a master face, on which averaged rows are integrated
// (doc/theory.md 3; Puso 2004). differentiated_overlap.cc is the same with derivatives.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Surface Jacobian ratio: the area of a face per area of its projection on a plane,
     * |t_1 x t_2| / |(t_1 x t_2) . n|. */
    class JacobianRatio
    {
    public:
      JacobianRatio(const Face &face, const Positions<double> &x, const TangentPlane<double> &plane)
        : face(face)
        , x(x)
        , normal(cross(plane.e1, plane.e2))
      {
        if (face.degree == 1)
          bilinear =
            Bilinear<dim>([&x](const unsigned int m, const unsigned int d) { return x[m][d]; });
      }

      double
      operator()(const std::array<double, 2> &xi) const
      {
        Vector3<double> position, t[2] = {{}, {}};
        if (face.degree == 1)
          bilinear.evaluate(xi, position, t);
        else
          {
            const FaceShapes shapes(face.degree, xi);
            for (unsigned int m = 0; m < face.n_nodes(); ++m)
              for (unsigned int a = 0; a < 2; ++a)
                for (unsigned int d = 0; d < dim; ++d)
                  t[a][d] += shapes.gradient[m][a] * x[m][d];
          }
        // Integrals are over the slave face itself and not over its projection: otherwise the areas
        // of warped or curved faces would not add up to those of the surface.
        const Vector3<double> c = cross(t[0], t[1]);
        return std::sqrt(dot(c, c)) / std::abs(dot(c, normal));
      }

    private:
      const Face              &face;
      const Positions<double> &x;
      Vector3<double>          normal;
      Bilinear<dim>            bilinear; // if of degree 1
    };
  } // namespace



  std::vector<std::vector<OverlapPoint>>
  overlap(const Face &slave, const std::vector<const Face *> &masters)
  {
    const Positions<double>     x = positions(slave);
    const TangentPlane<double>  plane(slave, x);
    const ProjectedFace<double> of_slave(slave, x, plane);
    const JacobianRatio         ratio(slave, x, plane);

    std::vector<std::vector<OverlapPoint>> result(masters.size());
    std::vector<OverlapPoint>              points;
    for (std::size_t f = 0; f < masters.size(); ++f)
      {
        const ProjectedFace<double> of_master(*masters[f], positions(*masters[f]), plane);
        // Most candidates are beside the slave face.
        if (apart(of_slave, of_master))
          continue;
        points.clear();
        for_each_common_point(of_slave,
                              of_master,
                              [&](const Point2<double> &position, const double weight) {
                                OverlapPoint point;
                                // A point that is mapped to no coordinates near either face comes
                                // from a folded projection; it is left out.
                                if (!of_slave.invert(position, point.slave) ||
                                    !of_master.invert(position, point.master))
                                  return;
                                point.weight = weight * ratio(point.slave);
                                points.push_back(point);
                              });
        result[f] = points;
      }
    return result;
  }



  std::vector<OverlapPoint>
  overlap(const Face &slave, const Face &master)
  {
    return overlap(slave, std::vector<const Face *>{&master})[0];
  }



  bool
  may_overlap(const Face &slave, const Face &master, const double motion)
  {
    const Positions<double>    x = positions(slave), y = positions(master);
    const TangentPlane<double> plane(slave, x);
    const Vector3<double>      normal = cross(plane.e1, plane.e2);
    // Largest distance of a master node from the plane of the slave face, length.
    double height = 0.;
    for (unsigned int m = 0; m < master.n_nodes(); ++m)
      height = std::max(height, std::abs(dot(normal, y[m]) - dot(normal, plane.origin)));
    // The plane may tilt by an angle of about motion / size; projections then move by the height
    // times this angle.
    const double tilt = motion * (1. / plane.length + plane.length / plane.area);
    // Relative positions in the plane change by twice the motion, as both faces move, and by the
    // tilt times the height. The factor in front is a margin: a candidate too many costs little, a
    // missed one changes the contact.
    return !apart(ProjectedFace<double>(slave, x, plane),
                  ProjectedFace<double>(master, y, plane),
                  2. * (2. * motion + tilt * height));
  }
} // namespace Touchstone

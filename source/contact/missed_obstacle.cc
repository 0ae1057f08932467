// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact_pair.h>
#include <touchstone/contact/geometry/face_area.h>
#include <touchstone/contact/geometry/measured_face.h>
#include <touchstone/contact/missed_contact.h>
#include <touchstone/contact/tolerances.h>

#include <algorithm>
#include <array>
#include <functional>

// Obstacles that pass between the slave nodes. They have no nodes: where they are deepest is found
// from their distance, which tells the way to them.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Face coordinates, and how far behind the face. */
    using Behind = std::array<double, 3>;

    /** The point where a function is smallest, from the best of some on the face towards where it
     * falls. @param farthest Behind the face; zero for points of the face alone. */
    Behind
    smallest(const std::function<double(const Behind &)> &value, const double farthest)
    {
      Behind     best  = {{0., 0., 0.}};
      double     least = value(best);
      const auto take  = [&](const Behind &trial) {
        if (const double there = value(trial); there < least)
          {
            least = there;
            best  = trial;
          }
      };
      for (const double a : MeasuredFace::samples)
        for (const double b : MeasuredFace::samples)
          take({{a, b, 0.}});
      for (double step = 0.25; step > 1e-3; step *= 0.5)
        for (unsigned int turn = 0; turn < 2; ++turn)
          for (unsigned int i = 0; i < 3; ++i)
            for (const double sign : {-1., 1.})
              {
                Behind trial = best;
                trial[i]     = i < 2 ? std::clamp(trial[i] + sign * step, -1., 1.)
                                     : std::clamp(trial[i] + sign * step * farthest, 0., farthest);
                take(trial);
              }
      return best;
    }
  } // namespace



  std::vector<MissedContact::Overlap>
  MissedContact::obstacle_within(const std::vector<Face> &slaves) const
  {
    const double         part = part_adjusted();
    std::vector<Overlap> result;
    for (const Face &face : slaves)
      {
        const MeasuredFace slave(face, pair.slave().exact_surface(face));
        const double       size     = slave.size();
        const auto         position = [&](const Behind &b) {
          const FacePoint point = evaluate(face, slave.exact, MeasuredFace::Xi{{b[0], b[1]}});
          return point.x - b[2] * point.normal();
        };
        const auto gap = [&](const Behind &b) {
          return pair.pairing().distance(position(b), contact.time());
        };
        // A distance changes by no more than the point moves.
        if (gap({{0., 0., 0.}}) > 2. * size)
          continue;
        // An obstacle may be smaller than the distance of points of the face, and may lie behind
        // it altogether.
        double area = face_area(face);
        for (const double farthest : {0., size})
          {
            const Behind at     = smallest(gap, farthest);
            double       counts = -gap(at);
            if (counts > 0.)
              counts += at[2];
            if (part > 0.)
              counts -=
                std::max(adjusted,
                         -part * pair.pairing().distance(evaluate(MeasuredFace::in_reference(face),
                                                                  slave.exact,
                                                                  MeasuredFace::Xi{{at[0], at[1]}})
                                                           .x,
                                                         0.));
            if (counts <= Tolerances::touching * size + slave.sagitta())
              continue;
            const Point<dim> on_face = position({{at[0], at[1], 0.}});
            result.push_back({{counts, on_face, size, area}, face.body, position(at), at[2] > 0.});
            // Counted once.
            area = 0.;
          }
      }
    return result;
  }
} // namespace Touchstone

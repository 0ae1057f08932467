// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/contact/contact.h>
#include <touchstone/contact/geometry/measured_face.h>
#include <touchstone/contact/passed_obstacle.h>
#include <touchstone/contact/rigid_motion.h>
#include <touchstone/contact/tolerances.h>
#include <touchstone/mesh/rotation.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>
#include <vector>

// Rows with an obstacle know where slave nodes are, not how they came there: a thin obstacle that
// is passed within one step leaves no trace in the balance.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A point that has gone through, and how deep within it was on its way. */
    struct Passage
    {
      double     depth = 0.;
      Point<dim> x;

      bool
      operator<(const Passage &other) const
      {
        return std::make_tuple(depth, x[0], x[1], x[2]) <
               std::make_tuple(other.depth, other.x[0], other.x[1], other.x[2]);
      }
    };



    /** How the obstacle has moved in a step: a turn about an axis in space, and a translation along
     * it; a translation alone if it does not turn. */
    class StepOfObstacle
    {
    public:
      StepOfObstacle(const RigidMotion &then, const RigidMotion &now)
      {
        const Tensor<2, dim> turn = now.turn * transpose(then.turn);
        along                     = now.shift - turn * then.shift;
        Tensor<1, dim> twice_sine;
        twice_sine[0]           = turn[2][1] - turn[1][2];
        twice_sine[1]           = turn[0][2] - turn[2][0];
        twice_sine[2]           = turn[1][0] - turn[0][1];
        const double     sine   = 0.5 * twice_sine.norm();
        constexpr double hardly = 1e-9;
        known                   = sine >= hardly || trace(turn) > 0.;
        if (sine < hardly)
          return;
        angle                     = std::atan2(sine, 0.5 * (trace(turn) - 1.));
        axis                      = twice_sine / (2. * sine);
        const Tensor<1, dim> side = along - (along * axis) * axis;
        along -= side;
        centre = Point<dim>(0.5 * (side + cross_product_3d(axis, side) / std::tan(0.5 * angle)));
      }

      /** Where what the obstacle carries along is at the end of the step, if it is at @p x after
       * the part @p s of it. */
      Point<dim>
      at_end(const Point<dim> &x, const double s) const
      {
        const double rest = 1. - s;
        if (angle == 0.)
          return x + rest * along;
        const Tensor<2, dim> turn = rotation(axis, rest * angle * 180. / numbers::PI);
        return centre + turn * (x - centre) + rest * along;
      }

      /** A bound for the length of the way of a point as the obstacle sees it. */
      double
      length_of_way(const Point<dim> &from, const Point<dim> &to) const
      {
        const double radius = std::max(cross_product_3d(from - centre, axis).norm(),
                                       cross_product_3d(to - centre, axis).norm());
        return (to - from - along).norm() + angle * radius;
      }

      /** Half a turn has no sine, and which way round it went is not known. */
      bool known = true;

    private:
      double         angle = 0.;
      Tensor<1, dim> axis;
      Point<dim>     centre;
      Tensor<1, dim> along;
    };



    /** The straight way of a point in a step, past the obstacle as it moves. */
    class Way
    {
    public:
      Way(const Pairing        &obstacle,
          const StepOfObstacle &motion,
          const double          time,
          const Point<dim>     &from,
          const Point<dim>     &to)
        : obstacle(obstacle)
        , motion(motion)
        , time(time)
        , from(from)
        , to(to)
        , length(motion.length_of_way(from, to))
      {
      }

      /** How deep within the obstacle it passes through it; zero if it does not.
       * @param size Of the face. */
      double
      depth_of_passage(const double size) const
      {
        const double begin = distance(0.);
        // A point in contact may slide around an edge of the obstacle: the straight line between
        // its ends then cuts through the edge.
        const double least = size * (begin > Tolerances::touching * size ? Tolerances::touching
                                                                         : Tolerances::deep_edge);
        // Distances change by no more than the point moves, so it comes no deeper than that.
        if (0.5 * (length - begin - distance(1.)) <= least)
          return 0.;
        double         deepest = 0., s = 0.;
        Tensor<1, dim> way_in = normal(0.);
        while (s < 1.)
          {
            const double here = distance(s);
            if (here >= 0.)
              {
                if (deepest > least && goes_through(way_in, normal(s)))
                  return deepest;
                deepest = 0.;
                // The side that is nearest before it comes in.
                way_in = normal(s);
              }
            deepest = std::max(deepest, -here);
            // The surface is no nearer than that, and what matters is as wide as it is deep.
            s += std::max({std::abs(here), least, length / most_steps}) / length;
          }
        return deepest > least && goes_through(way_in, normal(1.)) ? deepest : 0.;
      }

    private:
      /** What is thinner than the length of the way divided by this may be missed. */
      static constexpr double most_steps = 4096.;
      /** Cosine of 120 degrees. */
      static constexpr double opposite = -0.5;

      const Pairing        &obstacle;
      const StepOfObstacle &motion;
      const double          time;
      const Point<dim>      from, to;
      const double          length;

      /** Whether the sides with the normals @p in and @p out are opposite to each other, not beside
       * each other over an edge. */
      static bool
      goes_through(const Tensor<1, dim> &in, const Tensor<1, dim> &out)
      {
        return in * out < opposite;
      }

      Point<dim>
      at(const double s) const
      {
        return motion.at_end(from + s * (to - from), s);
      }
      double
      distance(const double s) const
      {
        return obstacle.distance(at(s), time);
      }
      Tensor<1, dim>
      normal(const double s) const
      {
        return obstacle.at(at(s), time)->normal;
      }
    };



    /** Where the obstacle of a pair was when the step began. Collective. */
    RigidMotion
    committed_motion(const Contact &contact, const ContactPair &pair)
    {
      std::vector<RigidMotion> mine;
      if (!pair.committed_rows().empty())
        mine.push_back(pair.committed_rows().front().motion);
      const std::vector<RigidMotion> all = gather_all(mine, contact.communicator());
      Assert(!all.empty(), ExcInternalError());
      return all.front();
    }



    /** The deepest of a pair; zero deep if there is none. Collective. */
    Passage
    deepest_passage(const Contact &contact, const ContactPair &pair, const Vector &committed)
    {
      const Vector         before = contact.with_ghosts(committed);
      const StepOfObstacle motion(committed_motion(contact, pair),
                                  pair.pairing().motion(contact.time()));
      std::vector<Passage> found(1);
      if (!motion.known)
        return found.front();
      for (const Face &face : pair.slave().owned_faces())
        {
          const AnalyticSurface *const exact = pair.slave().exact_surface(face);
          const Face                   start = MeasuredFace::displaced(face, before),
                     end    = MeasuredFace::displaced(face, contact.ghosted_displacement());
          const double size = MeasuredFace(end, exact).size();
          for (const double a : MeasuredFace::samples)
            for (const double b : MeasuredFace::samples)
              {
                const MeasuredFace::Xi xi = {{a, b}};
                const Point<dim>       to = evaluate(end, exact, xi).x;
                const Way              way(
                  pair.pairing(), motion, contact.time(), evaluate(start, exact, xi).x, to);
                found.front() = std::max(found.front(), Passage{way.depth_of_passage(size), to});
              }
        }
      // Of equally deep ones that with the largest coordinates: the same on any partition.
      const std::vector<Passage> all = gather_all(found, contact.communicator());
      return *std::max_element(all.begin(), all.end());
    }
  } // namespace



  std::string
  passed_obstacle(const Contact &contact, const Vector &committed)
  {
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      {
        const ContactPair &pair = contact.pair(p);
        if (pair.master() || pair.tied())
          continue;
        const Passage worst = deepest_passage(contact, pair, committed);
        if (worst.depth == 0.)
          continue;
        // Components that are round-off are none.
        constexpr double shown = 1e-4;
        double           x[dim];
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = std::abs(worst.x[d]) > shown * worst.x.norm() ? worst.x[d] : 0.;
        char where[80];
        std::snprintf(where, sizeof(where), "(%.3g, %.3g, %.3g)", x[0], x[1], x[2]);
        return "contact pair '" + pair.parameters().name + "': '" + pair.parameters().slave_body +
               "' has passed through the obstacle '" + pair.parameters().obstacle +
               "' within one step, with a point that is at " + where +
               " now: make smaller steps, or refine the slave surface if the obstacle is smaller "
               "than its faces";
      }
    return "";
  }
} // namespace Touchstone

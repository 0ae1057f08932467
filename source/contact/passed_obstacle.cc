// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/contact/contact.h>
#include <touchstone/contact/geometry/measured_face.h>
#include <touchstone/contact/overlap_order.h>
#include <touchstone/contact/passed_obstacle.h>
#include <touchstone/contact/place_in_words.h>
#include <touchstone/contact/rigid_motion.h>
#include <touchstone/contact/tolerances.h>
#include <touchstone/mesh/rotation.h>

#include <algorithm>
#include <cmath>
#include <vector>

// Rows with an obstacle know where slave nodes are, not how they came there: a thin obstacle that
// is passed within one step leaves no trace in the balance.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A point that has gone through, and how deep within the obstacle it was on its path. */
    struct Passage
    {
      double     depth;
      Point<dim> x;
    };



    /** How the obstacle has moved in a step: a turn about an axis in space, and a translation along
     * it; a translation alone if it does not turn. */
    class StepOfObstacle
    {
    public:
      StepOfObstacle(const RigidMotion &then, const RigidMotion &now)
      {
        const Tensor<2, dim> turn   = now.turn * transpose(then.turn);
        along                       = now.shift - turn * then.shift;
        const Tensor<1, dim> vector = rotation_vector(turn);
        // Of less the axis would be lost in round-off.
        constexpr double hardly = 1e-9;
        if (vector.norm() < hardly)
          return;
        angle                     = vector.norm();
        axis                      = vector / angle;
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

      /** An upper bound of the length of the path of a point relative to the obstacle. */
      double
      length_of_path(const Point<dim> &from, const Point<dim> &to) const
      {
        const double radius = std::max(cross_product_3d(from - centre, axis).norm(),
                                       cross_product_3d(to - centre, axis).norm());
        return (to - from - along).norm() + angle * radius;
      }

    private:
      double         angle = 0.;
      Tensor<1, dim> axis;
      Point<dim>     centre;
      Tensor<1, dim> along;
    };



    /** The straight path of a point in a step, past the obstacle as it moves. */
    class Path
    {
    public:
      Path(const Pairing        &obstacle,
           const StepOfObstacle &motion,
           const double          time,
           const Point<dim>     &from,
           const Point<dim>     &to)
        : obstacle(obstacle)
        , motion(motion)
        , time(time)
        , from(from)
        , to(to)
        , length(motion.length_of_path(from, to))
      {
      }

      /** How deep within the obstacle it passes through it; zero if it does not.
       * @param size Of the face. */
      double
      depth_of_passage(const double size) const
      {
        const double begin = relative(0.).distance, end = relative(1.).distance;
        // A point in contact may slide around an edge of the obstacle: the straight line between
        // its ends then cuts through the edge.
        const double least = size * (begin > Tolerances::touching * size ? Tolerances::touching
                                                                         : Tolerances::deep_edge);
        // Distances change by no more than the point moves, so it comes no deeper than that.
        if (0.5 * (length - begin - end) <= least)
          return 0.;
        double         deepest = 0., s = 0.;
        Tensor<1, dim> side_in = relative(0.).normal;
        while (s < 1.)
          {
            const Relative here = relative(s);
            if (here.distance >= 0.)
              {
                if (deepest > least && goes_through(side_in, here.normal))
                  return deepest;
                deepest = 0.;
                // The side that is nearest before it comes in.
                side_in = here.normal;
              }
            deepest = std::max(deepest, -here.distance);
            // The surface is no nearer than that, and what matters is as wide as it is deep.
            s += std::max({std::abs(here.distance), least, length / most_steps}) / length;
          }
        return deepest > least && goes_through(side_in, relative(1.).normal) ? deepest : 0.;
      }

    private:
      /** What is thinner than the length of the path divided by this may be missed. */
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

      /** Signed distance from the obstacle, and the normal of the nearest point of it. */
      struct Relative
      {
        double         distance;
        Tensor<1, dim> normal;
      };

      /** After the part @p s of the step. */
      Relative
      relative(const double s) const
      {
        const PointContact there = *obstacle.at(motion.at_end(from + s * (to - from), s), time);
        return {there.gap_vector * there.normal, there.normal};
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



    /** Of the slave faces of a pair, of all ranks. Collective. */
    std::vector<Passage>
    passages(const Contact &contact, const ContactPair &pair, const Vector &committed)
    {
      const Vector         before = contact.with_ghosts(committed);
      const StepOfObstacle motion(committed_motion(contact, pair),
                                  pair.pairing().motion(contact.time()));
      std::vector<Passage> found;
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
                const Path             path(
                  pair.pairing(), motion, contact.time(), evaluate(start, exact, xi).x, to);
                if (const double depth = path.depth_of_passage(size); depth > 0.)
                  found.push_back({depth, to});
              }
        }
      return gather_all(found, contact.communicator());
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
        std::vector<Passage> found = passages(contact, pair, committed);
        if (found.empty())
          continue;
        sort_by_depth(found, [](const Passage &passage) { return passage; });
        return "contact pair '" + pair.parameters().name + "': '" + pair.parameters().slave_body +
               "' has passed through the obstacle '" + pair.parameters().obstacle +
               "' within one step, with a point that is at " + place_in_words(found.front().x) +
               " now: make smaller steps, or refine the slave surface if the obstacle is smaller "
               "than its faces";
      }
    return "";
  }
} // namespace Touchstone

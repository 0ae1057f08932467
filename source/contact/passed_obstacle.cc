// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/contact/contact.h>
#include <touchstone/contact/geometry/measured_face.h>
#include <touchstone/contact/passed_obstacle.h>
#include <touchstone/contact/rigid_motion.h>
#include <touchstone/contact/tolerances.h>

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



    /** The way of a point in a step, as the obstacle sees it, which is where it is now. */
    class Way
    {
    public:
      Way(const ContactPair &pair, const double time, const Point<dim> &from, const Point<dim> &to)
        : pair(pair)
        , time(time)
        , from(from)
        , to(to)
        , length(from.distance(to))
      {
      }

      /** How deep within the obstacle it passes; zero if it does not. @param size Of the face. */
      double
      depth_of_passage(const double size) const
      {
        const double begin = distance(0.);
        if (begin > length || begin < -Tolerances::touching * size ||
            distance(1.) < -Tolerances::touching * size)
          return 0.;
        // What is on the obstacle may slide around it, over edges, which the straight way cuts.
        const double least =
          (begin > Tolerances::touching * size ? Tolerances::touching : cut_by_sliding) * size;
        double         deepest = 0., s = 0.;
        bool           within = false;
        Tensor<1, dim> way_in;
        while (s < 1.)
          {
            const double here = distance(s);
            if (here < 0. && !within)
              {
                within  = true;
                way_in  = normal(s);
                deepest = 0.;
              }
            if (here >= 0. && within)
              {
                within = false;
                if (deepest > least && way_in * normal(s) < 0.)
                  return deepest;
              }
            deepest = std::max(deepest, -here);
            // The surface is no nearer than that.
            s += std::max(std::abs(here) / length, shortest);
          }
        return within && deepest > least && way_in * normal(1.) < 0. ? deepest : 0.;
      }

    private:
      /** By the size of the face: how deep the straight way of what slides may go. */
      static constexpr double cut_by_sliding = Tolerances::deep_edge;
      /** The shortest step along the way, as a part of it. */
      static constexpr double shortest = 1. / 256.;

      const ContactPair &pair;
      const double       time;
      const Point<dim>   from, to;
      const double       length;

      Point<dim>
      at(const double s) const
      {
        return from + s * (to - from);
      }
      double
      distance(const double s) const
      {
        return pair.pairing().distance(at(s), time);
      }
      Tensor<1, dim>
      normal(const double s) const
      {
        return pair.pairing().at(at(s), time)->normal;
      }
    };



    /** How the obstacle of a pair was when the step began. Collective. */
    RigidMotion
    committed_motion(const Contact &contact, const ContactPair &pair)
    {
      std::vector<RigidMotion> mine;
      if (!pair.committed_rows().empty())
        mine.push_back(pair.committed_rows().front().motion);
      return gather_all(mine, contact.communicator()).front();
    }



    /** The deepest of a pair; zero deep if there is none. Collective. */
    Passage
    deepest_passage(const Contact &contact, const ContactPair &pair, const Vector &committed)
    {
      const Vector      before = contact.with_ghosts(committed);
      const RigidMotion then   = committed_motion(contact, pair),
                        now    = pair.pairing().motion(contact.time());
      std::vector<Passage> found(1);
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
                const Way              way(pair,
                              contact.time(),
                              now.place(then.back(evaluate(start, exact, xi).x)),
                              to);
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
        if (pair.master() || pair.tied() || pair.small_sliding())
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
               "' within one step, where it is at " + where + " now: make smaller steps";
      }
    return "";
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact_pair.h>
#include <touchstone/contact/geometry/face_area.h>
#include <touchstone/contact/geometry/measured_face.h>
#include <touchstone/contact/missed_contact.h>
#include <touchstone/contact/tolerances.h>

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

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
      // The best of all that are beside it: not the first, which the order of coordinates, and so
      // how the face lies, would choose.
      const std::vector<double> behind =
        farthest > 0. ? std::vector<double>{0., -1., 1.} : std::vector<double>{0.};
      for (double step = 0.25; step > 1e-3; step *= 0.5)
        for (unsigned int turn = 0; turn < 2; ++turn)
          {
            const Behind from = best;
            for (const double a : {0., -1., 1.})
              for (const double b : {0., -1., 1.})
                for (const double c : behind)
                  take({{std::clamp(from[0] + a * step, -1., 1.),
                         std::clamp(from[1] + b * step, -1., 1.),
                         std::clamp(from[2] + c * step * farthest, 0., farthest)}});
            if (best == from)
              break;
          }
      return best;
    }



    /** The gradient of a function of face coordinates. */
    using Gradient = std::function<std::array<double, 2>(const MeasuredFace::Xi &)>;

    /** The step of Newton's method towards a minimum on the face. Directions in which the function
     * does not bend, as along a cylinder, are left alone, and so are bounds that it falls beyond.
     */
    std::array<double, 2>
    step_to_minimum(const Gradient &gradient, const MeasuredFace::Xi &xi)
    {
      constexpr double h = 1e-4, straight = 1e-3;
      const auto       g = gradient(xi);
      double           H[2][2];
      bool             free[2];
      for (unsigned int a = 0; a < 2; ++a)
        {
          MeasuredFace::Xi before = xi, after = xi;
          before[a] -= h;
          after[a] += h;
          const auto low = gradient(before), high = gradient(after);
          for (unsigned int b = 0; b < 2; ++b)
            H[b][a] = (high[b] - low[b]) / (2. * h);
          free[a] = std::abs(xi[a]) < 1. || xi[a] * g[a] > 0.;
        }
      std::array<double, 2> step{};
      const double          across = 0.5 * (H[0][1] + H[1][0]);
      if (free[0] && free[1])
        {
          // Eigenvalues and eigenvectors of the symmetric part.
          const double mean = 0.5 * (H[0][0] + H[1][1]), half = 0.5 * (H[0][0] - H[1][1]),
                       radius = std::hypot(half, across), angle = 0.5 * std::atan2(across, half);
          const double values[2]     = {mean + radius, mean - radius};
          const double vectors[2][2] = {{std::cos(angle), std::sin(angle)},
                                        {-std::sin(angle), std::cos(angle)}};
          for (unsigned int i = 0; i < 2; ++i)
            if (values[i] > straight * values[0])
              for (unsigned int a = 0; a < 2; ++a)
                step[a] -=
                  (vectors[i][0] * g[0] + vectors[i][1] * g[1]) / values[i] * vectors[i][a];
        }
      else
        for (unsigned int a = 0; a < 2; ++a)
          if (free[a] && H[a][a] > 0.)
            step[a] = -g[a] / H[a][a];
      return step;
    }
  } // namespace



  MeasuredFace::Xi
  MissedContact::descend(const MeasuredFace &slave, MeasuredFace::Xi xi) const
  {
    const auto gap = [&](const MeasuredFace::Xi &at) {
      return pair.pairing().distance(evaluate(slave.face, slave.exact, at).x, contact.time());
    };
    const Gradient gradient = [&](const MeasuredFace::Xi &at) {
      const FacePoint point = evaluate(slave.face, slave.exact, at);
      const auto      there = pair.pairing().at(point.x, contact.time());
      return std::array<double, 2>{
        {there->normal * point.tangents[0], there->normal * point.tangents[1]}};
    };
    constexpr unsigned int most     = 20;
    constexpr double       at_place = 1e-9;
    for (unsigned int i = 0; i < most; ++i)
      {
        const auto       step = step_to_minimum(gradient, xi);
        MeasuredFace::Xi next = xi;
        double           size = 0.;
        for (unsigned int a = 0; a < 2; ++a)
          {
            next[a] = std::clamp(xi[a] + step[a], -1., 1.);
            size    = std::max(size, std::abs(next[a] - xi[a]));
          }
        if (gap(next) > gap(xi) + Tolerances::on_edge * slave.size())
          break;
        xi = next;
        if (size < at_place)
          break;
      }
    return xi;
  }



  MeasuredFace::Xi
  MissedContact::deepest_in(const MeasuredFace &slave, const MeasuredFace::Xi &start) const
  {
    const auto depth = [&](const MeasuredFace::Xi &xi) {
      return -pair.pairing().distance(evaluate(slave.face, slave.exact, xi).x, contact.time());
    };
    // The overlap may be narrower than the distance of samples: then what is deepest beside each of
    // them. Along a ridge round-off would choose one of many places.
    std::vector<Sample> samples;
    for (const bool down : {false, true})
      if (samples.empty())
        for (const double a : MeasuredFace::samples)
          for (const double b : MeasuredFace::samples)
            {
              const MeasuredFace::Xi xi =
                down ? descend(slave, {{a, b}}) : MeasuredFace::Xi{{a, b}};
              if (const double here = depth(xi); here > 0.)
                samples.push_back({xi, here});
            }
    if (samples.empty())
      return descend(slave, start);
    const MeasuredFace::Xi between = descend(slave, middle(samples));
    // Between two places of an obstacle there may be less of it, or none.
    const Sample &deepest =
      *std::max_element(samples.begin(), samples.end(), [](const Sample &a, const Sample &b) {
        return a.depth < b.depth;
      });
    return depth(between) < deepest.depth - Tolerances::on_edge * slave.size()
             ? descend(slave, deepest.xi)
             : between;
  }



  std::vector<MissedContact::Overlap>
  MissedContact::obstacle_within(const std::vector<Face> &slaves) const
  {
    std::vector<Overlap> found;
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
            // Behind an edge of the body lies another face of it, which may touch the obstacle.
            if (counts > Tolerances::touching * size)
              counts += at[2];
            double taken_out = 0.;
            if (part_adjusted > 0.)
              taken_out =
                std::max(adjusted,
                         -part_adjusted *
                           pair.pairing().distance(evaluate(MeasuredFace::in_reference(face),
                                                            slave.exact,
                                                            MeasuredFace::Xi{{at[0], at[1]}})
                                                     .x,
                                                   0.));
            counts -= taken_out;
            if (counts <= Tolerances::touching * size + slave.sagitta())
              continue;
            const Point<dim> on_face = position({{at[0], at[1], 0.}});
            found.push_back({{counts, on_face, size, area},
                             face.body,
                             position(at),
                             {},
                             at[2] > 0.,
                             taken_out > Tolerances::touches_at_start * size,
                             MaterialPoint(face, pair.slave().trace(face), {{at[0], at[1]}}),
                             {}});
            if (gap({{at[0], at[1], 0.}}) < 0. && !found.back().adjusted)
              {
                const MeasuredFace::Xi where = rounded(deepest_in(slave, {{at[0], at[1]}}));
                MaterialPoint         &point = found.back().point;
                point                        = MaterialPoint(face, pair.slave().trace(face), where);
                // Exact, where what the search finds is as coarse as its steps: along a cylinder
                // many places are nearly as deep, and points of faces are compared.
                point.depth              = -gap({{where[0], where[1], 0.}}) - taken_out;
                found.back().place.depth = std::max(counts, point.depth);
                found.back().deepest     = point;
                found.back().at_point    = position({{where[0], where[1], 0.}});
              }
            // Counted once.
            area = 0.;
          }
      }
    const std::vector<bool> inside = lie_within_bodies(found);
    std::vector<Overlap>    result;
    for (std::size_t k = 0; k < found.size(); ++k)
      if (inside[k])
        result.push_back(found[k]);
    return result;
  }
} // namespace Touchstone

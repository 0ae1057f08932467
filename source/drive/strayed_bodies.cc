// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/strayed_bodies.h>
#include <touchstone/solid/bodies.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

// Bodies without supports that Newton's method has taken far away on its way (doc/theory.md 9).
namespace Touchstone
{
  using namespace dealii;

  std::map<unsigned int, double>
  largest_motions(const std::set<unsigned int> &bodies,
                  const Solid                  &solid,
                  const Vector                 &start,
                  const Vector                 &u)
  {
    std::map<unsigned int, double> result;
    if (bodies.empty())
      return result;
    const std::vector<unsigned int> body = bodies_of_unknowns(solid);
    std::vector<double>             largest(*bodies.rbegin() + 1, 0.);
    for (std::size_t i = 0; i < body.size(); ++i)
      if (body[i] < largest.size())
        largest[body[i]] = std::max(largest[body[i]], std::abs(u.begin()[i] - start.begin()[i]));
    Utilities::MPI::max(largest, solid.communicator, largest);
    for (const unsigned int b : bodies)
      result[b] = largest[b];
    return result;
  }



  void
  StrayedBodies::begin_step(const double from)
  {
    first     = from != last_from;
    last_from = from;
    moved.clear();
  }



  void
  StrayedBodies::note(const std::set<unsigned int> &bodies,
                      const Solid                  &solid,
                      const Vector                 &u,
                      const Vector                 &start)
  {
    for (const auto &[body, motion] : largest_motions(bodies, solid, start, u))
      moved[body] = std::max(moved[body], motion);
  }



  double
  StrayedBodies::farthest(const unsigned int body) const
  {
    const auto found = moved.find(body);
    return found == moved.end() ? 0. : found->second;
  }



  std::string
  StrayedBodies::in_words(const unsigned int body, const double pushed) const
  {
    char text[200];
    std::snprintf(text,
                  sizeof(text),
                  "strays by %.3g in the iterations of a step, and nothing but contact holds it, "
                  "which has pushed it by %.3g",
                  farthest(body),
                  pushed);
    return text;
  }
} // namespace Touchstone

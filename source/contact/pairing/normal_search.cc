// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/normal_search.h>
#include <touchstone/contact/search/far_side.h>
#include <touchstone/contact/tolerances.h>

#include <algorithm>
#include <cmath>

// Lines along slave normals and the faces of the master (doc/theory.md 3.4).
namespace Touchstone
{
  using namespace dealii;

  NormalSearch::NormalSearch(const PairingInput &input)
    // A point that has penetrated by more than the size of a face must still find the surface.
    : farthest(input.search_distance > 0.
                 ? input.search_distance
                 : 4. * std::max(input.slave->largest_face(), input.master->largest_face()))
    , edge_tolerance(input.parameters->edge_tolerance)
    , search(*input.master,
             farthest,
             edge_tolerance,
             input.parameters->master_normal,
             input.solid->communicator)
  {
  }



  void
  NormalSearch::offer(const std::size_t           i,
                      const LookingPoint         &point,
                      std::optional<FacingPoint> &best) const
  {
    const FaceTree &tree = search.tree();
    if (tree.is_back_face(i, point.n))
      return;
    tree.count_candidate();
    const Face &face  = search.known_faces()[i];
    const auto  found = meet_from_outside(point.x, point.n, search.geometry(face));
    if (!found || std::abs(found->along) > farthest)
      return;
    // Lines along a face meet it far behind a point that is hardly behind it.
    const Tensor<1, dim> normal = found->point.normal();
    if (is_deep(tree, face, -found->along) && FaceTree::is_edge_on(normal, point.n))
      return;
    const BeyondEdges beyond(face, found->xi);
    if (beyond.inner > Tolerances::face_coordinate ||
        beyond.outer > (point.stays_at_end ? Tolerances::edge_hysteresis : 1.) * edge_tolerance)
      return;
    // A line through an edge meets the faces on both sides of it in the same point: the one with
    // the smaller key is taken on any number of ranks.
    const double tie =
      Tolerances::on_edge * face.position(0).distance(face.position(face.n_nodes() - 1));
    if (on_far_side(tree, point.start, point.n, face, found->along * (point.n * normal)))
      return;
    const double closer =
      best ? std::abs(best->at.along) - std::abs(found->along) : std::numeric_limits<double>::max();
    if (closer > tie || (closer > -tie && face.key < best->face->key))
      best = FacingPoint{&face, *found};
  }



  std::optional<FacingPoint>
  NormalSearch::look(const LookingPoint &point) const
  {
    const FaceTree            &tree = search.tree();
    std::optional<FacingPoint> best;
    if (point.guess < search.known_faces().size())
      offer(point.guess, point, best);
    if (best)
      {
        // What is met first is not farther away than this.
        std::vector<std::pair<double, std::size_t>> boxes;
        tree.within(point.x,
                    std::abs(best->at.along) + Tolerances::on_edge * tree.largest_diagonal(),
                    boxes);
        for (const auto &box : boxes)
          if (box.second != point.guess)
            offer(box.second, point, best);
        return best;
      }
    FaceTree::Box line({point.x - farthest * point.n, point.x - farthest * point.n});
    line.merge_with(FaceTree::Box({point.x + farthest * point.n, point.x + farthest * point.n}));
    for (const std::size_t i : tree.meeting(line))
      offer(i, point, best);
    return best;
  }



  double
  NormalSearch::least_distance(const Point<dim> &x) const
  {
    const auto closest = search.tree().nearest(x, 1);
    return closest.empty() ? farthest : std::min(farthest, std::sqrt(closest.front().first));
  }
} // namespace Touchstone

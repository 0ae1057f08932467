// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/crossing.h>
#include <touchstone/contact/search/swept_search.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

// Nodes that have passed through a face within a step. The closest face may then be that on the far
// side of a thin body, or the node may be deeper than the reach of the search; the first face that
// it entered is the right one (doc/theory.md 4, "Passing through").
namespace Touchstone
{
  using namespace dealii;

  bool
  SweptSearch::may_cross(const SlavePoint &point, const Face &face) const
  {
    // In a frame that moves with the node, which is then the origin: the range of the box of the
    // face over the step must contain the origin in each direction.
    if (!tree.exchange.is_plane(face))
      {
        const FaceExchange::Box before = tree.exchange.committed_box(face),
                                after  = tree.exchange.box(face);
        bool around                    = true;
        for (unsigned int d = 0; d < dim; ++d)
          around = around &&
                   std::min(before.lower_bound(d) - point.start[d],
                            after.lower_bound(d) - point.x[d]) <= 0. &&
                   std::max(before.upper_bound(d) - point.start[d],
                            after.upper_bound(d) - point.x[d]) >= 0.;
        return around;
      }
    // All positions of a bilinear face in the step are within the hull of its corners before and
    // after: the origin must not be beyond it along an axis or along the normal.
    std::array<Tensor<1, dim>, 4> normals;
    const Tensor<1, dim>          diagonals[] = {face.position(3) - face.position(0),
                                                 face.position(2) - face.position(1)};
    for (unsigned int d = 0; d < dim; ++d)
      normals[d][d] = 1.;
    normals[dim] = cross_product_3d(diagonals[0], diagonals[1]);
    if (const double area = normals[dim].norm(); area > 0.)
      normals[dim] /= area;
    // More than crossing() allows at the start of the step and beside the face.
    const double slack = 10. * Tolerances::touches_at_start * diagonals[0].norm();
    for (const Tensor<1, dim> &normal : normals)
      {
        double least = std::numeric_limits<double>::max(), most = -least;
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          for (const double at :
               {normal * Tensor<1, dim>(face.reference[m] + face.committed[m] - point.start),
                normal * Tensor<1, dim>(face.position(m) - point.x)})
            {
              least = std::min(least, at);
              most  = std::max(most, at);
            }
        if (least > slack || most < -slack)
          return false;
      }
    return true;
  }



  FaceProjection
  SweptSearch::follow(const SlavePoint &point, const Face &from) const
  {
    const std::vector<Face> &faces = tree.exchange.faces();
    // Descend from face to face: as long as the projection is bounded at an inner edge, a neighbour
    // over a common node may be closer. The distance decreases by more than round-off in each step,
    // so the walk ends.
    FaceProjection best = tree.project(point.x, from);
    while (best.projection.beyond_inner > 0.)
      {
        const Face    &face  = *best.face;
        FaceProjection found = best;
        for (const std::size_t i : tree.meeting(tree.exchange.box(face)))
          {
            const Face &other     = faces[i];
            const auto  end       = other.nodes.begin() + other.n_nodes();
            const bool  neighbour = std::find_first_of(other.nodes.begin(),
                                                      end,
                                                      face.nodes.begin(),
                                                      face.nodes.begin() + face.n_nodes()) != end;
            if (!neighbour || !tree.may_meet(i, point))
              continue;
            const FaceProjection candidate = tree.project(point.x, other);
            // Round-off must not make the walk alternate between neighbours.
            const double tie = Tolerances::equal_squares * reach * reach;
            if (candidate.projection.distance_squared < found.projection.distance_squared - tie)
              found = candidate;
          }
        if (found.face == best.face)
          break;
        best = found;
      }
    return best;
  }



  std::optional<FaceProjection>
  SweptSearch::passed(const SlavePoint &point, const bool penetrates) const
  {
    if (!tree.exchange.swept())
      return {};
    const std::vector<Face> &faces = tree.exchange.faces();
    FaceExchange::Box        path({point.x, point.x});
    path.merge_with(FaceExchange::Box({point.start, point.start}));
    std::vector<std::pair<Crossing, const Face *>> crossings;
    for (const std::size_t i : tree.meeting_in_step(path))
      {
        const Face &face = faces[i];
        if (!tree.may_be_closest(i, point) || !may_cross(point, face))
          continue;
        tree.count_candidate();
        if (const auto found =
              crossing(point.start, point.x, face, tree.exchange.exact_surface(face)))
          crossings.emplace_back(*found, &face);
      }
    // In the order of time; equal times by key, which is the same on all ranks.
    std::sort(crossings.begin(), crossings.end(), [](const auto &a, const auto &b) {
      return a.first.time != b.first.time ? a.first.time < b.first.time
                                          : a.second->key < b.second->key;
    });

    // Number of bodies that the node is in, and the face by which it entered the first of them.
    int         depth = 0;
    const Face *entry = nullptr;
    for (std::size_t i = 0; i < crossings.size(); ++i)
      {
        const Crossing &c = crossings[i].first;
        // Faces that meet in an edge are passed together.
        if (i > 0 && c.inward == crossings[i - 1].first.inward &&
            c.time - crossings[i - 1].first.time < Tolerances::same_time)
          continue;
        if (c.inward && depth == 0)
          entry = crossings[i].second;
        // Inward crossings count up, outward ones down. An exit without an entry, of a node that
        // was within a body at the start, leaves the count at zero.
        depth = std::max(0, depth + (c.inward ? 1 : -1));
      }
    // As many exits as entries; one body more is accounted for if the closest face already explains
    // a penetration.
    if (depth <= (penetrates ? 1 : 0))
      return {};
    return follow(point, *entry);
  }



  const Face *
  SweptSearch::entry(const SlavePoint &point) const
  {
    const auto found = passed(point, false);
    return found ? found->face : nullptr;
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/collision/first_crossing.h>
#include <touchstone/explicit/general/general_contact.h>

#include <cmath>
#include <limits>

// The check of the straight motion of a cycle for crossings, and the rows that prevent them
// (doc/general_contact.md, section 3). Each face is four triangles around its middle.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Relative to the points: parts of faces and edges that are larger than these are within this,
     * once for each of two partners. */
    constexpr double enlarged = 8. * MovingSurface::tie;

    /** Hulls of warped faces can overlap where faces do not cross. This is looked at again after so
     * many times. */
    constexpr unsigned int some_patience = 30;

    /** Edges are parallel if the sine of their angle is below this: they have no normal of their
     * own. */
    constexpr double parallel = 1e-6;

    /** Sides that come together are on the outside of each other; only what points inwards by more
     * than this leaves a body that it is in. */
    constexpr double inwards = 0.1;

    /** Relative to the size of faces: what closes by less in a cycle does not cross by anything.
     * Edges in a common plane, as in a fold that is symmetric, have a normal across that plane,
     * along which their motion is round-off. */
    constexpr double nothing = 1e-12;

    Point<dim>
    between(const Point<dim> &from, const Point<dim> &to, const double part)
    {
      return from + part * (to - from);
    }
  } // namespace



  // Groups of points are mostly told apart by the direction that has done so before, as it turns
  // with the faces; otherwise by their shortest difference at the start, and that at the end.
  template <class Groups>
  bool
  GeneralContact::stay_apart(const Groups       &groups,
                             const TurningFrame &frame,
                             const double        size,
                             const unsigned int  patience,
                             Separation         &known) const
  {
    double distance = -1.;
    if (known.known)
      distance = groups.distance_in_front(frame.turning(known.direction), enlarged);
    // With free velocities what is pressed together crosses: that says nothing of its direction.
    if (!(distance > 0.) && !(looks_ahead && known.known))
      {
        if (unsigned int &looks = known.hopeless[looks_ahead]; looks > 0)
          {
            --looks;
            return false;
          }
        const Tensor<1, dim> shortest = groups.shortest_difference(false);
        known.direction               = frame.components(shortest);
        distance = groups.distance_in_front(frame.turning(known.direction), enlarged);
        if (!(distance > 0.))
          distance =
            groups.distance_in_front({shortest, groups.shortest_difference(true)}, enlarged);
        known.known = distance > 0.;
        if (!known.known)
          known.hopeless[looks_ahead] = patience;
      }
    if (!(distance > 0.))
      return false;
    known.until = travelled + distance - reserve * size;
    return true;
  }



  void
  GeneralContact::find_open_faces()
  {
    open_faces.clear();
    for (const unsigned int number : near_pairs)
      {
        if (looks_ahead && !may_ask_ahead(number))
          continue;
        const ContactCandidates::FacePair &pair = candidates.face_pairs[number];
        const MovingCorners               &one  = moving.inner_corners(pair.one),
                            &other              = moving.inner_corners(pair.other);
        const double size                       = std::max(one.size, other.size);
        if (pair.share_node ||
            !stay_apart(TwoFaces{one, other}, one.frame, size, some_patience, apart_faces[number]))
          open_faces.push_back({number, size, one.frame});
        else
          face_limits.set(number, apart_faces[number].until);
      }
  }



  // A node of the finer side, or one that has pressed lately, that has no row yet.
  bool
  GeneralContact::counts_ahead(const unsigned int i) const
  {
    return !touches[i] && (is_slave(i) || impulses.presses_often(candidates.node_faces[i].node));
  }



  bool
  GeneralContact::may_ask_ahead(const unsigned int pair) const
  {
    const auto &[begin, of_pairs] = candidates.nodes_by_faces;
    for (unsigned int i = begin[pair]; i < begin[pair + 1]; ++i)
      if (!(apart_nodes[of_pairs[i]].until > travelled + travels) && counts_ahead(of_pairs[i]))
        return true;
    return false;
  }



  void
  GeneralContact::check_faces(const OpenFaces &faces, const Kind kind)
  {
    const auto each = [&](const ContactCandidates::ByFaces &by_faces,
                          std::vector<Separation>          &known,
                          const auto                       &check) {
      for (unsigned int i = by_faces.begin[faces.pair]; i < by_faces.begin[faces.pair + 1]; ++i)
        if (Separation &of = known[by_faces.numbers[i]]; !(of.until > travelled + travels))
          check(by_faces.numbers[i], of);
    };
    const ContactCandidates::FacePair &pair = candidates.face_pairs[faces.pair];
    if (kind == Kind::edges)
      each(candidates.edges_by_faces, apart_edges, [&](const unsigned int i, Separation &known) {
        check_edges(moving.ends_of(candidates.edge_pairs[i]), faces, known, i);
      });
    else if (kind == Kind::inner && pair.inner.any())
      check_inner_edges(pair, faces);
    else if (kind == Kind::slave_node || kind == Kind::node)
      each(candidates.nodes_by_faces, apart_nodes, [&](const unsigned int i, Separation &known) {
        const ContactCandidates::NodeFace &one = candidates.node_faces[i];
        if (looks_ahead ? counts_ahead(i) : is_slave(i) == (kind == Kind::slave_node))
          check_node({one.node, false}, one.face, faces, known);
      });
  }



  // All that belongs to the pair has been looked at: how long it stays apart.
  void
  GeneralContact::keep_until(const OpenFaces &faces)
  {
    double     until = candidates.face_pairs[faces.pair].inner.any()
                         ? apart_inner[faces.pair].until
                         : std::numeric_limits<double>::max();
    const auto least = [&](const ContactCandidates::ByFaces &by_faces,
                           const std::vector<Separation>    &known) {
      for (unsigned int i = by_faces.begin[faces.pair]; i < by_faces.begin[faces.pair + 1]; ++i)
        until = std::min(until, known[by_faces.numbers[i]].until);
    };
    least(candidates.nodes_by_faces, apart_nodes);
    least(candidates.edges_by_faces, apart_edges);
    face_limits.set(faces.pair, until);
  }



  void
  GeneralContact::check_node(const SurfacePoint &node,
                             const unsigned int  face,
                             const OpenFaces    &faces,
                             Separation         &known)
  {
    const NodeAndFace both{moving.inner_position(node, false),
                           moving.inner_position(node, true),
                           moving.inner_corners(face)};
    if (stay_apart(both, faces.frame, faces.size, some_patience, known))
      return;
    const unsigned int in_reach =
      both.triangles_in_reach(moving.inner_position(moving.middle(face), false),
                              moving.inner_position(moving.middle(face), true),
                              enlarged);
    // Where several triangles are crossed at once, as on the line between them, each has its row:
    // otherwise round-off would choose.
    std::array<std::optional<Crossing>, 4> crossed;
    double                                 first = std::numeric_limits<double>::max();
    for (unsigned int t = 0; t < 4; ++t)
      if (in_reach >> t & 1U)
        {
          crossed[t] = first_crossing_node_triangle(moving.node_and_triangle(node, face, t, false),
                                                    moving.node_and_triangle(node, face, t, true));
          if (crossed[t])
            first = std::min(first, crossed[t]->time);
        }
    for (unsigned int t = 0; t < 4; ++t)
      if (crossed[t] && crossed[t]->time <= first + tie)
        keep_out(node, face, t, *crossed[t]);
  }



  void
  GeneralContact::keep_out(const SurfacePoint &node,
                           const unsigned int  face,
                           const unsigned int  triangle,
                           const Crossing     &crossing)
  {
    const FourPoints a = moving.node_and_triangle(node, face, triangle, false),
                     b = moving.node_and_triangle(node, face, triangle, true);
    FourPoints     x;
    Tensor<1, dim> closing = b[0] - a[0];
    for (unsigned int i = 0; i < 4; ++i)
      {
        x[i] = between(a[i], b[i], crossing.time);
        if (i > 0)
          closing -= crossing.weights[i - 1] * (b[i] - a[i]);
      }
    Tensor<1, dim> normal = cross_product_3d(x[2] - x[1], x[3] - x[1]);
    if (normal.norm() == 0.)
      normal = moving.mean(moving.middle(face), &NodeMotion::normal);
    if (!(normal.norm() > 0.) || !(closing * normal < -nothing * moving.size(node) * normal.norm()))
      return; // it leaves the material
    // Of the triangle as it is.
    std::array<double, 3> weights = crossing.weights;
    for (double &weight : weights)
      weight += tie * (weight - 1. / 3.);
    found.push_back(node_row(moving, node, face, triangle, weights, normal / normal.norm()));
  }



  void
  GeneralContact::check_edges(const TwoEdges   &ends,
                              const OpenFaces  &faces,
                              Separation       &known,
                              const std::size_t pair)
  {
    FourPoints a, b;
    for (unsigned int side = 0; side < 4; side += 2)
      for (FourPoints *const x : {&a, &b})
        {
          const auto edge = moving.inner_edge({{ends[side], ends[side + 1]}}, x == &b);
          (*x)[side]      = edge[0];
          (*x)[side + 1]  = edge[1];
        }
    // Edges that rest on each other are never far apart, and what is bisected takes long.
    if (stay_apart(PointGroups<2, 4>{a, b}, faces.frame, faces.size, 0, known))
      return;
    const auto crossing = first_crossing_edge_edge(a, b);
    if (!crossing)
      return;
    std::array<double, 2> at_edges{{crossing->weights[0], crossing->weights[1]}};
    const Tensor<1, dim>  closing =
      between(b[0], b[1], at_edges[0]) - between(a[0], a[1], at_edges[0]) -
      (between(b[2], b[3], at_edges[1]) - between(a[2], a[3], at_edges[1]));
    std::array<Point<dim>, 4> x;
    for (unsigned int i = 0; i < 4; ++i)
      x[i] = between(a[i], b[i], crossing->time);
    const Tensor<1, dim> normal = edge_normal(ends, x[1] - x[0], x[3] - x[2], closing);
    if (!(closing * normal < -nothing * faces.size))
      return;
    for (double &at_edge : at_edges)
      at_edge += tie * (2. * at_edge - 1.);
    found.push_back(edge_row(moving, ends, at_edges, normal));
    found.back().edges = pair;
  }



  // Towards the side that the slave comes from; zero where that is within the master.
  Tensor<1, dim>
  GeneralContact::edge_normal(const TwoEdges       &ends,
                              const Tensor<1, dim> &e,
                              const Tensor<1, dim> &f,
                              const Tensor<1, dim> &closing) const
  {
    const Tensor<1, dim> out    = moving.outward(ends);
    Tensor<1, dim>       normal = cross_product_3d(e, f);
    if (normal.norm() > parallel * e.norm() * f.norm())
      normal *= (normal * closing > 0. ? -1. : 1.) / normal.norm();
    else
      {
        // Edges side by side: where the materials are.
        const Tensor<1, dim> along = e.norm() > f.norm() ? e : f;
        if (along.norm() == 0.)
          return Tensor<1, dim>();
        normal = out - (out * along) / along.norm_square() * along;
        if (normal.norm() == 0.)
          return Tensor<1, dim>();
        normal /= normal.norm();
      }
    return normal * out < -inwards * out.norm() ? Tensor<1, dim>() : normal;
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/edge_normal.h>
#include <touchstone/contact/search/far_side.h>
#include <touchstone/contact/search/search.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

// The master point that belongs to a slave node: the closest point over the faces nearby, with
// rules that make the choice unique and independent of the partition, keep it from alternating
// between faces from iteration to iteration, and recover nodes that have passed through a face
// (doc/theory.md 4, "Search" and "Passing through").
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** By the diagonal of a face that a node faces: so near to it the node does not meet faces that
     * it sees edge-on. */
    constexpr double near_facing = 0.1;

    double
    diagonal(const Face &face)
    {
      return face.position(0).distance(face.position(face.n_nodes() - 1));
    }



    /** Whether a point @p x whose closest point on a face lies on a sharp edge of it is in front of
     * the face beyond the edge. That one turns its back to the slave, or it would be closer: the
     * point is outside of the body there, and not behind the first face. */
    bool
    is_before_other_face(const FaceGeometry          &face,
                         const std::array<double, 2> &xi,
                         const Point<dim>            &foot,
                         const Point<dim>            &x)
    {
      Tensor<1, dim> edge;
      if (!face.sharp(xi, edge))
        return false;
      edge /= edge.norm();
      const Tensor<1, dim> n = face.normal(xi), direction = x - foot;
      const Tensor<1, dim> other = 2. * (edge * n) * edge - n;
      // Over a convex edge.
      return direction * other > 0. && (direction - (direction * n) * n) * other > 0.;
    }



    /** Whether a point is far from the contact point, about along the tangent plane. */
    bool
    is_beside(const ContactPartner &partner, const Point<dim> &x)
    {
      constexpr double     far      = 0.1;
      const Tensor<1, dim> from     = x - partner.x;
      const double         distance = from.norm();
      return distance > far * diagonal(*partner.face) &&
             std::abs(from * partner.normal) < Tolerances::perpendicular_cosine * distance;
    }



    /** Collects projections of a node on faces and keeps the closest one, and that on the face with
     * which the node is in contact. */
    class ClosestFace
    {
    public:
      ClosestFace(const SlavePoint &point, const double reach)
        : point(point)
        , best_square(reach * reach)
      {
      }

      void
      offer(const FaceProjection &candidate)
      {
        const Face  &face    = *candidate.face;
        const double square  = candidate.projection.distance_squared;
        const bool   present = point.in_contact && point.present_face == face.key;
        if (present)
          of_present_face = candidate;
        // The search must not end before the present face has been seen if it may still be kept.
        if (point.in_contact && point.present_face)
          margin = std::max(margin, Tolerances::keeps_face * diagonal(face));
        // Points on a common edge are equally close: the face with the smaller key gets
        // the node, on any number of ranks. Normals jump there a little, and meshes
        // that match or are symmetric put nodes there, where round-off or the jump itself
        // would choose a different face in each iteration. The tolerance is small, so that a node
        // that has just slid over the edge is not assigned to the face it came from.
        const double edge = Tolerances::between_faces * diagonal(face);
        const double tie  = Tolerances::equal_squares * square + edge * edge;
        if (square < best_square - tie)
          n_equal = 0;
        if (square < best_square + tie && n_equal < equal.size())
          equal[n_equal++] = candidate;
        if (square < best_square - tie ||
            (best.face && square < best_square + tie && face.key < best.face->key))
          {
            best_square = square;
            best        = candidate;
          }
      }

      /** No face that is farther away than @p distance is the closest one. */
      void
      bound(const double distance)
      {
        farthest = distance;
      }

      /** Whether a face that is not closer than @p distance need not be offered. */
      bool
      is_beyond(const Face &face, const double distance)
      {
        const double keeps = Tolerances::keeps_face * diagonal(face);
        if (distance <= std::min(farthest, std::sqrt(best_square)) + keeps ||
            (point.in_contact && point.present_face == face.key))
          return false;
        if (point.in_contact && point.present_face)
          margin = std::max(margin, keeps);
        return true;
      }

      /** Whether no face in a box at this distance (squared) can change the result. */
      bool
      excludes(const double box_square) const
      {
        return box_square > best_square && std::sqrt(box_square) > std::sqrt(best_square) + margin;
      }

      ClosestFaces
      result(const FaceExchange &exchange) const
      {
        ClosestFaces result;
        result.best = choice(exchange);
        if (result.best.face != best.face)
          return result;
        for (std::size_t i = 0; i < n_equal; ++i)
          {
            const double edge = Tolerances::between_faces * diagonal(*equal[i].face);
            if (equal[i].face != best.face &&
                equal[i].projection.distance_squared <
                  best_square * (1. + Tolerances::equal_squares) + edge * edge)
              result.equal.push_back(equal[i]);
          }
        std::sort(result.equal.begin(),
                  result.equal.end(),
                  [](const FaceProjection &a, const FaceProjection &b) {
                    return a.face->key < b.face->key;
                  });
        return result;
      }

    private:
      /** The best one, or the present one. */
      FaceProjection
      choice(const FaceExchange &exchange) const
      {
        // Between two faces that meet in a sharp edge a node in contact stays with the
        // present one: it would alternate between both otherwise. Within a smooth surface the
        // closest point is unique.
        if (!best.face || !of_present_face.face || best.face == of_present_face.face)
          return best;
        const double distance = std::sqrt(of_present_face.projection.distance_squared);
        const bool   as_close = distance < std::sqrt(best_square) +
                                           Tolerances::keeps_face * diagonal(*of_present_face.face);
        // The normals tell whether the two faces meet in a sharp edge.
        const auto normal = [&](const FaceProjection &candidate) {
          return exchange.geometry(*candidate.face).normal(candidate.projection.xi);
        };
        return as_close && normal(best) * normal(of_present_face) < Tolerances::sharp_edge_cosine
                 ? of_present_face
                 : best;
      }

      const SlavePoint &point;
      double            best_square, margin = 0.;
      double            farthest = std::numeric_limits<double>::max();
      FaceProjection    best, of_present_face;
      /** Those as close as the best one; more than eight faces do not meet. */
      std::array<FaceProjection, 8> equal;
      std::size_t                   n_equal = 0;
    };
  } // namespace



  Search::Search(const Surface     &master,
                 const double       reach,
                 const double       tolerance,
                 const MasterNormal kind,
                 const MPI_Comm     communicator,
                 const Arch         arch)
    : reach(reach)
    , tolerance(tolerance)
    , received(master, reach, kind, communicator, arch)
  {
  }



  void
  Search::update(const std::vector<Point<dim>> &positions)
  {
    drop_tree();
    received.update(positions);
  }



  void
  Search::drop_tree()
  {
    // Its counts go to the total; a new one is built when it is first needed.
    if (present_tree)
      candidates_before += present_tree->candidates();
    present_tree.reset();
  }



  const FaceTree &
  Search::tree() const
  {
    if (!present_tree)
      present_tree.emplace(received);
    return *present_tree;
  }



  SearchWork
  Search::work() const
  {
    SearchWork result = received.work();
    result.candidates = candidates_before + (present_tree ? present_tree->candidates() : 0);
    return result;
  }



  ClosestFaces
  Search::closest(const SlavePoint &point) const
  {
    if (const auto found = closest_near_guess(point))
      return *found;
    // The nearest boxes are requested a few at a time: an incremental query over all of them in
    // the order of their distance costs more the more boxes there are.
    constexpr unsigned int first_try = 16;
    for (unsigned int n = first_try;; n *= 4)
      {
        const auto  boxes    = tree().nearest(point.x, n);
        bool        complete = boxes.size() < n;
        ClosestFace closest(point, reach);
        for (const auto &[square, i] : boxes)
          {
            complete = complete || closest.excludes(square);
            if (closest.excludes(square))
              break;
            // Back faces belong to the far side of a thin body.
            if (!tree().may_be_closest(i, point))
              continue;
            if (const FaceProjection candidate = tree().project(point.x, received.faces()[i]);
                tree().meets(point, candidate))
              closest.offer(candidate);
          }
        // The nearest boxes were enough: no further box can have a closer point. Otherwise four
        // times as many are tried.
        if (complete)
          return closest.result(received);
      }
  }



  // The distance of any face bounds how far the closest one can be, so all that may be it are
  // within a small box. They are taken in the same order as without a guess, up to one that
  // excludes the rest: the result is the same whatever the guess was.
  std::optional<ClosestFaces>
  Search::closest_near_guess(const SlavePoint &point) const
  {
    if (!point.present_face)
      return {};
    const Face *const guess = received.face(*point.present_face, point.index_before);
    if (guess == nullptr || !tree().may_be_closest(received.index(*guess), point))
      return {};
    const FaceProjection projected = tree().project(point.x, *guess);
    if (!tree().meets(point, projected))
      return {};
    const double distance = std::sqrt(projected.projection.distance_squared);
    // Beyond what the rules of ties and of the present face can ask for.
    const double radius = distance + 3. * Tolerances::keeps_face * tree().largest_diagonal();
    if (radius >= reach)
      return {};
    ClosestFace closest(point, reach);
    closest.bound(distance);
    tree().within(point.x, radius, boxes);
    for (const auto &[square, i] : boxes)
      {
        if (closest.excludes(square))
          break;
        const Face &face = received.faces()[i];
        if (&face == guess)
          closest.offer(projected);
        else if (!closest.is_beyond(face, tree().least_distance(point.x, i)) &&
                 tree().may_be_closest(i, point))
          {
            if (const FaceProjection candidate = tree().project(point.x, face);
                tree().meets(point, candidate))
              closest.offer(candidate);
          }
      }
    return closest.result(received);
  }



  bool
  Search::ends_at(const SlavePoint &point, const FaceProjection &candidate) const
  {
    if (!point.is_plain || candidate.projection.beyond_inner <= 0.)
      return false;
    const Face        &face  = *candidate.face;
    const FaceGeometry shape = received.geometry(face);
    Tensor<1, dim>     mean;
    if (!shape.sharp(candidate.projection.xi, mean))
      return false;
    // Over the edge there are none but faces that the node sees edge-on.
    const Point<dim> foot = shape.evaluate(candidate.projection.xi).x;
    const double     near = Tolerances::touches_at_start * diagonal(face);
    FaceTree::Box    around({foot, foot});
    around.extend(near);
    for (const std::size_t i : tree().meeting(around))
      if (const Face &other = received.faces()[i];
          &other != &face && tree().may_be_closest(i, point) &&
          received.geometry(other).normal({{0., 0.}}) * shape.normal(candidate.projection.xi) <=
            Tolerances::sharp_edge_cosine &&
          tree().project(foot, other).projection.distance_squared < near * near)
        return false;
    return true;
  }



  ContactPartner
  Search::partner(const SlavePoint &point, const FaceProjection &candidate) const
  {
    const FaceGeometry shape = received.geometry(*candidate.face);
    ContactPartner     partner;
    partner.face              = candidate.face;
    partner.xi                = candidate.projection.xi;
    const FacePoint on_master = shape.evaluate(partner.xi);
    partner.x                 = on_master.x;
    partner.normal            = normal_over_edges(shape, partner.xi, on_master);
    // Beyond an edge at which xi was bounded and faces meet at a sharp angle, the normal of either
    // face is not the direction of the gap.
    Tensor<1, dim> edge;
    if (candidate.projection.beyond_inner > Tolerances::in_wedge && shape.sharp(partner.xi, edge) &&
        !ends_at(point, candidate))
      {
        // In the wedge over a sharp edge the normal is the direction to the edge; its sign comes
        // from the mean normal of the edge, the pseudonormal.
        const Tensor<1, dim> direction = point.x - partner.x;
        if (direction.norm() > Tolerances::on_the_edge_line * reach)
          partner.wedge = (direction * edge < 0. ? -1 : 1);
        // On the edge itself the direction is undefined: there the pseudonormal is taken.
        partner.normal = partner.wedge != 0 ? partner.wedge * direction : edge;
        partner.normal /= partner.normal.norm();
      }
    return partner;
  }



  std::optional<ContactPartner>
  Search::find(const SlavePoint &where) const
  {
    last_distance = reach;
    if (received.faces().empty())
      return {};
    SlavePoint   point = where;
    ClosestFaces faces = closest(point);
    // The end of a bar whose sides alone are named faces nothing else.
    if (point.is_plain &&
        (faces.best.face == nullptr || std::sqrt(faces.best.projection.distance_squared) >
                                         near_facing * diagonal(*faces.best.face)))
      {
        point.is_plain = false;
        faces          = closest(point);
      }
    // Beyond the end of the master surface there is no contact, up to a tolerance. It is larger for
    // nodes in contact (hysteresis), so that a node at the end does not open and close in turn.
    const auto on_surface = [&](const FaceProjection &candidate) {
      if (candidate.face == nullptr)
        return false;
      const Projection &projection = candidate.projection;
      const double      beyond     = ends_at(point, candidate)
                                       ? std::max(projection.beyond_outer, projection.beyond_inner)
                                       : projection.beyond_outer;
      return beyond <= (point.stays_at_end ? Tolerances::edge_hysteresis : 1.) * tolerance;
    };
    const FaceProjection &found = faces.best;
    last_distance = found.face != nullptr ? std::sqrt(found.projection.distance_squared) : reach;
    std::optional<ContactPartner> result;
    if (on_surface(found))
      result = partner(point, found);
    if (result && result->wedge < 0 &&
        is_before_other_face(received.geometry(*result->face), result->xi, result->x, point.x))
      result.reset();
    // Where faces that are closer are passed over this one ends at an edge. What was outside of the
    // body is not in that edge, and what is beside it, in the plane of the face, touches nothing.
    if (result &&
        (result->wedge < 0 ||
         (result->wedge == 0 && found.projection.beyond_inner > Tolerances::in_wedge &&
          found.projection.beyond_outer <= Tolerances::in_wedge && is_beside(*result, point.x))) &&
        was_outside(tree(), point.start, *result->face))
      result.reset();
    if (result)
      {
        for (const FaceProjection &equal : faces.equal)
          if (const ContactPartner other = partner(point, equal);
              on_surface(equal) && result->wedge == 0 && other.wedge == 0 &&
              other.normal * result->normal > Tolerances::sharp_edge_cosine)
            result->others.push_back(other);
      }
    if (!received.swept())
      return result;
    // Nothing that is farther away than anything has moved has been passed, and back faces do not
    // count in either search.
    if (!received.smoothed() &&
        last_distance >
          (1. + Tolerances::touches_at_start) * received.approach(point.x - point.start) +
            10. * Tolerances::touches_at_start * tree().largest_diagonal())
      return result;
    const bool penetrates = result && (point.x - result->x) * result->normal < 0.;
    // A small motion within this step cannot have carried the node through another face: the
    // penetration is that of the closest face. Saves the search along the path for most nodes in
    // contact.
    if (penetrates)
      {
        const Face    &face   = *result->face;
        Tensor<1, dim> motion = point.x - point.start;
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          motion -= (face.displacement[m] - face.committed[m]) / face.n_nodes();
        if (motion.norm() < Tolerances::small_motion * diagonal(face))
          return result;
      }
    // A crossed face counts only if the node is now clearly away from it or has no other partner:
    // a node that is just at a surface, inside or outside, has not passed through it.
    const auto other = swept().passed(point, penetrates);
    if (other && on_surface(*other) && tree().can_have_entered(point, *other) &&
        !(result && std::sqrt(other->projection.distance_squared) <
                      Tolerances::touching * diagonal(*other->face)))
      result = partner(point, *other);
    return result;
  }
} // namespace Touchstone

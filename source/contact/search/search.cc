#include <touchstone/contact/geometry/crossing.h>
#include <touchstone/contact/search/search.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

namespace Touchstone
{
  using namespace dealii;
  namespace bg  = boost::geometry;
  namespace bgi = boost::geometry::index;

  namespace
  {
    /** Of the size of a face: closer to it a node lies on its edge. */
    constexpr double on_edge = 1e-7;

    double
    half_diagonal(const BoundingBox<dim> &box)
    {
      const auto &[low, high] = box.get_boundary_points();
      return 0.5 * low.distance(high);
    }
  } // namespace



  Search::Search(const Surface     &master,
                 const double       reach,
                 const double       tolerance,
                 const MasterNormal kind,
                 const MPI_Comm     communicator)
    : master(master)
    , reach(reach)
    , tolerance(tolerance)
    , kind(kind)
    , communicator(communicator)
  {
  }



  Search::Box
  Search::bounding_box(const Face &face, const Displacements &displacement) const
  {
    Point<dim> lower, upper;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      {
        const Point<dim> x = face.reference[m] + displacement[m];
        for (unsigned int d = 0; d < dim; ++d)
          {
            lower[d] = m == 0 ? x[d] : std::min(lower[d], x[d]);
            upper[d] = m == 0 ? x[d] : std::max(upper[d], x[d]);
          }
      }
    // A curved face reaches beyond its nodes: by less than half its size, or it
    // would be bent by more than a right angle.
    const bool   curved = face.degree > 1 || kind == MasterNormal::smoothed;
    const double margin = 0.25 * lower.distance(upper) * (curved ? 1. : 0.5);
    Box          box({lower, upper});
    box.extend(margin);
    return box;
  }



  Search::Box
  Search::swept_box(const Face &face) const
  {
    Box box = bounding_box(face, face.displacement);
    if (swept)
      box.merge_with(bounding_box(face, face.committed));
    return box;
  }



  void
  Search::commit(const Vector *u)
  {
    swept = true;
    committed.assign(master.owned_faces().size(), {});
    if (u != nullptr)
      for (std::size_t f = 0; f < committed.size(); ++f)
        {
          const Face &face = master.owned_faces()[f];
          for (unsigned int m = 0; m < face.n_nodes(); ++m)
            for (unsigned int d = 0; d < dim; ++d)
              committed[f][m][d] = (*u)(dim * face.nodes[m] + d);
        }
  }



  void
  Search::update(const std::vector<Point<dim>> &positions)
  {
    // The capture box of this rank's slave nodes; empty boxes are inside out.
    std::array<double, 6> capture;
    for (unsigned int d = 0; d < dim; ++d)
      {
        capture[d]       = std::numeric_limits<double>::max();
        capture[dim + d] = std::numeric_limits<double>::lowest();
      }
    for (const Point<dim> &x : positions)
      for (unsigned int d = 0; d < dim; ++d)
        {
          capture[d]       = std::min(capture[d], x[d] - reach);
          capture[dim + d] = std::max(capture[dim + d], x[d] + reach);
        }

    faces.clear();
    by_key.clear();
    node_numbers.clear();
    sent.clear();
    received.clear();
    const unsigned int       n_ranks   = Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int       this_rank = Utilities::MPI::this_mpi_process(communicator);
    const std::vector<Face> &own       = master.owned_faces();
    if (n_ranks == 1)
      {
        faces = own;
        for (std::size_t f = 0; f < committed.size(); ++f)
          faces[f].committed = committed[f];
      }
    else
      {
        const auto captures =
          Utilities::MPI::all_gather(communicator,
                                     std::vector<double>(capture.begin(), capture.end()));
        std::map<unsigned int, std::vector<char>> packages;
        for (std::size_t f = 0; f < own.size(); ++f)
          {
            Face face = own[f];
            if (!committed.empty())
              face.committed = committed[f];
            const Box box = swept_box(face);
            for (unsigned int rank = 0; rank < n_ranks; ++rank)
              {
                const auto &c     = captures[rank];
                bool        meets = (c[0] <= c[dim]);
                for (unsigned int d = 0; d < dim; ++d)
                  meets = meets && box.lower_bound(d) <= c[dim + d] && box.upper_bound(d) >= c[d];
                if (!meets)
                  continue;
                sent[rank].push_back(f);
                if (rank == this_rank)
                  {
                    faces.push_back(face);
                    continue;
                  }
                const char *data = reinterpret_cast<const char *>(&face);
                packages[rank].insert(packages[rank].end(), data, data + sizeof(Face));
              }
          }
        if (!faces.empty())
          received[this_rank] = 0;
        for (const auto &[rank, places] : sent)
          if (rank != this_rank)
            {
              ++counted.messages;
              counted.faces_sent += places.size();
            }
        for (const auto &[rank, package] : Utilities::MPI::some_to_some(communicator, packages))
          {
            const std::size_t first = faces.size();
            received[rank]          = first;
            faces.resize(first + package.size() / sizeof(Face));
            std::memcpy(static_cast<void *>(faces.data() + first), package.data(), package.size());
          }
      }
    located_now.reset();
  }



  const Search::Located &
  Search::located() const
  {
    if (located_now)
      return *located_now;
    Located                                 &result = located_now.emplace();
    std::vector<std::pair<Box, std::size_t>> boxes, swept_boxes;
    for (std::size_t i = 0; i < faces.size(); ++i)
      {
        boxes.emplace_back(bounding_box(faces[i], faces[i].displacement), i);
        if (swept)
          swept_boxes.emplace_back(swept_box(faces[i]), i);
        const FacePoint middle = evaluate(faces[i], master.exact_surface(faces[i]), {{0., 0.}});
        const Box      &box    = boxes.back().first;
        result.outlines.push_back({middle.normal(), box.center(), half_diagonal(box)});
      }
    result.tree       = pack_rtree(boxes);
    result.swept_tree = pack_rtree(swept_boxes);
    return result;
  }



  bool
  Search::may_cross(const SlavePoint &point, const Face &face) const
  {
    const Box before = bounding_box(face, face.committed),
              after  = bounding_box(face, face.displacement);
    bool around      = true;
    for (unsigned int d = 0; d < dim; ++d)
      around =
        around &&
        std::min(before.lower_bound(d) - point.start[d], after.lower_bound(d) - point.x[d]) <= 0. &&
        std::max(before.upper_bound(d) - point.start[d], after.upper_bound(d) - point.x[d]) >= 0.;
    return around;
  }



  namespace
  {
    double
    size(const Face &face)
    {
      const unsigned int last = face.n_nodes() - 1;
      return (face.reference[0] + face.displacement[0])
        .distance(face.reference[last] + face.displacement[last]);
    }

    /** A face that looks the same way as the slave surface, by the cosine of the angle
     * between both, is on the far side of its body. */
    constexpr double far_side = 0.3;

    /** A node in contact stays with its face across a sharp edge unless another is
     * closer by this fraction of the face. */
    constexpr double hold = 1e-3;
  } // namespace



  std::vector<const Face *>
  Search::near(const Box &box, const Tensor<1, dim> &slave_normal) const
  {
    Box capture = box;
    capture.extend(reach);
    const double radius = half_diagonal(box);
    // In the order of their keys, so that sums do not depend on the partition.
    std::vector<const Face *> result;
    const Located            &now = located();
    for (auto it = now.tree.qbegin(bgi::intersects(capture)); it != now.tree.qend(); ++it)
      {
        const Face    &face    = faces[it->second];
        const Outline &outline = now.outlines[it->second];
        ++counted.candidates;
        // Only those over the box or under it, seen along the normal, cover any of it.
        const Tensor<1, dim> way = outline.centre - box.center();
        const bool           beside =
          (way - (way * slave_normal) * slave_normal).norm() > outline.radius + radius;
        if (outline.normal * slave_normal < -0.1 && !beside)
          result.push_back(&face);
      }
    std::sort(result.begin(), result.end(), [](const Face *a, const Face *b) {
      return a->key < b->key;
    });
    return result;
  }



  std::vector<unsigned int>
  Search::layers(const std::vector<const Face *> &some) const
  {
    constexpr unsigned int none = numbers::invalid_unsigned_int;
    if (node_numbers.empty())
      {
        std::unordered_map<Index, unsigned int> known;
        node_numbers.resize(faces.size());
        for (std::size_t f = 0; f < faces.size(); ++f)
          for (unsigned int m = 0; m < faces[f].n_nodes(); ++m)
            node_numbers[f][m] = known.emplace(faces[f].nodes[m], known.size()).first->second;
        first_at_node.assign(known.size(), none);
      }

    std::vector<unsigned int> parent(some.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&parent](unsigned int i) {
      while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
      return i;
    };
    for (unsigned int i = 0; i < some.size(); ++i)
      for (unsigned int m = 0; m < some[i]->n_nodes(); ++m)
        {
          unsigned int &first = first_at_node[node_numbers[place(*some[i])][m]];
          if (first == none)
            first = i;
          else
            parent[root(i)] = root(first);
        }
    for (unsigned int i = 0; i < some.size(); ++i)
      {
        parent[i] = root(i);
        for (unsigned int m = 0; m < some[i]->n_nodes(); ++m)
          first_at_node[node_numbers[place(*some[i])][m]] = none;
      }
    return parent;
  }



  const Face *
  Search::entry(const SlavePoint &point) const
  {
    const auto candidate = swept ? passed(point, false) : std::nullopt;
    return candidate ? candidate->face : nullptr;
  }



  const Face *
  Search::face(const std::uint64_t key) const
  {
    if (by_key.empty())
      for (std::size_t i = 0; i < faces.size(); ++i)
        by_key.emplace(faces[i].key, i);
    const auto found = by_key.find(key);
    return found == by_key.end() ? nullptr : &faces[found->second];
  }



  FaceGeometry
  Search::geometry(const Face &face) const
  {
    return FaceGeometry(face, master.exact_surface(face), kind);
  }



  Search::Candidate
  Search::closest(const SlavePoint &point) const
  {
    // Boxes are asked for a few at a time: an iterator over all of them, in the order of
    // their distance, costs more the more there are.
    constexpr unsigned int first_try     = 16;
    const Located         &now           = located();
    const Point<dim>      &x             = point.x;
    double                 best_distance = 0., margin = 0.;
    Candidate              best, present;
    bool                   complete = false;
    for (unsigned int n = first_try; !complete; n *= 4)
      {
        std::vector<std::pair<double, std::size_t>> boxes;
        for (auto it = now.tree.qbegin(bgi::nearest(x, n)); it != now.tree.qend(); ++it)
          boxes.emplace_back(bg::comparable_distance(x, it->first), it->second);
        std::sort(boxes.begin(), boxes.end());
        complete      = boxes.size() < n;
        best_distance = reach * reach;
        margin        = 0.;
        best = present = Candidate();
        for (const auto &[distance, place] : boxes)
          {
            if (distance > best_distance && std::sqrt(distance) > std::sqrt(best_distance) + margin)
              {
                complete = true;
                break;
              }
            const Face &face = faces[place];
            if (now.outlines[place].normal * point.normal > far_side)
              continue;
            const Projection projection = closest_point_projection(x, geometry(face));
            ++counted.candidates;
            if (point.in_contact && point.present_face == face.key)
              present = {&face, projection};
            if (point.in_contact && point.present_face)
              margin = std::max(margin, hold * size(face));
            // Points on a common edge are equally close: the face with the smaller key gets
            // the node, on any number of ranks. Normals jump there a little, and meshes
            // that match or are symmetric put nodes there, where round-off or the jump itself
            // would choose now this face and now that one. But a node that has just slid over
            // the edge must not be called back to it.
            const double edge = on_edge * size(face);
            const double tie  = 1e-12 * projection.distance_squared + edge * edge;
            if (projection.distance_squared < best_distance - tie ||
                (best.face && projection.distance_squared < best_distance + tie &&
                 face.key < best.face->key))
              {
                best_distance = projection.distance_squared;
                best          = {&face, projection};
              }
          }
      }

    // Between two faces that meet in a sharp edge a node in contact stays with the
    // present one: it would go to and fro otherwise. Within a smooth surface the
    // closest point is unique.
    if (best.face && present.face && best.face != present.face &&
        std::sqrt(present.projection.distance_squared) <
          std::sqrt(best_distance) + hold * size(*present.face) &&
        geometry(*best.face).normal(best.projection.xi) *
            geometry(*present.face).normal(present.projection.xi) <
          0.64)
      return present;
    return best;
  }



  Search::Candidate
  Search::walk(const SlavePoint &point, const Face &from) const
  {
    const Located &now = located();
    Candidate      best{&from, closest_point_projection(point.x, geometry(from))};
    while (best.projection.beyond_inner > 0.)
      {
        const Face &face  = *best.face;
        const Box   box   = bounding_box(face, face.displacement);
        Candidate   found = best;
        for (auto it = now.tree.qbegin(bgi::intersects(box)); it != now.tree.qend(); ++it)
          {
            const Face &other = faces[it->second];
            const auto  end   = face.nodes.begin() + face.n_nodes();
            if (std::find_first_of(other.nodes.begin(),
                                   other.nodes.begin() + other.n_nodes(),
                                   face.nodes.begin(),
                                   end) == other.nodes.begin() + other.n_nodes() ||
                now.outlines[it->second].normal * point.normal > far_side)
              continue;
            const Projection projection = closest_point_projection(point.x, geometry(other));
            ++counted.candidates;
            const double tie = 1e-12 * reach * reach;
            if (projection.distance_squared < found.projection.distance_squared - tie)
              found = {&other, projection};
          }
        if (found.face == best.face)
          break;
        best = found;
      }
    return best;
  }



  std::optional<Search::Candidate>
  Search::passed(const SlavePoint &point, const bool penetrates) const
  {
    const Located &now = located();
    Box            path({point.x, point.x});
    path.merge_with(Box({point.start, point.start}));
    std::vector<std::pair<Crossing, const Face *>> crossings;
    for (auto it = now.swept_tree.qbegin(bgi::intersects(path)); it != now.swept_tree.qend(); ++it)
      {
        const Face &face = faces[it->second];
        if (now.outlines[it->second].normal * point.normal > far_side || !may_cross(point, face))
          continue;
        ++counted.candidates;
        if (const auto found = crossing(point.start, point.x, face, master.exact_surface(face)))
          crossings.emplace_back(*found, &face);
      }
    std::sort(crossings.begin(), crossings.end(), [](const auto &a, const auto &b) {
      return a.first.time != b.first.time ? a.first.time < b.first.time
                                          : a.second->key < b.second->key;
    });

    // How many bodies the node is in, and where it went into the first of them.
    int         depth = 0;
    const Face *entry = nullptr;
    for (std::size_t i = 0; i < crossings.size(); ++i)
      {
        const Crossing &c = crossings[i].first;
        // Faces that meet in an edge are passed together.
        if (i > 0 && c.inward == crossings[i - 1].first.inward &&
            c.time - crossings[i - 1].first.time < 1e-8)
          continue;
        if (c.inward && depth == 0)
          entry = crossings[i].second;
        depth = std::max(0, depth + (c.inward ? 1 : -1));
      }
    if (depth <= (penetrates ? 1 : 0))
      return {};
    return walk(point, *entry);
  }



  ContactPartner
  Search::partner(const SlavePoint &point, const Candidate &candidate) const
  {
    const FaceGeometry shape = geometry(*candidate.face);
    ContactPartner     partner;
    partner.face = candidate.face;
    partner.xi   = candidate.projection.xi;
    std::tie(partner.x, partner.normal) =
      shape.position_and_normal(partner.xi, FaceShapes(shape.face().degree, partner.xi));
    Tensor<1, dim> edge;
    if (candidate.projection.beyond_inner > 1e-6 && shape.sharp(partner.xi, edge))
      {
        // In the wedge over a sharp edge the shortest way leads to the edge.
        const Tensor<1, dim> way = point.x - partner.x;
        if (way.norm() > 1e-8 * reach)
          partner.wedge = (way * edge < 0. ? -1 : 1);
        partner.normal = partner.wedge != 0 ? partner.wedge * way : edge;
        partner.normal /= partner.normal.norm();
      }
    return partner;
  }



  std::optional<ContactPartner>
  Search::find(const SlavePoint &point) const
  {
    if (faces.empty())
      return {};
    const auto on_surface = [&](const Candidate &candidate) {
      return candidate.face != nullptr &&
             candidate.projection.beyond_outer <= (point.in_contact ? 5. : 1.) * tolerance;
    };
    const Candidate               found = closest(point);
    std::optional<ContactPartner> result;
    if (on_surface(found))
      result = partner(point, found);
    if (swept)
      {
        const bool penetrates = result && (point.x - result->x) * result->normal < 0.;
        if (penetrates)
          {
            // What moves less than a tenth of a face does not reach another body.
            const Face    &face   = *result->face;
            Tensor<1, dim> motion = point.x - point.start;
            for (unsigned int m = 0; m < face.n_nodes(); ++m)
              motion -= (face.displacement[m] - face.committed[m]) / face.n_nodes();
            if (motion.norm() < 0.1 * size(face))
              return result;
          }
        // Nor does a node that is about on the surface, up to round-off in or out.
        const auto other = passed(point, penetrates);
        if (other && on_surface(*other) &&
            !(result && std::sqrt(other->projection.distance_squared) < hold * size(*other->face)))
          result = partner(point, *other);
      }
    return result;
  }



  std::unordered_map<const Face *, std::vector<NormalDerivative>>
  Search::normal_derivatives(const std::vector<const Face *> &needed) const
  {
    std::unordered_map<const Face *, std::vector<NormalDerivative>> result;
    if (kind == MasterNormal::face)
      return result;
    for (const Face *face : needed)
      result[face];
    if (Utilities::MPI::n_mpi_processes(communicator) == 1)
      {
        for (auto &[face, derivative] : result)
          derivative = master.normal_derivative(master.owned_faces()[face - faces.data()]);
        return result;
      }

    // Asked for by their places in what was sent; answered as plain data.
    using Answer = std::pair<std::size_t, NormalDerivative>;
    std::map<unsigned int, std::vector<std::size_t>> questions;
    for (const auto &[face, derivative] : result)
      {
        const std::size_t f    = face - faces.data();
        auto              from = received.end();
        for (auto it = received.begin(); it != received.end(); ++it)
          if (it->second <= f && (from == received.end() || it->second > from->second))
            from = it;
        questions[from->first].push_back(f - from->second);
      }
    std::map<unsigned int, std::vector<char>> answers;
    for (const auto &[rank, places] : Utilities::MPI::some_to_some(communicator, questions))
      for (const std::size_t place : places)
        for (const NormalDerivative &derivative :
             master.normal_derivative(master.owned_faces()[sent.at(rank)[place]]))
          {
            const Answer      answer(place, derivative);
            auto             &package = answers[rank];
            const std::size_t size    = package.size();
            package.resize(size + sizeof(Answer));
            std::memcpy(package.data() + size, static_cast<const void *>(&answer), sizeof(Answer));
          }
    for (const auto &[rank, package] : Utilities::MPI::some_to_some(communicator, answers))
      for (std::size_t i = 0; i < package.size(); i += sizeof(Answer))
        {
          Answer answer;
          std::memcpy(static_cast<void *>(&answer), package.data() + i, sizeof(Answer));
          result[&faces[received.at(rank) + answer.first]].push_back(answer.second);
        }
    return result;
  }
} // namespace Touchstone

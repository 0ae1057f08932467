#include <touchstone/contact/search.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

namespace Touchstone
{
  using namespace dealii;
  namespace bg  = boost::geometry;
  namespace bgi = boost::geometry::index;

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
  Search::bounding_box(const Face &face) const
  {
    Point<dim> lower, upper;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      {
        const Point<dim> x = face.reference[m] + face.displacement[m];
        for (unsigned int d = 0; d < dim; ++d)
          {
            lower[d] = m == 0 ? x[d] : std::min(lower[d], x[d]);
            upper[d] = m == 0 ? x[d] : std::max(upper[d], x[d]);
          }
      }
    // A curved face reaches beyond its nodes: by less than half its size, or it
    // would be bent by more than a right angle.
    const double margin = 0.25 * lower.distance(upper) * (face.degree == 1 ? 0.5 : 1.);
    Box          box({lower, upper});
    box.extend(margin);
    return box;
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
    sent.clear();
    received.clear();
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    if (n_ranks == 1)
      faces = master.owned_faces();
    else
      {
        const auto captures =
          Utilities::MPI::all_gather(communicator,
                                     std::vector<double>(capture.begin(), capture.end()));
        std::map<unsigned int, std::vector<char>> packages;
        for (std::size_t f = 0; f < master.owned_faces().size(); ++f)
          {
            const Face &face = master.owned_faces()[f];
            const Box   box  = bounding_box(face);
            for (unsigned int rank = 0; rank < n_ranks; ++rank)
              {
                const auto &c     = captures[rank];
                bool        meets = (c[0] <= c[dim]);
                for (unsigned int d = 0; d < dim; ++d)
                  meets = meets && box.lower_bound(d) <= c[dim + d] && box.upper_bound(d) >= c[d];
                if (!meets)
                  continue;
                sent[rank].push_back(f);
                auto             &package = packages[rank];
                const std::size_t size    = package.size();
                package.resize(size + sizeof(Face));
                std::memcpy(package.data() + size, static_cast<const void *>(&face), sizeof(Face));
              }
          }
        for (const auto &[rank, package] : Utilities::MPI::some_to_some(communicator, packages))
          {
            const std::size_t first = faces.size();
            received[rank]          = first;
            faces.resize(first + package.size() / sizeof(Face));
            std::memcpy(static_cast<void *>(faces.data() + first), package.data(), package.size());
          }
      }

    std::vector<std::pair<Box, std::size_t>> boxes;
    boxes.reserve(faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i)
      boxes.emplace_back(bounding_box(faces[i]), i);
    tree = pack_rtree(boxes);
  }



  namespace
  {
    /** A face that looks the same way as the slave surface is on the far side of
     * its body. @return the cosine of the angle between both. */
    double
    same_way(const Face &face, const AnalyticSurface *exact, const Tensor<1, dim> &slave_normal)
    {
      return evaluate(face, exact, {{0., 0.}}).normal() * slave_normal;
    }
  } // namespace



  void
  Search::for_each_near(const Box                               &box,
                        const Tensor<1, dim>                    &slave_normal,
                        const std::function<void(const Face &)> &visit) const
  {
    Box capture = box;
    capture.extend(reach);
    // In the order of their keys, so that sums do not depend on the partition.
    std::vector<const Face *> near;
    for (auto it = tree.qbegin(bgi::intersects(capture)); it != tree.qend(); ++it)
      {
        const Face &face = faces[it->second];
        if (same_way(face, master.exact_surface(face), slave_normal) < -0.1)
          near.push_back(&face);
      }
    std::sort(near.begin(), near.end(), [](const Face *a, const Face *b) {
      return a->key < b->key;
    });
    for (const Face *face : near)
      visit(*face);
  }



  FaceGeometry
  Search::geometry(const Face &face) const
  {
    return FaceGeometry(face, master.exact_surface(face), kind);
  }



  std::optional<ContactPartner>
  Search::find(const Point<dim> &x, const Tensor<1, dim> &slave_normal, const bool in_contact) const
  {
    if (faces.empty())
      return {};
    double      best_distance = reach * reach;
    const Face *best          = nullptr;
    Projection  best_projection;
    for (auto it = tree.qbegin(bgi::nearest(x, static_cast<unsigned int>(faces.size())));
         it != tree.qend();
         ++it)
      {
        if (bg::comparable_distance(x, it->first) > best_distance)
          break;
        const Face            &face  = faces[it->second];
        const AnalyticSurface *exact = master.exact_surface(face);
        if (same_way(face, exact, slave_normal) > 0.3)
          continue;
        const Projection projection = closest_point_projection(x, geometry(face));
        // Points on a common edge are equally close up to round-off: the face
        // with the smaller key gets the node, on any number of ranks. But a node
        // that has just slid over the edge must not be called back to it.
        const double tie = 1e-12 * projection.distance_squared + 1e-26 * reach * reach;
        if (projection.distance_squared < best_distance - tie ||
            (best && projection.distance_squared < best_distance + tie && face.key < best->key))
          {
            best_distance   = projection.distance_squared;
            best            = &face;
            best_projection = projection;
          }
      }
    if (best == nullptr || best_projection.beyond_outer > (in_contact ? 5. : 1.) * tolerance)
      return {};

    const FaceGeometry shape = geometry(*best);
    ContactPartner     partner{best,
                           best_projection.xi,
                           shape.evaluate(best_projection.xi).x,
                           shape.normal(best_projection.xi)};
    Tensor<1, dim>     edge;
    if (best_projection.beyond_inner > 1e-6 && shape.sharp(partner.xi, edge))
      {
        // In the wedge over a sharp edge the shortest way leads to the edge.
        const Tensor<1, dim> way = x - partner.x;
        if (way.norm() > 1e-8 * reach)
          partner.wedge = (way * edge < 0. ? -1 : 1);
        partner.normal = partner.wedge != 0 ? partner.wedge * way : edge;
        partner.normal /= partner.normal.norm();
      }
    return partner;
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
        auto              from = received.begin();
        for (auto it = received.begin(); it != received.end(); ++it)
          if (it->second <= f && it->second >= from->second)
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

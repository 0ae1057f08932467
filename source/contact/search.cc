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

  Search::Search(const Surface &master,
                 const double   reach,
                 const double   tolerance,
                 const MPI_Comm communicator)
    : master(master)
    , reach(reach)
    , tolerance(tolerance)
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
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    if (n_ranks == 1)
      faces = master.owned_faces();
    else
      {
        const auto captures =
          Utilities::MPI::all_gather(communicator,
                                     std::vector<double>(capture.begin(), capture.end()));
        std::map<unsigned int, std::vector<char>> packages;
        for (const Face &face : master.owned_faces())
          {
            const Box box = bounding_box(face);
            for (unsigned int rank = 0; rank < n_ranks; ++rank)
              {
                const auto &c     = captures[rank];
                bool        meets = (c[0] <= c[dim]);
                for (unsigned int d = 0; d < dim; ++d)
                  meets = meets && box.lower_bound(d) <= c[dim + d] && box.upper_bound(d) >= c[d];
                if (!meets)
                  continue;
                auto             &package = packages[rank];
                const std::size_t size    = package.size();
                package.resize(size + sizeof(Face));
                std::memcpy(package.data() + size, static_cast<const void *>(&face), sizeof(Face));
              }
          }
        for (const auto &[rank, package] : Utilities::MPI::some_to_some(communicator, packages))
          {
            const std::size_t first = faces.size();
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
    /** Such a face is on the far side of its body. */
    bool
    looks_the_same_way(const Face            &face,
                       const AnalyticSurface *exact,
                       const Tensor<1, dim>  &slave_normal)
    {
      return evaluate(face, exact, {{0., 0.}}).normal() * slave_normal > 0.3;
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
        if (!looks_the_same_way(face, master.exact_surface(face), slave_normal))
          near.push_back(&face);
      }
    std::sort(near.begin(), near.end(), [](const Face *a, const Face *b) {
      return a->key < b->key;
    });
    for (const Face *face : near)
      visit(*face);
  }



  Tensor<1, dim>
  Search::normal(const Face &face, const std::array<double, 2> &xi) const
  {
    const AnalyticSurface *exact = master.exact_surface(face);
    const FaceShapes       shapes(face.degree, xi);
    Tensor<1, dim>         result;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      result += shapes.value[m] * face.normals[m];
    if (exact)
      {
        result += evaluate(face, exact, xi).normal();
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          result -= shapes.value[m] * evaluate(face, exact, node_coordinates(face, m)).normal();
      }
    return result / result.norm();
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
        if (looks_the_same_way(face, exact, slave_normal))
          continue;
        const Projection projection = closest_point_projection(x, face, exact);
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

    const AnalyticSurface *exact = master.exact_surface(*best);
    const FacePoint        point = evaluate(*best, exact, best_projection.xi);
    ContactPartner partner{best, best_projection.xi, point.x, normal(*best, best_projection.xi)};
    if (best_projection.beyond_inner > 1e-6)
      {
        const FaceShapes shapes(best->degree, best_projection.xi);
        Tensor<1, dim>   edge;
        for (unsigned int m = 0; m < best->n_nodes(); ++m)
          edge += shapes.value[m] * best->edge_normals[m];
        if (partner.normal * edge < 0.999 * edge.norm())
          {
            // In the wedge over a sharp edge the shortest way leads to the edge.
            const Tensor<1, dim> way = x - point.x;
            partner.normal = way.norm() > 1e-8 * reach ? (way * edge < 0. ? -way : way) : edge;
            partner.normal /= partner.normal.norm();
          }
      }
    return partner;
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/contact/entered_faces.h>
#include <touchstone/contact/geometry/measured_face.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/mpi.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A face that is nearer than this, by the depth behind the other one, is the one that a point
     * has come through, also if nothing resists it there. */
    constexpr double nearer = 0.5;
  } // namespace



  std::vector<bool>
  have_come_through(const std::vector<PointBehindFace>      &points,
                    const Surface                           &surface,
                    const Vector                            &u,
                    const std::function<bool(const Face &)> &carries,
                    const MPI_Comm                           communicator)
  {
    const auto                   of_ranks = gather_records(points, communicator);
    std::vector<PointBehindFace> all;
    std::size_t                  begin = 0;
    for (unsigned int rank = 0; rank < of_ranks.size(); ++rank)
      {
        if (rank == Utilities::MPI::this_mpi_process(communicator))
          begin = all.size();
        all.insert(all.end(), of_ranks[rank].begin(), of_ranks[rank].end());
      }
    if (all.empty())
      return {};
    std::vector<std::pair<BoundingBox<dim>, std::size_t>> around;
    for (std::size_t k = 0; k < all.size(); ++k)
      {
        around.emplace_back(BoundingBox<dim>({all[k].x, all[k].x}), k);
        around.back().first.extend(all[k].depth);
      }
    const auto       tree = pack_rtree(around);
    std::vector<int> through_another(all.size(), 0);
    for (const Face &owned : surface.owned_faces())
      {
        const Face face = MeasuredFace::displaced(owned, u);
        namespace query = boost::geometry::index;
        const MeasuredFace measured(face, surface.exact_surface(owned));
        // Arcs bulge out of the box of the nodes.
        const auto   box  = MeasuredFace::box_around(face, measured.size());
        const double most = carries(owned) ? 1. : nearer;
        for (const auto &[unused, k] : tree | query::adaptors::queried(query::intersects(box)))
          {
            if (through_another[k])
              continue;
            const PointBehindFace &point = all[k];
            MeasuredFace::Xi       xi;
            const auto             depth = measured.depth(point.x, -measured.size(), xi);
            if (depth && std::abs(*depth) < most * point.depth &&
                std::abs(evaluate(face, measured.exact, xi).normal() * point.normal) <
                  Tolerances::about_normal)
              through_another[k] = 1;
          }
      }
    Utilities::MPI::max(through_another, communicator, through_another);
    std::vector<bool> result(points.size());
    for (std::size_t k = 0; k < points.size(); ++k)
      result[k] = (through_another[begin + k] == 0);
    return result;
  }
} // namespace Touchstone

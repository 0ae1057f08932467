// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/lanes.h>
#include <touchstone/explicit/row_geometry.h>
#include <touchstone/explicit/row_motion.h>

#include <algorithm>
#include <cmath>
#include <limits>

// When rows are renewed. Between two renewals gaps are linear in the positions of the nodes, with
// normals and weights as they were; the criteria bound by how much these could be others by now.
// They compare lengths with sizes of faces, and one rank's yes is all ranks' yes.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Sliding over the partner, relative to the size of a face: weights are off by as much. */
    constexpr double slides = 0.01;
    /** The same relative to the gap of a node that is apart: what it faces when it arrives is found
     * on its way. */
    constexpr double slides_apart = 0.25;
    /** Motion of a node without partner relative to its distance from the master surface: it cannot
     * have come there yet. */
    constexpr double on_its_way = 0.75;
    /** Change of the edges of a face relative to its size: normals are off by as much, in radians.
     */
    constexpr double turns = 1e-3;
    /** As long as all rows are apart faces may turn so far, and no farther than 'slides_apart' says
     * of the smallest gap. */
    constexpr double turns_apart = 0.1;
  } // namespace



  RowMotion::RowMotion(const Contact &contact, const NodeMap &nodes)
    : contact(contact)
    , nodes(nodes)
    , masters(contact.n_pairs())
    , slaves(contact.n_pairs())
    , searching(contact.n_pairs(), false)
  {
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      {
        const ContactPair &pair = contact.pair(p);
        // Pairs that are small keep the pairing of the reference state, and obstacles are met where
        // they are.
        if (!pair.master() || pair.small_sliding())
          continue;
        for (const Surface *const surface : {&pair.slave(), pair.master()})
          for (const Face &face : surface->owned_faces())
            {
              WatchedFace watched;
              for (unsigned int m = 0; m < 4; ++m)
                watched.corners[m] = nodes.local(dim * face.nodes[m]);
              watched.size = std::sqrt(0.5 * cross_product_3d(face.reference[3] - face.reference[0],
                                                              face.reference[2] - face.reference[1])
                                               .norm());
              faces.push_back(watched);
              if (surface == pair.master())
                masters[p].insert(masters[p].end(), watched.corners.begin(), watched.corners.end());
            }
        std::sort(masters[p].begin(), masters[p].end());
        masters[p].erase(std::unique(masters[p].begin(), masters[p].end()), masters[p].end());
        for (const ContactRow &row : pair.rows())
          slaves[p].push_back({nodes.local(dim * row.slave), row.size, row.index});
      }
  }



  void
  RowMotion::restart(const NodeField &u, const std::vector<std::size_t> &rows)
  {
    made_at    = u;
    safe_until = Safe();
    // Its owner knows the displacement of a ghost better than this rank may do at present.
    nodes.update_ghosts(made_at);
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      {
        int some = 0;
        for (const WatchedNode &slave : slaves[p])
          some |= !contact.rows()[slave.row].get().has_partner;
        searching[p] = Utilities::MPI::max(some, nodes.communicator()) > 0;
      }
    sliding.clear();
    least_gap = std::numeric_limits<double>::max();
    for (std::size_t k = 0; k < rows.size(); ++k)
      {
        const ContactRow  &row  = contact.rows()[rows[k]];
        const ContactPair &pair = contact.pair(row);
        if (!row.stencil.empty() && !pair.small_sliding())
          {
            const double gap = weight_of_slave(row) * row.gap;
            sliding.push_back({k, row.size, gap, row.normal});
            const bool overlaps = pair.overlap(row.index - pair.rows().front().index) != 0.;
            least_gap           = std::min(least_gap, row.tied || overlaps ? 0. : gap);
          }
      }
    least_gap = Utilities::MPI::min(least_gap, nodes.communicator());
  }



  // Eight faces at a time; negative if any has turned too far.
  TOUCHSTONE_VECTORISED double
  RowMotion::until_faces_turn(const NodeField &u,
                              const NodeField &v,
                              const double     step,
                              const double     gap) const
  {
    const auto numbers = [](const NodeField &field) {
      return reinterpret_cast<const double *>(field.data());
    };
    const double *const displacement = numbers(u), *const velocity = numbers(v),
                        *const start = numbers(made_at);
    double                     least = std::numeric_limits<double>::max();
    for (std::size_t first = 0; first < faces.size(); first += n_lanes)
      {
        Lanes m[4][dim], size = {};
        for (unsigned int i = 0; i < 4; ++i)
          {
            const double *of_u[n_lanes], *of_v[n_lanes], *of_start[n_lanes];
            for (unsigned int c = 0; c < n_lanes; ++c)
              {
                const WatchedFace &face = faces[std::min(first + c, faces.size() - 1)];
                const std::size_t  at   = dim * face.corners[i];
                of_u[c]                 = displacement + at;
                of_v[c]                 = velocity + at;
                of_start[c]             = start + at;
                size[c]                 = face.size;
              }
            Lanes speed[dim], before[dim];
            gather(of_u, m[i]);
            gather(of_v, speed);
            gather(of_start, before);
            for (unsigned int d = 0; d < dim; ++d)
              m[i][d] += step * speed[d] - before[d];
          }
        Lanes square = {};
        for (const auto &[one, other] : {std::pair(0, 1), {1, 3}, {3, 2}, {2, 0}})
          {
            Lanes sum = {};
            for (unsigned int d = 0; d < dim; ++d)
              sum += (m[one][d] - m[other][d]) * (m[one][d] - m[other][d]);
            square = sum > square ? sum : square;
          }
        const Lanes close = turns * size, far = turns_apart * size,
                    between = Lanes{} + slides_apart * gap, apart = between < far ? between : far,
                    limit = apart > close ? apart : close, until = limit - square_root(square);
        for (unsigned int c = 0; c < n_lanes; ++c)
          least = std::min(least, until[c]);
      }
    return least;
  }



  double
  RowMotion::until_rows_slide(const ImpulseSolver               &solver,
                              const std::vector<Tensor<1, dim>> &moved) const
  {
    double result = std::numeric_limits<double>::max();
    for (const WatchedRow &row : sliding)
      {
        Tensor<1, dim> relative;
        for (unsigned int i = 0; i < solver.rows[row.row].n_nodes; ++i)
          {
            const std::size_t s = solver.slot(solver.rows[row.row], i);
            relative += solver.weights[s] * moved[solver.nodes.node(s)];
          }
        const double along  = relative * row.normal;
        const double across = (relative - along * row.normal).norm();
        const double limit  = std::max(slides * row.size, slides_apart * (row.gap + along));
        if (across > limit)
          return -1.;
        // The limit falls as the gap does.
        result = std::min(result, (limit - across) / (1. + slides_apart));
      }
    return result;
  }



  // A node without a partner may be right beside the edge of the master surface: it is bounded by
  // how far it and the master surface have moved relative to each other, and to the distance
  // between them.
  double
  RowMotion::until_partners_are_found(const NodeField &u,
                                      const NodeField &v,
                                      const double     step) const
  {
    const auto moved = [&](const unsigned int node) {
      return u[node] + step * v[node] - made_at[node];
    };
    double result = std::numeric_limits<double>::max();
    for (unsigned int p = 0; p < searching.size(); ++p)
      if (searching[p])
        {
          // The box of the motions of the master nodes, over all ranks: lower bounds negated.
          double extreme[2 * dim], all[2 * dim];
          std::fill(extreme, extreme + 2 * dim, std::numeric_limits<double>::lowest());
          for (const unsigned int node : masters[p])
            {
              const Tensor<1, dim> m = moved(node);
              for (unsigned int d = 0; d < dim; ++d)
                {
                  extreme[d]       = std::max(extreme[d], m[d]);
                  extreme[dim + d] = std::max(extreme[dim + d], -m[d]);
                }
            }
          Utilities::MPI::max(extreme, nodes.communicator(), all);
          for (const WatchedNode &slave : slaves[p])
            if (const ContactRow &row = contact.rows()[slave.row]; !row.has_partner)
              {
                const Tensor<1, dim> m = moved(slave.node);
                Tensor<1, dim>       farthest;
                for (unsigned int d = 0; d < dim; ++d)
                  farthest[d] = std::max(m[d] + all[dim + d], all[d] - m[d]);
                const double limit = std::max(slides * slave.size, on_its_way * row.away);
                result             = std::min(result, limit - farthest.norm());
              }
        }
    return result;
  }



  bool
  RowMotion::demands_rows(const NodeField                   &u,
                          const NodeField                   &v,
                          const double                       step,
                          const ImpulseSolver               &solver,
                          const std::vector<Tensor<1, dim>> &moved,
                          const RowTravel                   &travelled,
                          const RowTravel                   &ahead,
                          const double                       largest_weights)
  {
    // Which criteria are looked at is the same on all ranks.
    const double apart = travelled.apart + ahead.apart;
    const bool   turn  = turned(travelled) + turned(ahead) >= safe_until.turn,
               slide = apart >= safe_until.slide, find = apart >= safe_until.find;
    // No row can have become narrower than this.
    const double gap      = std::max(0., least_gap - largest_weights * apart);
    const double until[3] = {turn ? until_faces_turn(u, v, step, gap) : 0.,
                             slide ? until_rows_slide(solver, moved) : 0.,
                             find ? until_partners_are_found(u, v, step) : 0.};
    double least[3];
    Utilities::MPI::min(until, nodes.communicator(), least);
    // What was looked at is the end of this cycle with its free velocities. At that of a later one
    // nodes are elsewhere by what they travel until then, and by both free motions.
    constexpr double safe = 1. - 1e-9;
    if (turn)
      {
        // The limit falls with the gap.
        safe_until.by_gap = gap > 0. ? slides_apart * largest_weights : 0.;
        safe_until.turn   = safe * least[0] + turned(travelled) - turned(ahead);
      }
    if (slide)
      safe_until.slide = safe * least[1] / largest_weights + travelled.apart - ahead.apart;
    if (find)
      safe_until.find = safe * least[2] + travelled.apart - ahead.apart;
    return std::min({least[0], least[1], least[2]}) < 0.;
  }
} // namespace Touchstone

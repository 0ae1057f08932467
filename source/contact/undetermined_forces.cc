// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/contact/undetermined_forces.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <map>
#include <tuple>

// Nodes are the vertices of a graph, rows that join two of them in all components its edges. What a
// force does that goes around a circle of it is nothing; so forces are determined up to those of
// the circles, which least squares choose.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A row that joins two nodes, in all components. */
    struct Join
    {
      unsigned int   pair;
      Index          slave, master;
      Point<dim>     reference;
      double         area;
      Tensor<1, dim> force;

      bool
      operator<(const Join &other) const
      {
        // Neither ranks nor the numbers of nodes decide on the order.
        const auto key = [](const Join &j) {
          return std::make_tuple(j.reference[0], j.reference[1], j.reference[2], j.pair);
        };
        return key(*this) < key(other);
      }
    };

    using Row = std::pair<unsigned int, Index>;

    /** Steps over joins, each with 1 if it is gone from slave to master, and -1 otherwise. */
    using Way = std::vector<std::pair<std::size_t, int>>;

    /** The node that a row joins its slave node to, or none: where meshes do not match, forces of
     * several rows do not cancel. */
    Index
    partner(const ContactRow &row)
    {
      constexpr double all = 1. - 1e-6;
      for (const StencilEntry &entry : row.stencil)
        if (entry.weight > all)
          return entry.node;
      return invalid_index;
    }

    /** The joins of all ranks. Collective. */
    std::vector<Join>
    joins(const Contact &contact)
    {
      std::vector<Join> mine;
      for (const ContactRow &row : contact.rows())
        if (const RowState &state = contact.state(row);
            // Springs determine the forces of penalties.
            state.fully_constrained() && state.admissible_gap == 0. && !row.between_nodes &&
            row.area > 0.)
          if (const Index to = partner(row); to != invalid_index)
            mine.push_back({row.pair, row.slave, to, row.reference, row.area, state.force});
      std::vector<Join> result = gather_all(mine, contact.communicator());
      std::sort(result.begin(), result.end());
      return result;
    }

    /** A forest of joins, breadth first, and the circles that the other joins close. */
    std::vector<Way>
    circles(const std::vector<Join> &all)
    {
      std::map<Index, std::vector<std::size_t>> at;
      for (std::size_t i = 0; i < all.size(); ++i)
        for (const Index node : {all[i].slave, all[i].master})
          at[node].push_back(i);
      std::map<Index, Way> from_root;
      std::vector<bool>    in_forest(all.size(), false);
      for (const Join &first : all)
        {
          if (!from_root.emplace(first.slave, Way()).second)
            continue;
          std::vector<Index> reached(1, first.slave);
          for (std::size_t k = 0; k < reached.size(); ++k)
            for (const std::size_t i : at.at(reached[k]))
              {
                const bool  forward = all[i].slave == reached[k];
                const Index next    = forward ? all[i].master : all[i].slave;
                Way         way     = from_root.at(reached[k]);
                way.emplace_back(i, forward ? 1 : -1);
                if (!from_root.emplace(next, std::move(way)).second)
                  continue;
                in_forest[i] = true;
                reached.push_back(next);
              }
        }
      std::vector<Way> result;
      for (std::size_t i = 0; i < all.size(); ++i)
        if (!in_forest[i])
          {
            // From the slave node to the master node, and back over the root.
            Way way(1, {i, 1});
            for (const auto &[k, sign] : from_root.at(all[i].slave))
              way.emplace_back(k, sign);
            for (const auto &[k, sign] : from_root.at(all[i].master))
              way.emplace_back(k, -sign);
            result.push_back(way);
          }
      return result;
    }

    /** For rows of this rank among @p doubtful the mean traction of the neighbours that are not.
     * Collective. */
    std::map<Row, Tensor<1, dim>>
    tractions_beside(const Contact &contact, const std::map<Row, Tensor<1, dim>> &doubtful)
    {
      std::map<Row, Tensor<1, dim>> result;
      for (unsigned int p = 0; p < contact.n_pairs(); ++p)
        {
          const ContactPair &pair = contact.pair(p);
          Vector tractions(contact.solid_model().owned, contact.communicator()), known(tractions);
          for (const ContactRow &row : pair.rows())
            if (contact.state(row).active() && !row.between_nodes && row.area > 0. &&
                doubtful.count({p, row.slave}) == 0)
              {
                known(dim * row.slave) = 1.;
                for (unsigned int d = 0; d < dim; ++d)
                  tractions(dim * row.slave + d) = contact.state(row).force[d] / row.area;
              }
          tractions.compress(VectorOperation::insert);
          known.compress(VectorOperation::insert);
          const Vector all_tractions = contact.with_ghosts(tractions),
                       all_known     = contact.with_ghosts(known);
          for (const ContactRow &row : pair.rows())
            {
              if (row.between_nodes || doubtful.count({p, row.slave}) == 0)
                continue;
              Tensor<1, dim> sum;
              unsigned int   n = 0;
              for (const auto &[face, m] : pair.slave().faces_around(row.slave))
                for (unsigned int k = 0; k < face->n_nodes(); ++k)
                  if (all_known(dim * face->nodes[k]) > 0.)
                    {
                      ++n;
                      for (unsigned int d = 0; d < dim; ++d)
                        sum[d] += all_tractions(dim * face->nodes[k] + d);
                    }
              if (n > 0)
                result[{p, row.slave}] = sum / n;
            }
        }
      return result;
    }

    /** A traction beside a row, as it is sent. */
    struct Beside
    {
      unsigned int   pair;
      Index          slave;
      Tensor<1, dim> traction;
    };

    /** The forces that change, on all ranks: F_i + sum_c s_ic C_c with the least sum of squares
     * |F_i + sum_c s_ic C_c - A_i t_i|^2 / A_i. Collective. */
    std::map<Row, Tensor<1, dim>>
    changes(const Contact &contact, const std::vector<Join> &all, const std::vector<Way> &ways)
    {
      std::map<Row, Tensor<1, dim>> result;
      for (const Way &way : ways)
        for (const auto &[i, sign] : way)
          result[{all[i].pair, all[i].slave}] = Tensor<1, dim>();
      std::vector<Beside> mine;
      for (const auto &[row, traction] : tractions_beside(contact, result))
        mine.push_back({row.first, row.second, traction});
      std::map<Row, Tensor<1, dim>> beside;
      for (const Beside &entry : gather_all(mine, contact.communicator()))
        beside[{entry.pair, entry.slave}] = entry.traction;

      // s_ic: what the ways from the root to both ends of a join have in common cancels.
      std::vector<std::map<std::size_t, double>> signs(ways.size());
      for (std::size_t c = 0; c < ways.size(); ++c)
        for (const auto &[i, sign] : ways[c])
          signs[c][i] += sign;
      FullMatrix<double> matrix(ways.size(), ways.size()), rhs(ways.size(), dim), forces(rhs);
      for (std::size_t c = 0; c < ways.size(); ++c)
        for (const auto &[i, sign] : signs[c])
          {
            for (std::size_t d = 0; d < ways.size(); ++d)
              if (const auto other = signs[d].find(i); other != signs[d].end())
                matrix(c, d) += sign * other->second / all[i].area;
            // Without a neighbour nothing is known of the traction.
            if (const auto traction = beside.find({all[i].pair, all[i].slave});
                traction != beside.end())
              for (unsigned int k = 0; k < dim; ++k)
                rhs(c, k) += sign * (traction->second[k] - all[i].force[k] / all[i].area);
          }
      matrix.gauss_jordan();
      matrix.mmult(forces, rhs);
      for (std::size_t c = 0; c < ways.size(); ++c)
        for (const auto &[i, sign] : signs[c])
          for (unsigned int k = 0; k < dim; ++k)
            result[{all[i].pair, all[i].slave}][k] += sign * forces(c, k);
      return result;
    }

    /** Whether friction can have the forces of the rows of this rank that change. */
    bool
    within_cones(const Contact &contact, const std::map<Row, Tensor<1, dim>> &changes)
    {
      return std::all_of(contact.rows().begin(), contact.rows().end(), [&](const ContactRow &row) {
        const auto change = changes.find({row.pair, row.slave});
        if (change == changes.end() || row.between_nodes || !row.friction)
          return true;
        const Tensor<1, dim> force  = contact.state(row).force + change->second;
        const double         lambda = force * row.normal;
        return lambda >= 0. && (force - lambda * row.normal).norm() <=
                                 row.friction->cone(lambda, /*sliding=*/false).force;
      });
    }
  } // namespace



  void
  divide_undetermined_forces(Contact &contact)
  {
    // The same on all ranks.
    unsigned int n = 0;
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      n += contact.pair(p).master() &&
           (contact.pair(p).tied() || contact.pair(p).parameters().friction);
    if (n < 2)
      return;
    const std::vector<Join> all  = joins(contact);
    const std::vector<Way>  ways = circles(all);
    if (ways.empty())
      return;
    const std::map<Row, Tensor<1, dim>> changed = changes(contact, all, ways);
    if (Utilities::MPI::min(static_cast<int>(within_cones(contact, changed)),
                            contact.communicator()) == 0)
      return;
    for (const ContactRow &row : contact.rows())
      if (const auto change = changed.find({row.pair, row.slave});
          change != changed.end() && !row.between_nodes)
        contact.enforcement().adopt(row,
                                    contact.state(row).status,
                                    contact.state(row).force + change->second);
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/algebra/strong_components.h>
#include <touchstone/contact/contact.h>
#include <touchstone/contact/enforcement/cyclic_constraints.h>
#include <touchstone/contact/enforcement/row_dependence.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <set>

// Cyclic dependencies of contact conditions over several pairs (doc/theory.md 6, "Cyclic
// constraints").
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Pair p leads to pair q if master nodes of p are slave nodes of q.
     * @param behind Of pairs that carry offsets those that are behind the master faces, instead.
     * Collective. */
    Edges
    shared_nodes(const std::vector<std::unique_ptr<ContactPair>> &pairs,
                 const bool                                       behind,
                 const MPI_Comm                                   communicator)
    {
      Edges edges;
      for (unsigned int p = 0; p < pairs.size(); ++p)
        for (unsigned int q = 0; q < pairs.size(); ++q)
          {
            // Both surfaces are distributed: each rank compares its own faces and nodes, and one
            // match on any rank connects the pairs.
            int shared = 0;
            if ((p != q || pairs[p]->parameters().of_one_body()) && pairs[p]->master() &&
                (!behind || pairs[p]->carries_offset()))
              {
                std::set<Index> slaves;
                for (const SurfaceNode &node : pairs[q]->slave().owned_nodes())
                  slaves.insert(node.node);
                for (const Face &face : pairs[p]->master()->owned_faces())
                  for (unsigned int m = 0; m < (behind ? Face::behind : face.n_nodes()); ++m)
                    shared |= slaves.count(behind ? face.nodes_behind[m] : face.nodes[m]);
              }
            if (Utilities::MPI::max(shared, communicator))
              edges.emplace_back(p, q);
          }
      return edges;
    }

    /** Nodes behind master faces repeat nothing that another row says, so that no row is redundant
     * because of them: pairs that would lead back to themselves over such nodes leave offsets to
     * themselves. Collective. */
    void
    leave_offsets(const std::vector<std::unique_ptr<ContactPair>> &pairs,
                  const Edges                                     &edges,
                  const MPI_Comm                                   communicator)
    {
      const Edges of_offsets = shared_nodes(pairs, /*behind=*/true, communicator);
      Edges       all(edges);
      all.insert(all.end(), of_offsets.begin(), of_offsets.end());
      for (const std::vector<unsigned int> &component : strong_components(pairs.size(), all))
        for (const auto &[p, q] : of_offsets)
          if (std::count(component.begin(), component.end(), p) > 0 &&
              std::count(component.begin(), component.end(), q) > 0)
            pairs[p]->leave_offsets();
    }
  } // namespace



  void
  CyclicConstraints::reinit(const std::vector<std::unique_ptr<ContactPair>> &pairs,
                            const MPI_Comm                                   communicator)
  {
    const Edges edges = shared_nodes(pairs, /*behind=*/false, communicator);
    leave_offsets(pairs, edges, communicator);
    const std::vector<bool> found = on_cycles(pairs.size(), edges);
    cyclic.clear();
    for (unsigned int p = 0; p < pairs.size(); ++p)
      if (found[p] || std::count(edges.begin(), edges.end(), std::make_pair(p, p)) > 0)
        cyclic.push_back(p);
  }



  /** The parameters of a search, and what has been kept so far. */
  struct CyclicConstraints::Search
  {
    const Contact             &contact;
    const ConstraintGraph     &graph;
    const double               threshold;
    std::vector<RowDependence> kept;

    /** Dependences of rows of a pair. @param stick Of those that stick, all; else of tied rows all,
     * and of others that along the normal. */
    std::vector<RowDependence>
    of_pair(const unsigned int p, const bool stick, const std::vector<bool> &left_out) const
    {
      std::vector<RowDependence> result;
      const bool                 own_body = contact.pair(p).parameters().of_one_body();
      for (const ContactRow &row : contact.pair(p).rows())
        {
          const RowState      &state = contact.state(row);
          const Tensor<1, dim> free  = graph.free_part(row.slave, row.normal);
          // A normal that supports determine is refused by the graph in any case (bound 1e-3,
          // doc/theory.md 6).
          if (!state.active() || left_out[row.index] || free.norm() < 1e-3 ||
              (stick && (row.tied || !state.fully_constrained())))
            continue;
          result.push_back(dependence(row, free, stick || row.tied, threshold, own_body));
        }
      return result;
    }

    /** Keep the rows of a pair that close no cycle with those that have been kept. @return The
     * slave nodes of the others. Collective. */
    std::set<Index>
    keep(const unsigned int p, std::vector<RowDependence> mine)
    {
      const IndexSet &owned        = contact.solid_model().owned;
      const MPI_Comm  communicator = contact.communicator();
      const bool      own_body     = contact.pair(p).parameters().of_one_body();
      // Dependencies between slave nodes of the same pair, which averaged normals and weights
      // make, are handled by the enforcement, see Elimination::adjust().
      if (!own_body)
        leave_out_own_slaves(mine, owned, communicator);
      std::vector<RowDependence> ends(kept), of_pair(mine);
      leave_out_ends(ends, of_pair, owned, communicator);
      ends    = gather(ends, communicator);
      of_pair = gather(of_pair, communicator);
      std::vector<RowDependence> all(ends);
      all.insert(all.end(), of_pair.begin(), of_pair.end());
      const std::set<Index> cycle = own_body ? closing_cycles(ends, of_pair) : in_cycles(all);
      for (const RowDependence &d : mine)
        if (cycle.count(d.slave) == 0)
          kept.push_back(d);
      return cycle;
    }
  };



  CyclicConstraints::Redundant
  CyclicConstraints::find(const Contact         &contact,
                          const ConstraintGraph &graph,
                          const double           threshold) const
  {
    // Pair by pair: all rows of this pair that lie on a cycle together with the rows kept of
    // earlier pairs are redundant, and not only as many as would break the cycles. So the result
    // does not depend on the order of the nodes, which depends on the partition.
    const std::size_t n_rows = contact.rows().size();
    Redundant         result{std::vector<bool>(n_rows, false), std::vector<bool>(n_rows, false)};
    Search            search{contact, graph, threshold, {}};
    for (const unsigned int p : cyclic)
      {
        const std::set<Index> cycle =
          search.keep(p, search.of_pair(p, /*stick=*/false, result.rows));
        for (const ContactRow &row : contact.pair(p).rows())
          result.rows[row.index] = contact.state(row).active() && cycle.count(row.slave) > 0;
      }
    // Then stick, beside all that keeps the bodies apart.
    for (const unsigned int p : cyclic)
      {
        const std::vector<RowDependence> stick   = search.of_pair(p, /*stick=*/true, result.rows);
        const int                        n_stick = stick.size();
        if (Utilities::MPI::max(n_stick, contact.communicator()) == 0)
          continue;
        const std::set<Index> cycle = search.keep(p, stick);
        for (const ContactRow &row : contact.pair(p).rows())
          result.stick[row.index] = !row.tied && !result.rows[row.index] &&
                                    contact.state(row).fully_constrained() &&
                                    cycle.count(row.slave) > 0;
      }
    return result;
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/algebra/strong_components.h>
#include <touchstone/base/ask_owners.h>
#include <touchstone/contact/contact.h>
#include <touchstone/contact/enforcement/cyclic_constraints.h>
#include <touchstone/contact/enforcement/row_terms.h>
#include <touchstone/contact/search/self_contact.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

// Cyclic dependencies of contact conditions over several pairs (doc/theory.md 6, "Cyclic
// constraints"): a directed graph has the dofs as vertices and an edge from each dof that a row
// determines to each dof that it determines it by; dofs in a strongly connected component of two or
// more vertices depend on themselves.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The dofs of the slave node that the conditions of a row determine (`dofs`), and the dofs
     * that their values depend on (`on`). */
    struct Dependence
    {
      Index              slave;
      std::vector<Index> dofs, on;
      /** Reference position of the slave node. */
      Point<dim> reference;
    };

    /** The component with the largest coefficient. */
    unsigned int
    largest_component(const Tensor<1, dim> &coefficients)
    {
      unsigned int result = 0;
      for (unsigned int d = 1; d < dim; ++d)
        if (std::abs(coefficients[d]) > std::abs(coefficients[result]))
          result = d;
      return result;
    }



    /** The dofs of a node with coefficients above the threshold. */
    void
    add_components(const Index           node,
                   const Tensor<1, dim> &coefficients,
                   const double          threshold,
                   std::vector<Index>   &dofs)
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (std::abs(coefficients[d]) > threshold)
          dofs.push_back(dim * node + d);
    }

    /** A row determines one dof of its node, along the largest component of its normal (that is not
     * always the one that elimination chooses, but rows that say the same depend on each other's
     * in any case: no largest component of a unit normal is below the threshold).
     * @param free The part of the normal that the slave node can move along.
     * @param own_body The stencil is of the body of the slave node.
     * @param fully A row that sticks or is tied determines all components of its node by all
     * components of the stencil.
     * @param threshold Smaller coefficients do not count. */
    Dependence
    dependence(const ContactRow     &row,
               const Tensor<1, dim> &free,
               const bool            fully,
               const double          threshold,
               const bool            own_body)
    {
      Dependence           result{row.slave, {}, {}, row.reference};
      const Tensor<1, dim> all({1., 1., 1.});
      if (fully)
        add_components(row.slave, all, threshold, result.dofs);
      else
        result.dofs.push_back(dim * row.slave + largest_component(free));
      // Other slave nodes whose functions are aggregated with this one repeat nothing that a master
      // says: over a joint of two masters rows of both pairs have parts of the same nodes.
      std::set<Index> aggregated;
      for (const StencilEntry &entry : row.stencil)
        if (entry.weight < 0. && !row.between_nodes && !own_body)
          aggregated.insert(entry.node);
      for (const StencilEntry &entry : row.stencil)
        if (std::abs(entry.weight) > Tolerances::negligible_weight &&
            aggregated.count(entry.node) == 0)
          add_components(entry.node, fully ? all : row.normal, threshold, result.on);
      // Of its own body the stencil alone counts: what else the condition depends on is handled by
      // the enforcement, see Elimination::adjust().
      if (own_body)
        return result;
      // With consistent linearisation the gap depends on further nodes, over averaged normals.
      if (row.derivative)
        for (const auto &[node, coefficients] : gap_gradient(row))
          if (aggregated.count(node) == 0)
            add_components(node, coefficients, threshold, result.on);
      if (row.friction && fully)
        for (const auto &[node, matrix] : row.friction->kinematics.slip_gradient)
          for (unsigned int d = 0; d < dim && aggregated.count(node) == 0; ++d)
            add_components(node, matrix[d], threshold, result.on);
      return result;
    }

    using Edges = std::vector<std::pair<unsigned int, unsigned int>>;

    /** Which vertices of a directed graph lie on a cycle of two or more. */
    std::vector<bool>
    on_cycles(const unsigned int n_vertices, const Edges &edges)
    {
      std::vector<bool> result(n_vertices, false);
      // The common case: no pairs that share nodes.
      if (edges.empty())
        return result;
      for (const std::vector<unsigned int> &component : strong_components(n_vertices, edges))
        if (component.size() > 1)
          for (const unsigned int i : component)
            result[i] = true;
      return result;
    }



    /** Slave nodes with dofs that depend on themselves. */
    std::set<Index>
    in_cycles(const std::vector<Dependence> &rows)
    {
      std::map<Index, unsigned int> numbers;
      // Consecutive numbers for the few dofs that take part.
      const auto number = [&](const Index dof) {
        return numbers.emplace(dof, numbers.size()).first->second;
      };
      Edges edges;
      for (const Dependence &row : rows)
        for (const Index from : row.dofs)
          for (const Index to : row.on)
            edges.emplace_back(number(from), number(to));
      const std::vector<bool> cyclic = on_cycles(numbers.size(), edges);
      std::set<Index>         result;
      for (const Dependence &row : rows)
        for (const Index from : row.dofs)
          if (numbers.count(from) > 0 && cyclic[numbers.at(from)])
            result.insert(row.slave);
      return result;
    }
  } // namespace



  void
  CyclicConstraints::reinit(const std::vector<std::unique_ptr<ContactPair>> &pairs,
                            const MPI_Comm                                   communicator)
  {
    // Pair p leads to pair q if master nodes of p are slave nodes of q.
    Edges edges;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      for (unsigned int q = 0; q < pairs.size(); ++q)
        {
          // Both surfaces are distributed: each rank compares its own faces and nodes, and one
          // match on any rank connects the pairs.
          int shared = 0;
          if ((p != q || pairs[p]->parameters().of_one_body()) && pairs[p]->master())
            {
              std::set<Index> slaves;
              for (const SurfaceNode &node : pairs[q]->slave().owned_nodes())
                slaves.insert(node.node);
              for (const Face &face : pairs[p]->master()->owned_faces())
                for (unsigned int m = 0; m < face.n_nodes(); ++m)
                  shared |= slaves.count(face.nodes[m]);
            }
          if (Utilities::MPI::max(shared, communicator))
            edges.emplace_back(p, q);
        }
    const std::vector<bool> found = on_cycles(pairs.size(), edges);
    cyclic.clear();
    for (unsigned int p = 0; p < pairs.size(); ++p)
      if (found[p] || std::count(edges.begin(), edges.end(), std::make_pair(p, p)) > 0)
        cyclic.push_back(p);
  }



  namespace
  {
    /** Leave out what lies on no cycle, as nothing that is determined leads on from it or to it,
     * and what lies on none without that, and so on, in at most so many rounds: what all ranks get
     * are rows on cycles and between them, and not all rows. Each rank asks the owners of the dofs
     * that its rows depend on. Collective. */
    void
    leave_out_ends(std::vector<Dependence> &kept,
                   std::vector<Dependence> &of_pair,
                   const IndexSet          &owned,
                   const MPI_Comm           communicator)
    {
      constexpr unsigned int most_rounds = 20;
      if (Utilities::MPI::n_mpi_processes(communicator) == 1)
        return; // nothing is sent
      const auto keep = [](std::vector<Index> &dofs, const std::set<Index> &kept) {
        const auto end  = std::remove_if(dofs.begin(), dofs.end(), [&](const Index dof) {
          return kept.count(dof) == 0;
        });
        const bool some = end != dofs.end();
        dofs.erase(end, dofs.end());
        return some;
      };
      int removed = 1;
      for (unsigned int round = 0; round < most_rounds && removed > 0; ++round)
        {
          std::set<Index> determined, asked, wanted;
          for (const auto *const list : {&kept, &of_pair})
            for (const Dependence &d : *list)
              {
                determined.insert(d.dofs.begin(), d.dofs.end());
                asked.insert(d.on.begin(), d.on.end());
              }
          const std::vector<Index> leading = known_to_owners(
            std::vector<Index>(asked.begin(), asked.end()),
            owned,
            communicator,
            [](const Index dof) { return dof; },
            [&](const Index dof) {
              wanted.insert(dof);
              return determined.count(dof) > 0;
            });
          const std::set<Index> leads_on(leading.begin(), leading.end());
          removed = 0;
          for (auto *const list : {&kept, &of_pair})
            {
              for (Dependence &d : *list)
                {
                  removed |= keep(d.on, leads_on);
                  removed |= keep(d.dofs, wanted);
                }
              list->erase(std::remove_if(list->begin(),
                                         list->end(),
                                         [](const Dependence &d) {
                                           return d.dofs.empty() || d.on.empty();
                                         }),
                          list->end());
            }
          removed = Utilities::MPI::max(removed, communicator);
        }
    }

    /** Leave out what rows of a pair depend on at slave nodes of these rows, of any rank.
     * Collective. */
    void
    leave_out_own_slaves(std::vector<Dependence> &mine,
                         const IndexSet          &owned,
                         const MPI_Comm           communicator)
    {
      std::set<Index> slaves, asked;
      for (const Dependence &d : mine)
        {
          slaves.insert(d.slave);
          for (const Index dof : d.on)
            asked.insert(dof / dim);
        }
      const std::vector<Index> known = known_to_owners(
        std::vector<Index>(asked.begin(), asked.end()),
        owned,
        communicator,
        [](const Index node) { return dim * node; },
        [&](const Index node) { return slaves.count(node) > 0; });
      const std::set<Index> of_pair(known.begin(), known.end());
      for (Dependence &d : mine)
        d.on.erase(std::remove_if(d.on.begin(),
                                  d.on.end(),
                                  [&](const Index dof) { return of_pair.count(dof / dim) > 0; }),
                   d.on.end());
    }

    /** What rows depend on, of all ranks. Collective. */
    std::vector<Dependence>
    gather(const std::vector<Dependence> &mine, const MPI_Comm communicator)
    {
      // One array of integers and one of positions per rank.
      std::vector<Index>      packed; // slave, numbers of dofs and of others, both lists
      std::vector<Point<dim>> places;
      for (const Dependence &d : mine)
        {
          packed.push_back(d.slave);
          packed.push_back(d.dofs.size());
          packed.push_back(d.on.size());
          packed.insert(packed.end(), d.dofs.begin(), d.dofs.end());
          packed.insert(packed.end(), d.on.begin(), d.on.end());
          places.push_back(d.reference);
        }
      std::vector<Dependence> result;
      const auto              lists  = Utilities::MPI::all_gather(communicator, packed);
      const auto              points = gather_records(places, communicator);
      for (std::size_t rank = 0; rank < lists.size(); ++rank)
        {
          auto place = points[rank].begin();
          for (auto i = lists[rank].begin(); i != lists[rank].end(); i += 3 + i[1] + i[2])
            result.push_back(
              {i[0], {i + 3, i + 3 + i[1]}, {i + 3 + i[1], i + 3 + i[1] + i[2]}, *place++});
        }
      return result;
    }

    /** Of rows of one pair and one body that are on cycles, the slave nodes of those that would
     * close one. Rows are kept one by one, in an order of reference positions: dropping all of
     * them, as of a later pair, would leave nothing that keeps the surfaces apart. */
    std::set<Index>
    closing_cycles(const std::vector<Dependence> &kept, const std::vector<Dependence> &of_pair)
    {
      std::vector<Dependence> all(kept);
      all.insert(all.end(), of_pair.begin(), of_pair.end());
      const std::set<Index>   on_cycle = in_cycles(all);
      std::vector<Dependence> sure(kept), doubtful;
      for (const Dependence &d : of_pair)
        (on_cycle.count(d.slave) > 0 ? doubtful : sure).push_back(d);
      std::sort(doubtful.begin(), doubtful.end(), [](const Dependence &a, const Dependence &b) {
        return SelfContact::comes_first(a.reference, b.reference);
      });
      std::set<Index> result;
      for (const Dependence &d : doubtful)
        {
          sure.push_back(d);
          if (!in_cycles(sure).empty())
            {
              sure.pop_back();
              result.insert(d.slave);
            }
        }
      return result;
    }
  } // namespace



  /** The parameters of a search, and what has been kept so far. */
  struct CyclicConstraints::Search
  {
    const Contact          &contact;
    const ConstraintGraph  &graph;
    const double            threshold;
    std::vector<Dependence> kept;

    /** Dependences of rows of a pair. @param stick Of those that stick, all; else of tied rows all,
     * and of others that along the normal. */
    std::vector<Dependence>
    of_pair(const unsigned int p, const bool stick, const std::vector<bool> &left_out) const
    {
      std::vector<Dependence> result;
      const bool              own_body = contact.pair(p).parameters().of_one_body();
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
    keep(const unsigned int p, std::vector<Dependence> mine)
    {
      const IndexSet &owned        = contact.solid_model().owned;
      const MPI_Comm  communicator = contact.communicator();
      const bool      own_body     = contact.pair(p).parameters().of_one_body();
      // Dependencies between slave nodes of the same pair, which averaged normals and weights
      // make, are handled by the enforcement, see Elimination::adjust().
      if (!own_body)
        leave_out_own_slaves(mine, owned, communicator);
      std::vector<Dependence> ends(kept), of_pair(mine);
      leave_out_ends(ends, of_pair, owned, communicator);
      ends    = gather(ends, communicator);
      of_pair = gather(of_pair, communicator);
      std::vector<Dependence> all(ends);
      all.insert(all.end(), of_pair.begin(), of_pair.end());
      const std::set<Index> cycle = own_body ? closing_cycles(ends, of_pair) : in_cycles(all);
      for (const Dependence &d : mine)
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
        const std::vector<Dependence> stick   = search.of_pair(p, /*stick=*/true, result.rows);
        const int                     n_stick = stick.size();
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

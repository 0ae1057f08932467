// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/strong_components.h>
#include <touchstone/base/ask_owners.h>
#include <touchstone/contact/enforcement/row_dependence.h>
#include <touchstone/contact/enforcement/row_terms.h>
#include <touchstone/contact/friction/friction.h>
#include <touchstone/contact/search/self_contact.h>
#include <touchstone/contact/tolerances.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
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
  } // namespace



  RowDependence
  dependence(const ContactRow     &row,
             const Tensor<1, dim> &free,
             const bool            fully,
             const double          threshold,
             const bool            own_body)
  {
    RowDependence        result{row.slave, {}, {}, row.reference};
    const Tensor<1, dim> all({1., 1., 1.});
    if (fully)
      add_components(row.slave, all, threshold, result.dofs);
    else
      result.dofs.push_back(dim * row.slave + largest_component(free));
    // Other slave nodes whose functions are aggregated with this one repeat nothing that a master
    // says: over a joint of two masters rows of both pairs have parts of the same nodes.
    std::set<Index> aggregated;
    for (const StencilEntry &entry : row.at_surface ? *row.at_surface : row.stencil)
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



  std::set<Index>
  in_cycles(const std::vector<RowDependence> &rows)
  {
    std::map<Index, unsigned int> numbers;
    // Consecutive numbers for the few dofs that take part.
    const auto number = [&](const Index dof) {
      return numbers.emplace(dof, numbers.size()).first->second;
    };
    Edges edges;
    for (const RowDependence &row : rows)
      for (const Index from : row.dofs)
        for (const Index to : row.on)
          edges.emplace_back(number(from), number(to));
    const std::vector<bool> cyclic = on_cycles(numbers.size(), edges);
    std::set<Index>         result;
    for (const RowDependence &row : rows)
      for (const Index from : row.dofs)
        if (numbers.count(from) > 0 && cyclic[numbers.at(from)])
          result.insert(row.slave);
    return result;
  }



  std::set<Index>
  closing_cycles(const std::vector<RowDependence> &kept, const std::vector<RowDependence> &of_pair)
  {
    std::vector<RowDependence> all(kept);
    all.insert(all.end(), of_pair.begin(), of_pair.end());
    const std::set<Index>      on_cycle = in_cycles(all);
    std::vector<RowDependence> sure(kept), doubtful;
    for (const RowDependence &d : of_pair)
      (on_cycle.count(d.slave) > 0 ? doubtful : sure).push_back(d);
    std::sort(doubtful.begin(), doubtful.end(), [](const RowDependence &a, const RowDependence &b) {
      return SelfContact::comes_first(a.reference, b.reference);
    });
    std::set<Index> result;
    for (const RowDependence &d : doubtful)
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



  void
  leave_out_own_slaves(std::vector<RowDependence> &mine,
                       const IndexSet             &owned,
                       const MPI_Comm              communicator)
  {
    std::set<Index> slaves, asked;
    for (const RowDependence &d : mine)
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
    for (RowDependence &d : mine)
      d.on.erase(std::remove_if(d.on.begin(),
                                d.on.end(),
                                [&](const Index dof) { return of_pair.count(dof / dim) > 0; }),
                 d.on.end());
  }



  void
  leave_out_ends(std::vector<RowDependence> &kept,
                 std::vector<RowDependence> &of_pair,
                 const IndexSet             &owned,
                 const MPI_Comm              communicator)
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
          for (const RowDependence &d : *list)
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
            for (RowDependence &d : *list)
              {
                removed |= keep(d.on, leads_on);
                removed |= keep(d.dofs, wanted);
              }
            list->erase(std::remove_if(list->begin(),
                                       list->end(),
                                       [](const RowDependence &d) {
                                         return d.dofs.empty() || d.on.empty();
                                       }),
                        list->end());
          }
        removed = Utilities::MPI::max(removed, communicator);
      }
  }



  std::vector<RowDependence>
  gather(const std::vector<RowDependence> &mine, const MPI_Comm communicator)
  {
    // One array of integers and one of positions per rank.
    std::vector<Index>      packed; // slave, numbers of dofs and of others, both lists
    std::vector<Point<dim>> places;
    for (const RowDependence &d : mine)
      {
        packed.push_back(d.slave);
        packed.push_back(d.dofs.size());
        packed.push_back(d.on.size());
        packed.insert(packed.end(), d.dofs.begin(), d.dofs.end());
        packed.insert(packed.end(), d.on.begin(), d.on.end());
        places.push_back(d.reference);
      }
    std::vector<RowDependence> result;
    const auto                 lists  = Utilities::MPI::all_gather(communicator, packed);
    const auto                 points = gather_records(places, communicator);
    for (std::size_t rank = 0; rank < lists.size(); ++rank)
      {
        auto place = points[rank].begin();
        for (auto i = lists[rank].begin(); i != lists[rank].end(); i += 3 + i[1] + i[2])
          result.push_back(
            {i[0], {i + 3, i + 3 + i[1]}, {i + 3 + i[1], i + 3 + i[1] + i[2]}, *place++});
      }
    return result;
  }
} // namespace Touchstone

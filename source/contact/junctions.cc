// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/base/orthogonal.h>
#include <touchstone/contact/junctions.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <map>

// Nodes around which pairs join the same surfaces more than once (doc/theory.md 3.1): the graph has
// the nodes that belong to the surfaces of two or more pairs as vertices, and an edge of a pair
// from the node of a row to those of its stencil.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Two nodes that a row of a pair joins. */
    struct Link
    {
      unsigned int pair;
      Index        slave, master;
      double       weight;
    };

    /** Of smaller weights another node of the stencil is the partner. */
    constexpr double least_weight = 0.1;

    /** More than half of what a row says is said by others: up to round-off, for nodes often lie
     * in the middle between others. */
    constexpr double most_of_it = 0.5 + 1e-6;

    /** Part of the weight of a stencil that must be free to meet a condition, as for
     * RefusedConditions. */
    constexpr double least_free = 0.5;

    /** Relative difference of areas that count as the same: bodies that are strained beside each
     * other must not decide by who bulges more. */
    constexpr double same_area = 0.1;

    /** Whether a row is closed, or open by less than this part of the size of a face. */
    bool
    may_act(const ContactRow &row, const double part = 1.)
    {
      return row.has_partner && !row.between_nodes && (row.tied || row.gap < part * row.size);
    }

    /** The links between these nodes, of all ranks. Collective. */
    std::vector<Link>
    links(const RowsByPair &rows, const std::set<Index> &nodes, const MPI_Comm communicator)
    {
      std::vector<Link> mine;
      for (unsigned int p = 0; p < rows.size(); ++p)
        for (const ContactRow &row : rows[p])
          if (may_act(row) && nodes.count(row.slave) > 0)
            for (const StencilEntry &entry : row.stencil)
              if (entry.weight > least_weight && nodes.count(entry.node) > 0)
                mine.push_back({p, row.slave, entry.node, entry.weight});
      return gather_all(mine, communicator);
    }
  } // namespace



  bool
  can_stick(const ContactPair &pair)
  {
    return pair.tied() || pair.parameters().friction;
  }



  std::set<Index>
  nodes_of_several_pairs(const std::vector<std::unique_ptr<ContactPair>> &pairs, const Solid &solid)
  {
    Vector count(solid.zero_vector()), of_pair(count);
    for (const auto &pair : pairs)
      {
        std::set<Index> nodes;
        for (const Surface *surface : {&pair->slave(), pair->master()})
          if (surface)
            for (const Face &face : surface->owned_faces())
              nodes.insert(face.nodes.begin(), face.nodes.begin() + face.n_nodes());
        of_pair = 0.;
        std::vector<Index> dofs;
        for (const Index node : nodes)
          dofs.push_back(dim * node);
        of_pair.add(dofs, std::vector<double>(dofs.size(), 1.));
        // Several ranks may have faces at a node.
        of_pair.compress(VectorOperation::add);
        for (double &value : of_pair)
          value = std::min(value, 1.);
        count += of_pair;
      }
    std::vector<Index> mine;
    std::size_t        k = 0;
    for (const Index dof : solid.owned)
      if (count.begin()[k++] > 1.5)
        mine.push_back(dof / dim);
    const std::vector<Index> all = gather_all(mine, solid.communicator);
    return {all.begin(), all.end()};
  }



  std::vector<std::set<Index>>
  junction_nodes(const std::vector<std::unique_ptr<ContactPair>> &pairs,
                 const RowsByPair                                &rows,
                 const std::set<Index>                           &nodes,
                 const Solid                                     &solid)
  {
    std::vector<std::set<Index>> result(pairs.size());
    if (nodes.empty())
      return result;
    const std::vector<Link>      all = links(rows, nodes, solid.communicator);
    std::map<Index, std::size_t> numbers;
    for (const Index node : nodes)
      numbers.emplace(node, numbers.size());
    for (unsigned int p = 0; p < pairs.size(); ++p)
      if (can_stick(*pairs[p]))
        {
          // What the other pairs join.
          std::vector<std::size_t> rank(numbers.size()), parent(numbers.size());
          boost::disjoint_sets<std::size_t *, std::size_t *> joined(rank.data(), parent.data());
          for (std::size_t k = 0; k < numbers.size(); ++k)
            joined.make_set(k);
          for (const Link &link : all)
            if (link.pair != p)
              joined.union_set(numbers.at(link.slave), numbers.at(link.master));
          std::map<Index, double> part_joined;
          for (const Link &link : all)
            if (link.pair == p &&
                joined.find_set(numbers.at(link.slave)) == joined.find_set(numbers.at(link.master)))
              part_joined[link.slave] += link.weight;
          for (const auto &[slave, part] : part_joined)
            if (part > most_of_it)
              result[p].insert(slave);
        }
    return result;
  }



  std::vector<std::set<Index>>
  nodes_over_joints(const std::vector<std::unique_ptr<ContactPair>> &pairs,
                    const RowsByPair                                &rows,
                    const Solid                                     &solid)
  {
    // All rows of a slave node are on the rank that owns it.
    std::map<Index, std::vector<const ContactRow *>> of_node;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      // Areas of pointwise rows are those of whole nodes, whatever is covered.
      if (can_stick(*pairs[p]) && pairs[p]->pairing().cover())
        for (const ContactRow &row : rows[p])
          // Beside a body that stands lower there is an edge of the contact, and no joint.
          if (may_act(row, Tolerances::well_open))
            of_node[row.slave].push_back(&row);
    /** A row that is left to others. */
    struct Left
    {
      unsigned int pair;
      Index        slave;
    };
    std::vector<Left> mine;
    for (const auto &[node, list] : of_node)
      for (const ContactRow *const row : list)
        if (std::any_of(list.begin(), list.end(), [row](const ContactRow *const other) {
              return other != row && other->normal * row->normal > Tolerances::sharp_edge_cosine &&
                     other->area > (1. - same_area) * row->area;
            }))
          mine.push_back({row->pair, node});
    std::vector<std::set<Index>> result(pairs.size());
    for (const Left &left : gather_all(mine, solid.communicator))
      result[left.pair].insert(left.slave);
    return result;
  }



  namespace
  {
    /** What a row with a held slave node has of one node of its stencil. */
    struct Facing
    {
      unsigned int   pair;
      Index          slave, node;
      double         weight;
      Tensor<1, dim> normal;
    };

    /** Coefficients below this part are none, as for the constraint graph (doc/theory.md 6). */
    constexpr double no_part = 1e-3;

    /** What is free of a unit vector at a node.
     * @param held Directions that need not be independent, by node. */
    double
    free_part(const Tensor<1, dim> &vector, const Index node, const ContactPair::Mirrors &held)
    {
      std::vector<Tensor<1, dim>> basis;
      if (const auto found = held.find(node); found != held.end())
        for (const Tensor<1, dim> &direction : found->second)
          if (const Tensor<1, dim> part = orthogonal_part(direction, basis);
              part.norm() > no_part * direction.norm())
            basis.push_back(part / part.norm());
      return orthogonal_part(vector, basis).norm();
    }
  } // namespace



  std::vector<std::set<Index>>
  held_nodes(const std::vector<std::unique_ptr<ContactPair>> &pairs,
             const RowsByPair                                &rows,
             const ContactPair::Mirrors                      &supports,
             const Solid                                     &solid)
  {
    std::vector<std::set<Index>> result(pairs.size());
    std::vector<Facing>          mine;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      for (const ContactRow &row : rows[p])
        if (may_act(row) && free_part(row.normal, row.slave, supports) < no_part &&
            free_part(row.normal, row.slave, pairs[p]->planes_of_symmetry()) > no_part)
          for (const StencilEntry &entry : row.stencil)
            mine.push_back({p, row.slave, entry.node, std::abs(entry.weight), row.normal});
    const std::vector<Facing> all = gather_all(mine, solid.communicator);
    if (all.empty())
      return result;
    // Weights of the nodes that a row faces, and what is free of them, which their owners know. The
    // rows are numbered in the same order on all ranks.
    std::map<std::pair<unsigned int, Index>, std::size_t> numbers;
    std::vector<double>                                   sums;
    for (const Facing &facing : all)
      {
        const std::size_t k =
          numbers.emplace(std::make_pair(facing.pair, facing.slave), numbers.size()).first->second;
        sums.resize(2 * numbers.size());
        if (!solid.owned.is_element(dim * facing.node))
          continue;
        sums[2 * k] += facing.weight;
        sums[2 * k + 1] += facing.weight * free_part(facing.normal, facing.node, supports);
      }
    Utilities::MPI::sum(sums, solid.communicator, sums);
    for (const auto &[row, k] : numbers)
      if (sums[2 * k + 1] <= least_free * sums[2 * k])
        result[row.first].insert(row.second);
    return result;
  }
} // namespace Touchstone

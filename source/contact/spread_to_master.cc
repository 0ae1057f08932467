// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/nodal_value.h>
#include <touchstone/contact/geometry/surface.h>
#include <touchstone/contact/spread_to_master.h>
#include <touchstone/solid/solid.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <functional>

// Where the sums of rows go that act on several nodes, see spread_to_master.h.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Whether the weights of a stencil with a node are to be without sign. */
    using Chosen = std::function<bool(Index)>;



    /** The weights of a stencil; with a chosen node none is negative, and their sum @p sum. */
    Stencil
    weights(Stencil stencil, const double sum, const Chosen &chosen)
    {
      if (std::none_of(stencil.begin(), stencil.end(), [&](const StencilEntry &entry) {
            return chosen(entry.node);
          }))
        return stencil;
      double positive = 0.;
      for (const StencilEntry &entry : stencil)
        positive += std::max(entry.weight, 0.);
      if (positive > 0.)
        for (StencilEntry &entry : stencil)
          entry.weight = std::max(entry.weight, 0.) * sum / positive;
      return stencil;
    }



    /** Each hanging node of this rank with the nodes that it follows and their weights. */
    void
    for_hanging_nodes(const Solid &solid, const std::function<void(Index, const Stencil &)> &action)
    {
      for (const auto &line : solid.hanging.get_lines())
        if (line.index % dim == 0 && solid.owned.is_element(line.index))
          {
            Stencil follows;
            for (const auto &[parent, weight] : line.entries)
              follows.push_back({parent / dim, weight});
            action(line.index / dim, follows);
          }
    }



    Vector
    spread(const Solid &solid, const std::vector<RowShare> &shares, const Chosen &chosen)
    {
      std::vector<Index>  dofs;
      std::vector<double> entries;
      const auto          add = [&](const Index node, const double weight, const auto &values) {
        for (unsigned int d = 0; d < dim; ++d)
          {
            dofs.push_back(dim * node + d);
            entries.push_back(weight * values[d]);
          }
      };
      Vector result = solid.zero_vector();
      for (const RowShare &share : shares)
        for (const StencilEntry &entry : weights(*share.stencil, share.sum, chosen))
          add(entry.node, entry.weight, share.values);
      result.add(dofs, entries);
      result.compress(VectorOperation::add);
      if (!solid.has_hanging_nodes())
        return result;

      dofs.clear();
      entries.clear();
      for_hanging_nodes(solid, [&](const Index node, const Stencil &follows) {
        const Tensor<1, dim> values = nodal_value(result, node);
        for (const StencilEntry &entry : weights(follows, 1., chosen))
          add(entry.node, entry.weight, values);
        add(node, -1., values);
      });
      result.add(dofs, entries);
      result.compress(VectorOperation::add);
      return result;
    }



    /** The nodes of all ranks, in ascending order. Collective. */
    std::vector<Index>
    of_all_ranks(const std::vector<Index> &nodes, const MPI_Comm communicator)
    {
      std::vector<Index> result;
      for (const auto &of_rank : Utilities::MPI::all_gather(communicator, nodes))
        result.insert(result.end(), of_rank.begin(), of_rank.end());
      std::sort(result.begin(), result.end());
      return result;
    }
  } // namespace



  Vector
  spread(const Solid &solid, const std::vector<RowShare> &shares)
  {
    return spread(solid, shares, [](const Index) { return false; });
  }



  PositiveSpread::PositiveSpread(const Solid                 &solid,
                                 const Surface               &master,
                                 const std::vector<RowShare> &areas)
    : solid(solid)
  {
    // Whole faces of degree 2 leave their corners four ninths of the area without signs.
    // Round-off is no sign.
    constexpr double least = 0.1, zero = 1e-9;
    const Vector     positive = spread(solid, areas, [](const Index) { return true; });
    const auto       is_known = [this](const Index node) {
      return std::binary_search(nodes.begin(), nodes.end(), node);
    };
    while (true)
      {
        // With the first nodes others in reach of their rows may become such nodes.
        const Vector       area = (*this)(areas);
        std::vector<Index> more;
        for (const SurfaceNode &node : master.owned_nodes())
          if (area(dim * node.node) < least * positive(dim * node.node) - zero * node.area &&
              !is_known(node.node))
            more.push_back(node.node);
        more = of_all_ranks(more, solid.communicator);
        if (more.empty())
          return;
        nodes.insert(nodes.end(), more.begin(), more.end());
        std::sort(nodes.begin(), nodes.end());
        if (!solid.has_hanging_nodes())
          continue;
        // Rows reach a node through those that follow it, too.
        more.clear();
        for_hanging_nodes(solid, [&](const Index node, const Stencil &follows) {
          if (!is_known(node) &&
              std::any_of(follows.begin(), follows.end(), [&](const StencilEntry &entry) {
                return is_known(entry.node);
              }))
            more.push_back(node);
        });
        more = of_all_ranks(more, solid.communicator);
        nodes.insert(nodes.end(), more.begin(), more.end());
        std::sort(nodes.begin(), nodes.end());
      }
  }



  Vector
  PositiveSpread::operator()(const std::vector<RowShare> &shares) const
  {
    return spread(solid, shares, [this](const Index node) {
      return std::binary_search(nodes.begin(), nodes.end(), node);
    });
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/explicit/general/general_results.h>

#include <algorithm>

namespace Touchstone
{
  using namespace dealii;

  GeneralResults::GeneralResults(const ImpactSurface &surface,
                                 const NodeMap       &nodes,
                                 const IndexSet      &owned)
    : surface(surface)
    , nodes(nodes)
    , owned(owned)
  {
  }



  void
  GeneralResults::NodeTotal::add(const NodeTotal &other)
  {
    for (unsigned int d = 0; d < dim; ++d)
      impulse[d].add(other.impulse[d]);
    gap    = std::min(gap, other.gap);
    slides = slides || other.slides;
  }



  void
  GeneralResults::begin_interval()
  {
    totals.clear();
  }



  void
  GeneralResults::add(const std::array<Index, 8> &dofs, const unsigned int n, const RowTotal &total)
  {
    for (unsigned int i = 0; i < n; ++i)
      {
        NodeTotal &of =
          totals.try_emplace(dofs[i], NodeTotal{dofs[i], {}, total.gap, false}).first->second;
        for (unsigned int d = 0; d < dim; ++d)
          of.impulse[d].add(total.impulses[i][d]);
        of.gap    = std::min(of.gap, total.gap);
        of.slides = of.slides || total.slides;
      }
  }



  void
  GeneralResults::end_interval(const double length)
  {
    IndexSet asked(owned.size());
    for (const auto &[dof, total] : totals)
      asked.add_index(dof);
    const std::vector<unsigned int> owners =
      Utilities::MPI::compute_index_owner(owned, asked, nodes.communicator());
    std::map<unsigned int, std::vector<NodeTotal>> messages;
    for (const auto &[dof, total] : totals)
      messages[owners[asked.index_within_set(dof)]].push_back(total);
    totals.clear();
    for (const auto &[rank, list] : exchange_records(messages, nodes.communicator()))
      for (const NodeTotal &total : list)
        if (const auto [there, is_new] = totals.try_emplace(total.dof, total); !is_new)
          there->second.add(total);
    results.clear();
    for (const auto &[dof, total] : totals)
      {
        NodeResult &result = results[nodes.local(dof)];
        for (unsigned int d = 0; d < dim; ++d)
          result.force[d] = length > 0. ? total.impulse[d].value() / length : 0.;
        result.gap    = total.gap;
        result.slides = total.slides;
      }
    totals.clear();
  }



  std::vector<ContactPoint>
  GeneralResults::points(const NodeField &u, const unsigned int pair) const
  {
    std::vector<ContactPoint> all;
    for (const unsigned int node : surface.owned_nodes())
      {
        ContactPoint point;
        point.pair               = pair;
        point.node               = nodes.dof(node) / dim;
        point.reference_position = Point<dim>(nodes.positions()[node]);
        point.displacement       = u[node];
        // As of a partner.
        point.normal = -surface.inset(node, u).normal;
        point.area   = surface.area(node);
        point.gap    = 0.;
        point.status = ContactStatus::no_partner;
        if (const auto found = results.find(node); found != results.end())
          {
            const NodeResult &result = found->second;
            point.gap                = result.gap;
            point.force              = result.force;
            point.traction           = result.force / point.area;
            point.pressure           = point.traction * point.normal;
            point.status             = result.slides ? ContactStatus::slip : ContactStatus::stick;
          }
        all.push_back(point);
      }
    return all;
  }



  std::vector<ContactFace>
  GeneralResults::faces(const unsigned int pair) const
  {
    std::vector<ContactFace> all;
    for (const ImpactFace &face : surface.faces())
      {
        ContactFace one{pair, 1, {}};
        // Lexicographic, not around the face.
        constexpr unsigned int order[] = {0, 1, 3, 2};
        for (unsigned int a = 0; a < 4; ++a)
          one.nodes[a] = face.dofs[order[a]] / dim;
        all.push_back(one);
      }
    return all;
  }
} // namespace Touchstone

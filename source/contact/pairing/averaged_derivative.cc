// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/averaged_derivative.h>

#include <algorithm>
#include <numeric>

// Collects the derivatives of averaged rows for the consistent linearisation (doc/theory.md 4,
// "Derivatives of rows"; 5, "Linearisation"). Only rows that were active are differentiated: open
// rows contribute no force and no condition.
namespace Touchstone
{
  using namespace dealii;

  void
  AveragedDerivative::add_row(const Index      slave,
                              const Stencil   &stencil,
                              const CoverSums &sums,
                              const double     size,
                              const bool       with_area)
  {
    rows.try_emplace(slave, stencil, sums, size, with_area);
  }



  bool
  AveragedDerivative::wants(const Face &slave, const TraceBasis *basis) const
  {
    const auto &nodes = basis ? basis->nodes : slave.nodes;
    return std::any_of(nodes.begin(), nodes.begin() + slave.n_nodes(), [this](const Index node) {
      return rows.count(node) > 0;
    });
  }



  void
  AveragedDerivative::add_face(const FaceGeometry              &slave,
                               const TraceBasis                *basis,
                               const std::vector<const Face *> &covering,
                               const CoverShares::Whole        &at_once)
  {
    // The number of nodes is a template parameter: derivative numbers have a fixed length of 24 or
    // 54.
    if (slave.face().degree == 1)
      add<4>(slave, basis, covering, at_once);
    else
      add<9>(slave, basis, covering, at_once);
  }



  template <unsigned int n>
  void
  AveragedDerivative::add(const FaceGeometry              &slave,
                          const TraceBasis                *basis,
                          const std::vector<const Face *> &covering,
                          const CoverShares::Whole        &at_once)
  {
    const FaceDifferentiator               on_slave(slave);
    typename SlaveFaceDerivative<n>::Parts parts;
    for (const Face *face : covering)
      {
        // Most candidates do not overlap; they are recognised without derivatives.
        const auto points = differentiated_overlap<n>(slave.face(), *face);
        if (points.empty())
          continue;
        // What belongs to a master face alone (patch, derivatives of its control points) is
        // computed once, though several slave faces may meet it.
        const Master &master = masters.try_emplace(face, exchange.geometry(*face)).first->second;
        auto         &part   = parts.emplace_back(length, master.geometry);
        for (const auto &point : points)
          part.add(point, on_slave, master.differentiator);
      }
    // Where the surfaces are too inclined to each other nothing counts as covered: the face
    // contributes to no row (doc/theory.md 3.2).
    const auto areas = total_areas<n>(parts);
    if (std::accumulate(areas.begin(), areas.end(), 0.) <= 0.)
      return;
    const SlaveFaceDerivative<n> face(slave, basis, parts, at_once);
    for (unsigned int k = 0; k < n; ++k)
      // A face contributes to the rows of all its nodes, or of the nodes that its hanging nodes
      // follow.
      if (const auto row = rows.find(face.own[k]); row != rows.end())
        row->second.add_face(k, face);
  }



  std::unordered_map<Index, std::shared_ptr<const RowDerivative>>
  AveragedDerivative::finish()
  {
    using Derivatives = std::unordered_map<const Face *, std::vector<NormalDerivative>>;
    // Nodal normals depend on faces of other ranks: their derivatives are requested from the owners
    // for all rows at once. Collective, also on ranks without active rows.
    std::vector<const Face *> needed;
    for (const auto &[face, master] : masters)
      // Normals of facets do not depend on averages.
      if (master.geometry.interpolates_normals() || master.geometry.smooth())
        needed.push_back(face);
    const Derivatives of_masters = exchange.normal_derivatives(needed);
    Derivatives       of_slaves;
    // Slave normals matter only where slave faces are smooth patches.
    if (slave_exchange)
      {
        needed.clear();
        for (const auto &[node, row] : rows)
          for (const std::uint64_t key : row.slave_faces())
            needed.push_back(slave_exchange->face(key));
        of_slaves = slave_exchange->normal_derivatives(needed);
      }

    const auto of_face = [](const Derivatives &derivatives, const Face *face) {
      const auto found = derivatives.find(face);
      return found == derivatives.end() ? nullptr : &found->second;
    };
    std::unordered_map<Index, std::shared_ptr<const RowDerivative>> result;
    for (auto &[node, row] : rows)
      result[node] = row.finish([&](const Face *face) { return of_face(of_masters, face); },
                                [&](const std::uint64_t key) {
                                  return &of_slaves.at(slave_exchange->face(key));
                                });
    return result;
  }
} // namespace Touchstone

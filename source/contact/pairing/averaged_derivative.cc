// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/averaged_derivative.h>

#include <algorithm>
#include <numeric>

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
                               const std::vector<const Face *> &covering)
  {
    if (slave.face().degree == 1)
      add<4>(slave, basis, covering);
    else
      add<9>(slave, basis, covering);
  }



  template <unsigned int n>
  void
  AveragedDerivative::add(const FaceGeometry              &slave,
                          const TraceBasis                *basis,
                          const std::vector<const Face *> &covering)
  {
    const FaceDifferentiator               on_slave(slave);
    typename SlaveFaceDerivative<n>::Parts parts;
    for (const Face *face : covering)
      {
        const auto points = differentiated_overlap<n>(slave.face(), *face);
        if (points.empty())
          continue;
        const Master &master = masters.try_emplace(face, exchange.geometry(*face)).first->second;
        auto         &part   = parts.emplace_back(master.geometry);
        for (const auto &point : points)
          part.add(point, on_slave, master.differentiator);
      }
    // Where the surfaces are too inclined to each other nothing is covered: the rows have
    // nothing of this face.
    const auto areas = total_areas<n>(parts);
    if (std::accumulate(areas.begin(), areas.end(), 0.) <= 0.)
      return;
    const SlaveFaceDerivative<n> face(slave, basis, parts, gradual);
    for (unsigned int k = 0; k < n; ++k)
      if (const auto row = rows.find(face.own[k]); row != rows.end())
        row->second.add_face(k, face);
  }



  std::unordered_map<Index, std::shared_ptr<const RowDerivative>>
  AveragedDerivative::finish()
  {
    using Derivatives = std::unordered_map<const Face *, std::vector<NormalDerivative>>;
    std::vector<const Face *> needed;
    for (const auto &[face, master] : masters)
      needed.push_back(face);
    const Derivatives of_masters = exchange.normal_derivatives(needed);
    Derivatives       of_slaves;
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

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exact_sum.h>
#include <touchstone/explicit/nodal_loads.h>

// Forces and moments on boundaries of bodies at finite strain in explicit dynamics (doc/theory.md
// 2.3): the tractions depend on where the whole boundary is.
namespace Touchstone
{
  using namespace dealii;

  void
  NodalLoads::add_resultants(const double t, const NodeField &u, NodeField &force) const
  {
    for (const Resultant &resultant : resultants)
      {
        std::vector<Tensor<1, dim>>                              present;
        std::array<ExactSum, ResultantLoad::Integrals::n_values> sums;
        for (std::size_t q = 0; q < resultant.points.size(); ++q)
          {
            const PressurePoint &point = resultant.points[q];
            Tensor<1, dim>       x     = point.position;
            for (unsigned int k = 0; k < 4; ++k)
              x += point.shapes[k] * u[point.nodes[k]];
            present.push_back(x);
            if (!point.owned)
              continue;
            ResultantLoad::Integrals one;
            one.add(resultant.areas[q], x, point.position);
            for (std::size_t k = 0; k < sums.size(); ++k)
              sums[k].add(one.values[k]);
          }
        ResultantLoad::Integrals all;
        for (std::size_t k = 0; k < sums.size(); ++k)
          all.values[k] = sums[k].value(map.communicator());
        const ResultantLoad::Place place = resultant.load->place(all);
        for (std::size_t q = 0; q < present.size(); ++q)
          {
            const PressurePoint &point = resultant.points[q];
            const Tensor<1, dim> whole =
              resultant.areas[q] * resultant.load->traction(place, present[q], t);
            for (unsigned int k = 0; k < 4; ++k)
              force[point.nodes[k]] += point.shapes[k] * whole;
          }
      }
  }
} // namespace Touchstone

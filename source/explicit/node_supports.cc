// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exact_sum.h>
#include <touchstone/explicit/node_supports.h>

#include <algorithm>

// Supports as projections of single nodes (doc/explicit.md, section 3).
namespace Touchstone
{
  using namespace dealii;

  NodeSupports::NodeSupports(const BoundaryConditions &conditions, const NodeMap &map)
    : conditions(conditions)
    , map(map)
  {
    std::vector<unsigned int>  n_directions(map.n_local());
    std::array<NodeField, dim> directions;
    for (NodeField &field : directions)
      field.resize(map.n_local());
    for (const auto &prescribed : conditions.prescribed_directions())
      {
        Direction          one{map.local(dim * prescribed.node),
                      prescribed.direction,
                      prescribed.support,
                      -1,
                      prescribed.position,
                      0.,
                      {{0., 0.}},
                      0};
        const unsigned int n = n_directions[one.node];
        one.n_earlier        = n;
        for (unsigned int k = 0; k < n; ++k)
          {
            const double part = one.unit * directions[k][one.node];
            if (k < 2)
              one.earlier[k] = part;
            one.unit -= part * directions[k][one.node];
          }
        one.norm = one.unit.norm();
        // As in BoundaryConditions::reactions(): earlier directions span this one.
        if (n == dim || one.norm < 1e-3)
          continue;
        one.unit /= one.norm;
        directions[n][one.node] = one.unit;
        ++n_directions[one.node];
        if (prescribed.value)
          {
            const auto found = std::find(formulas.begin(), formulas.end(), prescribed.value);
            one.formula      = found - formulas.begin();
            if (found == formulas.end())
              formulas.push_back(prescribed.value);
          }
        all.push_back(one);
      }
    // The directions of a node one after the other, in their order of precedence.
    std::stable_sort(all.begin(), all.end(), [](const Direction &a, const Direction &b) {
      return a.node < b.node;
    });
    formula_values.resize(formulas.size());
    set_frames(directions);
  }



  void
  NodeSupports::set_frames(std::array<NodeField, dim> &directions)
  {
    for (NodeField &field : directions)
      map.update_ghosts(field);
    places.assign(map.n_local(), numbers::invalid_unsigned_int);
    for (unsigned int node = 0; node < map.n_local(); ++node)
      {
        Frame frame;
        for (; frame.n < dim && directions[frame.n][node].norm_square() > 0.; ++frame.n)
          frame.directions[frame.n] = directions[frame.n][node];
        if (frame.n == 0)
          continue;
        places[node] = frames.size();
        frames.push_back(frame);
        if (node < map.n_owned())
          supported_nodes.push_back(node);
      }
  }



  template <class Use>
  void
  NodeSupports::for_each_target(const double t, const Use &use) const
  {
    // Formulas of the time alone are evaluated once, not at each node.
    for (std::size_t f = 0; f < formulas.size(); ++f)
      if (!formulas[f]->depends_on_position())
        formula_values[f] = formulas[f]->value(Point<dim>(), t);
    std::array<double, dim> targets;
    for (const Direction &one : all)
      {
        double value = one.formula < 0 ? 0.
                       : formulas[one.formula]->depends_on_position()
                         ? formulas[one.formula]->value(one.position, t)
                         : formula_values[one.formula];
        for (unsigned int k = 0; k < one.n_earlier; ++k)
          value -= one.earlier[k] * targets[k];
        targets[one.n_earlier] = value / one.norm;
        use(one, targets[one.n_earlier]);
      }
  }



  void
  NodeSupports::set_velocities(const double     t,
                               const double     step,
                               const NodeField &u,
                               NodeField       &v) const
  {
    for_each_target(t, [&](const Direction &one, const double target) {
      const double wanted = (target - one.unit * u[one.node]) / step;
      v[one.node] += (wanted - one.unit * v[one.node]) * one.unit;
    });
  }



  void
  NodeSupports::set_displacements(const double t, NodeField &u) const
  {
    for_each_target(t, [&](const Direction &one, const double target) {
      u[one.node] += (target - one.unit * u[one.node]) * one.unit;
    });
  }



  std::vector<Reaction>
  NodeSupports::reactions(const NodeField &force) const
  {
    std::vector<Reaction>                  result = conditions.reaction_names();
    std::vector<std::array<ExactSum, dim>> sums(result.size());
    for (const Direction &one : all)
      {
        const Tensor<1, dim> share = (one.unit * force[place(one.node)]) * one.unit;
        for (unsigned int d = 0; d < dim; ++d)
          sums[one.support][d].add(share[d]);
      }
    for (std::size_t s = 0; s < result.size(); ++s)
      for (unsigned int d = 0; d < dim; ++d)
        result[s].force[d] = sums[s][d].value(map.communicator());
    return result;
  }



  NodeField
  NodeSupports::nodal_reactions(const NodeField &force) const
  {
    NodeField result(map.n_local());
    for (const Direction &one : all)
      result[one.node] += (one.unit * force[place(one.node)]) * one.unit;
    return result;
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/orthogonal.h>
#include <touchstone/solid/boundary_conditions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

// Prescribed displacements: their conditions for the ConstraintGraph, and their reactions.
namespace Touchstone
{
  using namespace dealii;

  double
  BoundaryConditions::Prescribed::displacement(const double t) const
  {
    return value ? value->value(position, t) : 0.;
  }



  std::vector<PrescribedDisplacement>
  BoundaryConditions::displacements(const double t) const
  {
    std::vector<PrescribedDisplacement> result;
    for (const Prescribed &p : prescribed)
      result.push_back({p.node,
                        p.direction,
                        p.displacement(t),
                        supports[p.support].body + "/" + supports[p.support].boundary});
    formulas.check(solid.communicator);
    return result;
  }



  /** Give the conditions at time t to the graph, as increments that are missing from displacement
   * u: direction . du = value(t) - direction . u. Returns the largest accepted increment on all
   * ranks (length), by which the caller judges whether u meets the conditions already. Collective.
   */
  double
  BoundaryConditions::prescribe(const double t, const Vector &u, ConstraintGraph &graph) const
  {
    // All formulas are evaluated first and an error of any rank is reported on all ranks:
    // otherwise one rank would throw while others wait in the collective calls of the graph, and
    // the graph would receive values that are not numbers.
    std::vector<double> values;
    for (const Prescribed &p : prescribed)
      values.push_back(p.displacement(t));
    formulas.check(solid.communicator);
    double mismatch = 0.;
    auto   next     = values.begin();
    for (const Prescribed &p : prescribed)
      {
        double value = *next++;
        for (unsigned int d = 0; d < dim; ++d)
          if (p.direction[d] != 0.)
            value -= p.direction[d] * u(dim * p.node + d);
        Condition condition;
        condition.node      = p.node;
        condition.direction = p.direction;
        condition.value     = value;
        condition.body      = p.body;
        condition.position  = p.position;
        if (graph.accept(condition))
          mismatch = std::max(mismatch, std::abs(value));
      }
    return Utilities::MPI::max(mismatch, solid.communicator);
  }



  void
  BoundaryConditions::for_each_share(
    const Vector                                                          &unbalanced,
    const std::function<void(const Prescribed &, const Tensor<1, dim> &)> &visit) const
  {
    // Each prescribed direction takes its share of the unbalanced force of the
    // node, in the order of precedence and without what earlier directions have
    // taken: so the shares add up to the whole.
    std::map<Index, std::vector<Tensor<1, dim>>> taken;
    for (const Prescribed &p : prescribed)
      {
        std::vector<Tensor<1, dim>> &earlier   = taken[p.node];
        Tensor<1, dim>               direction = orthogonal_part(p.direction, earlier);
        // Earlier directions span this one, but for an angle of a thousandth: it has no share of
        // its own, and normalising the remainder would amplify round-off.
        if (direction.norm() < 1e-3)
          continue;
        direction /= direction.norm();
        earlier.push_back(direction);
        double share = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          share += direction[d] * unbalanced(dim * p.node + d);
        visit(p, share * direction);
      }
  }



  Vector
  BoundaryConditions::nodal_reactions(const Vector &unbalanced) const
  {
    Vector result(solid.zero_vector());
    for_each_share(unbalanced, [&result](const Prescribed &p, const Tensor<1, dim> &force) {
      for (unsigned int d = 0; d < dim; ++d)
        result(dim * p.node + d) += force[d];
    });
    result.compress(VectorOperation::add);
    return result;
  }



  std::vector<Reaction>
  BoundaryConditions::reactions(const Vector &unbalanced) const
  {
    std::vector<Reaction> result = supports;
    for_each_share(unbalanced, [&result](const Prescribed &p, const Tensor<1, dim> &force) {
      result[p.support].force += force;
    });
    for (Reaction &reaction : result)
      reaction.force = Utilities::MPI::sum(reaction.force, solid.communicator);
    return result;
  }
} // namespace Touchstone

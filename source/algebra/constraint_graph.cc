#include <touchstone/algebra/constraint_graph.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A condition whose direction shrinks below this after substitution adds
     * nothing that a computation in double precision can rely on: 1e-3 lets
     * go what is within 0.06 degrees of being determined already. */
    constexpr double dependent = 1e-3;

    /** row <- row - factor * other */
    template <class Reduced>
    void
    subtract(Reduced &row, const double factor, const Reduced &other)
    {
      row.direction -= factor * other.direction;
      for (const auto &[unknown, coefficient] : other.others)
        row.others[unknown] -= factor * coefficient;
      row.value -= factor * other.value;
    }

    template <class Reduced>
    void
    scale(Reduced &row, const double factor)
    {
      row.direction *= factor;
      for (auto &entry : row.others)
        entry.second *= factor;
      row.value *= factor;
    }
  } // namespace



  void
  ConstraintGraph::clear()
  {
    conditions.clear();
    nodes.clear();
  }



  void
  ConstraintGraph::reduce(const Index node, ReducedCondition &reduced) const
  {
    const auto found = nodes.find(node);
    if (found == nodes.end())
      return;
    // In the order of acceptance: each does not contain the pivots of those before.
    for (const ReducedCondition &earlier : found->second)
      {
        subtract(reduced, reduced.direction[earlier.pivot], earlier);
        reduced.direction[earlier.pivot] = 0.;
      }
  }



  Tensor<1, dim>
  ConstraintGraph::free_part(const Index node, Tensor<1, dim> vector) const
  {
    const auto found = nodes.find(node);
    if (found == nodes.end())
      return vector;
    if (found->second.size() >= dim)
      return Tensor<1, dim>();
    // Gram-Schmidt over one or two directions.
    std::vector<Tensor<1, dim>> basis;
    for (const ReducedCondition &condition : found->second)
      {
        Tensor<1, dim> direction = condition.direction;
        for (const Tensor<1, dim> &earlier : basis)
          direction -= (direction * earlier) * earlier;
        basis.push_back(direction / direction.norm());
        vector -= (vector * basis.back()) * basis.back();
      }
    return vector;
  }



  bool
  ConstraintGraph::accept(const Condition &condition, const Treatment treatment)
  {
    ReducedCondition reduced{treatment, 0, condition.direction, {}, condition.value};
    for (const StencilEntry &entry : condition.stencil)
      for (unsigned int d = 0; d < dim; ++d)
        if (condition.direction[d] != 0. && entry.weight != 0.)
          reduced.others[dim * entry.node + d] -= entry.weight * condition.direction[d];
    reduce(condition.node, reduced);

    for (unsigned int d = 1; d < dim; ++d)
      if (std::abs(reduced.direction[d]) > std::abs(reduced.direction[reduced.pivot]))
        reduced.pivot = d;
    if (std::abs(reduced.direction[reduced.pivot]) < dependent)
      return false;

    scale(reduced, 1. / reduced.direction[reduced.pivot]);
    reduced.direction[reduced.pivot]   = 1.;
    std::vector<ReducedCondition> &all = nodes[condition.node];
    // What is eliminated must not refer to another pivot of its own node, or the
    // lines would depend on each other in a circle.
    if (treatment == Treatment::eliminate)
      for (ReducedCondition &earlier : all)
        {
          if (earlier.treatment == Treatment::multiplier)
            continue;
          subtract(earlier, earlier.direction[reduced.pivot], reduced);
          earlier.direction[reduced.pivot] = 0.;
        }
    all.push_back(reduced);
    conditions.push_back(condition);
    return true;
  }



  AffineConstraints<double>
  ConstraintGraph::constraints(const AffineConstraints<double> &hanging,
                               const IndexSet                  &owned,
                               const IndexSet                  &relevant,
                               const MPI_Comm                   communicator) const
  {
    // Owned lines, with what they refer to.
    std::vector<typename AffineConstraints<double>::ConstraintLine> lines;
    for (const auto &line : hanging.get_lines())
      if (owned.is_element(line.index))
        lines.push_back(line);
    for (const auto &[node, reduced] : nodes)
      for (const ReducedCondition &condition : reduced)
        {
          const Index index = dim * node + condition.pivot;
          if (condition.treatment == Treatment::multiplier)
            continue;
          if (hanging.is_constrained(index))
            continue; // a hanging node follows its neighbours
          lines.emplace_back(index);
          auto &entries = lines.back().entries;
          for (unsigned int d = 0; d < dim; ++d)
            if (d != condition.pivot && condition.direction[d] != 0.)
              entries.emplace_back(dim * node + d, -condition.direction[d]);
          for (const auto &[unknown, coefficient] : condition.others)
            if (coefficient != 0.)
              entries.emplace_back(unknown, -coefficient);
          lines.back().inhomogeneity = condition.value;
        }

    // A rank needs the lines of the unknowns in its matrix rows, of those that
    // these lines refer to, of those that the latter refer to, and so on: until
    // no rank meets an unknown that it has not asked for.
    IndexSet needed = relevant;
    for (const auto &[node, reduced] : nodes)
      for (const ReducedCondition &condition : reduced)
        for (const auto &[unknown, coefficient] : condition.others)
          needed.add_index(unknown);
    while (true)
      {
        needed.compress();
        AffineConstraints<double> result(needed);
        for (const auto &line : lines)
          {
            result.add_line(line.index);
            result.add_entries(line.index, line.entries);
            result.set_inhomogeneity(line.index, line.inhomogeneity);
          }
        if (Utilities::MPI::n_mpi_processes(communicator) > 1)
          result.make_consistent_in_parallel(owned, needed, communicator);
        bool complete = true;
        for (const auto &line : result.get_lines())
          for (const auto &entry : line.entries)
            if (!needed.is_element(entry.first))
              {
                needed.add_index(entry.first);
                complete = false;
              }
        if (Utilities::MPI::min(static_cast<int>(complete), communicator) == 1)
          {
            result.close();
            return result;
          }
      }
  }
} // namespace Touchstone

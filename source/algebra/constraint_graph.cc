// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/base/exchange.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/partitioner.h>

#include <algorithm>
#include <cmath>

// Linear independence of all conditions on displacements, prescribed ones and contact, decided
// node by node (doc/theory.md, section 6, 'One constraint graph'), and their translation to
// deal.II's AffineConstraints: lines for elimination and changes of basis for stiff springs
// (section 7). Each condition has two sides: what it prescribes of trial functions, and the force
// that meets it, which is the condition on test functions (section 6.3, equation (22)).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A condition is refused as dependent if its direction, less what earlier conditions of the
     * node determine, is shorter than this, of a length of one: it is within 0.06 degrees of
     * their span, and its multiplier would be a difference of numbers a thousand times as
     * large (doc/theory.md, section 6). */
    constexpr double dependent = 1e-3;

    /**
     * Smaller coefficients are round-off and are left out of constraint lines: references without
     * meaning could close a cycle, which elimination cannot resolve.
     */
    constexpr double negligible = 1e-12;

    /**
     * side <- side - factor * other: a step of elimination, on coefficients, right-hand side and
     * the combination of accepted conditions (origin) alike.
     */
    template <class Side>
    void
    subtract(Side &side, const double factor, const Side &other)
    {
      if (factor == 0.)
        return;
      side.direction -= factor * other.direction;
      side.origin -= factor * other.origin;
      for (const auto &[dof, coefficient] : other.others)
        side.others[dof] -= factor * coefficient;
      side.value -= factor * other.value;
    }

    /** Take the component @p pivot out of @p side by means of @p other, in which it
     * has the coefficient one. */
    template <class Side>
    void
    substitute(Side &side, const unsigned int pivot, const Side &other)
    {
      subtract(side, side.direction[pivot], other);
      side.direction[pivot] = 0.;
    }

    // Scale a side so that its coefficient at the pivot is one, which solves it for that
    // component.
    template <class Side>
    void
    normalise(Side &side, const unsigned int pivot)
    {
      const double factor = 1. / side.direction[pivot];
      side.direction *= factor;
      side.origin *= factor;
      for (auto &entry : side.others)
        entry.second *= factor;
      side.value *= factor;
      side.direction[pivot] = 1.;
    }

    /** @p known and @p more dofs. IndexSet takes single ones one by one into a sorted
     * list, which takes the square of their number. */
    IndexSet
    with(const IndexSet &known, std::vector<Index> more)
    {
      const auto end = std::remove_if(more.begin(), more.end(), [&](const Index i) {
        return known.is_element(i);
      });
      std::sort(more.begin(), end);
      IndexSet result(known);
      result.add_indices(more.begin(), std::unique(more.begin(), end));
      result.compress();
      return result;
    }

    /** A line x_index = inhomogeneity + sum of the next n_entries of those that are sent
     * beside it. */
    struct SentLine
    {
      Index       index;
      double      inhomogeneity;
      std::size_t n_entries;
    };

    struct SentCoefficient
    {
      Index  index;
      double coefficient;
    };

    /** Add the lines that the owners of @p needed dofs have. (deal.II's
     * make_consistent_in_parallel() looks for each one among all that there are, which takes
     * the square of their number.) Collective. */
    void
    add_lines_of_others(AffineConstraints<double> &constraints,
                        const IndexSet            &owned,
                        const IndexSet            &needed,
                        const MPI_Comm             communicator)
    {
      // The partitioner knows both directions: import_indices() are the own dofs that other ranks
      // have among their ghosts, in the order of import_targets(). So owners send without being
      // asked.
      const Utilities::MPI::Partitioner partitioner(owned, needed, communicator);
      std::vector<Index>                asked;
      for (const auto &[begin, end] : partitioner.import_indices())
        for (unsigned int i = begin; i < end; ++i)
          asked.push_back(partitioner.local_to_global(i));
      std::map<unsigned int, std::vector<SentLine>>        sent_lines;
      std::map<unsigned int, std::vector<SentCoefficient>> sent_coefficients;
      auto                                                 next = asked.begin();
      for (const auto &[rank, n] : partitioner.import_targets())
        for (const auto end = next + n; next != end; ++next)
          if (constraints.is_constrained(*next))
            {
              const auto &entries = *constraints.get_constraint_entries(*next);
              sent_lines[rank].push_back(
                {*next, constraints.get_inhomogeneity(*next), entries.size()});
              for (const auto &[index, coefficient] : entries)
                sent_coefficients[rank].push_back({index, coefficient});
            }
      auto coefficients = exchange_records(sent_coefficients, communicator);
      for (const auto &[rank, lines] : exchange_records(sent_lines, communicator))
        {
          auto entry = coefficients[rank].cbegin();
          for (const SentLine &line : lines)
            {
              constraints.add_line(line.index);
              constraints.set_inhomogeneity(line.index, line.inhomogeneity);
              for (const auto end = entry + line.n_entries; entry != end; ++entry)
                constraints.add_entry(line.index, entry->index, entry->coefficient);
            }
        }
    }
  } // namespace



  // Split a form by nodes into the part of the condition's own node, in which the pivot is
  // chosen, and coefficients of all other dofs. The form may name a node several times:
  // terms of equal node add up.
  ConstraintGraph::Side::Side(const Index node, const NodalForm &form, const double value)
    : value(value)
  {
    others.reserve(dim * form.size());
    for (const auto &[other, coefficients] : form)
      if (other == node)
        direction += coefficients;
      else
        for (unsigned int d = 0; d < dim; ++d)
          if (coefficients[d] != 0.)
            others[dim * other + d] += coefficients[d];
  }



  void
  ConstraintGraph::clear()
  {
    conditions.clear();
    nodes.clear();
    numbers.clear();
  }



  // Gaussian elimination of the pivots of earlier conditions of the node, from both sides.
  void
  ConstraintGraph::reduce(const Index node, ReducedCondition &reduced) const
  {
    const auto found = nodes.find(node);
    if (found == nodes.end())
      return;
    // In the order of acceptance: each reduced condition is free of the pivots of those before
    // it, so one pass eliminates all.
    for (const ReducedCondition &earlier : found->second)
      {
        substitute(reduced.trial, earlier.pivot, earlier.trial);
        substitute(reduced.test, earlier.pivot, earlier.test);
      }
  }



  // The projection is orthogonal to the directions of the reduced conditions, which are not
  // orthogonal to each other: hence the orthonormal basis first.
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
        Tensor<1, dim> direction = condition.trial.direction;
        for (const Tensor<1, dim> &earlier : basis)
          direction -= (direction * earlier) * earlier;
        basis.push_back(direction / direction.norm());
        vector -= (vector * basis.back()) * basis.back();
      }
    return vector;
  }



  // One step of Gaussian elimination with pivoting among the components of the node. Trial and
  // test sides share the pivot, since dof and equation are eliminated together.
  bool
  ConstraintGraph::accept(const Condition &condition, const Treatment treatment)
  {
    ReducedCondition reduced;
    reduced.treatment         = treatment;
    reduced.symmetric         = condition.symmetric();
    reduced.trial             = Side(condition.node, condition.motion_form(), condition.value);
    reduced.test              = Side(condition.node, condition.force_form(), 0.);
    const auto         found  = nodes.find(condition.node);
    const unsigned int number = found == nodes.end() ? 0 : found->second.size();
    if (number >= dim)
      return false; // all directions are determined
    // The condition is itself so far; reduce() notes in origin which earlier ones are subtracted,
    // and forces() needs that to tell the forces of the conditions from those of their
    // combinations.
    reduced.trial.origin[number] = reduced.test.origin[number] = 1.;
    reduce(condition.node, reduced);

    // The component whose smaller coefficient of the two sides is the largest (doc/theory.md,
    // section 6.3): a pivot that is small on either side would make its line ill-conditioned.
    double best = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      {
        // Of components that are nearly equal the first: a normal that turns a little from one
        // Newton iteration to the next should keep its pivot, and with it the pattern of the
        // matrix.
        const double size =
          std::min(std::abs(reduced.trial.direction[d]), std::abs(reduced.test.direction[d]));
        if (size > 1.3 * best)
          {
            best          = size;
            reduced.pivot = d;
          }
      }
    if (best < dependent)
      return false;

    normalise(reduced.trial, reduced.pivot);
    normalise(reduced.test, reduced.pivot);
    std::vector<ReducedCondition> &all = nodes[condition.node];
    // Back-substitution: lines of eliminated dofs must not refer to another eliminated dof of the
    // same node, or they would depend on each other in a cycle. Conditions of multipliers are not
    // solved for a dof.
    if (treatment != Treatment::multiplier)
      for (ReducedCondition &earlier : all)
        {
          if (earlier.treatment != treatment)
            continue;
          substitute(earlier.trial, reduced.pivot, reduced.trial);
          substitute(earlier.test, reduced.pivot, reduced.test);
          earlier.symmetric = earlier.symmetric && reduced.symmetric;
        }
    all.push_back(std::move(reduced));
    conditions.push_back(condition);
    numbers.push_back(number);
    return true;
  }



  // Forces mu of eliminated conditions, in units of force, from balance at the eliminated dofs.
  // Sweeps repeat until nothing changes: a force also acts on the dofs of its stencil, and if one
  // of these is eliminated by another condition, that one gets its share in the next sweep.
  std::vector<double>
  ConstraintGraph::forces(const Vector                        &residual,
                          const std::function<void(Vector &)> &condense) const
  {
    // r_p + sum_k mu_k F_kp = 0 for the eliminated dofs p (doc/theory.md, section 7) is solved by
    // substitution, since F is triangular: a condition refers to dofs that others eliminate, but
    // never back. Such chains have a few members; more would be a cycle.
    constexpr unsigned int longest   = 1000;
    constexpr double       round_off = 1e-14;

    Vector rest(residual);
    condense(rest);
    std::map<Index, Tensor<1, dim>> by_pivot;
    double                          largest = 0.;
    for (unsigned int pass = 0;; ++pass)
      {
        AssertThrow(pass < longest, ExcMessage("Conditions depend on each other in a cycle."));
        std::vector<Index>  dofs;
        std::vector<double> values;
        double              change = 0.;
        for (const auto &[node, reduced] : nodes)
          for (unsigned int k = 0; k < reduced.size(); ++k)
            {
              if (reduced[k].treatment != Treatment::eliminate)
                continue;
              const Side  &side  = reduced[k].test;
              const double force = -rest(dim * node + reduced[k].pivot);
              by_pivot[node][k] += force;
              change  = std::max(change, std::abs(force));
              largest = std::max(largest, std::abs(by_pivot[node][k]));
              for (unsigned int d = 0; d < dim; ++d)
                {
                  dofs.push_back(dim * node + d);
                  values.push_back(force * side.direction[d]);
                }
              for (const auto &[dof, coefficient] : side.others)
                {
                  dofs.push_back(dof);
                  values.push_back(force * coefficient);
                }
            }
        const MPI_Comm communicator = residual.get_mpi_communicator();
        if (Utilities::MPI::max(change, communicator) <=
            round_off * Utilities::MPI::max(largest, communicator))
          break;
        // Stencils reach nodes of other ranks, so the sum is collective; so is the decision to
        // stop above.
        rest.add(dofs, values);
        rest.compress(VectorOperation::add);
        condense(rest);
      }

    // From reduced conditions back to those that were accepted: reduced condition k is the sum of
    // accepted conditions times origin, and its force counts for each of them in that proportion.
    std::vector<double> result(conditions.size(), 0.);
    for (std::size_t i = 0; i < conditions.size(); ++i)
      {
        const auto &reduced = nodes.at(conditions[i].node);
        for (unsigned int k = 0; k < reduced.size(); ++k)
          if (reduced[k].treatment == Treatment::eliminate)
            result[i] += by_pivot.at(conditions[i].node)[k] * reduced[k].test.origin[numbers[i]];
      }
    return result;
  }



  bool
  ConstraintGraph::symmetric(const Treatment treatment) const
  {
    for (const auto &[node, reduced] : nodes)
      for (const ReducedCondition &condition : reduced)
        if (condition.treatment == treatment && !condition.symmetric)
          return false;
    return true;
  }



  AffineConstraints<double>
  ConstraintGraph::make_constraints(Side ReducedCondition::         *side,
                                    const AffineConstraints<double> &hanging,
                                    const IndexSet                  &owned,
                                    const IndexSet                  &relevant,
                                    const MPI_Comm                   communicator) const
  {
    // Lines of owned dofs: hanging nodes first, then each eliminated condition solved for its
    // pivot.
    std::vector<typename AffineConstraints<double>::ConstraintLine> lines;
    for (const auto &line : hanging.get_lines())
      if (owned.is_element(line.index))
        lines.push_back(line);
    for (const auto &[node, reduced] : nodes)
      for (const ReducedCondition &condition : reduced)
        {
          const Index index = dim * node + condition.pivot;
          if (condition.treatment != Treatment::eliminate)
            continue;
          if (hanging.is_constrained(index))
            continue; // a hanging node follows its neighbours
          lines.emplace_back(index);
          auto       &entries = lines.back().entries;
          const Side &known   = condition.*side;
          for (unsigned int d = 0; d < dim; ++d)
            if (d != condition.pivot && std::abs(known.direction[d]) > negligible)
              entries.emplace_back(dim * node + d, -known.direction[d]);
          for (const auto &[dof, coefficient] : known.others)
            if (std::abs(coefficient) > negligible)
              entries.emplace_back(dof, -coefficient);
          lines.back().inhomogeneity = known.value;
        }

    // A rank needs the lines of the dofs in its matrix rows, of those that
    // these lines refer to, of those that the latter refer to, and so on: until
    // no rank meets a dof that it has not asked for.
    std::vector<Index> far;
    for (const auto &[node, reduced] : nodes)
      for (const ReducedCondition &condition : reduced)
        for (const auto &[dof, coefficient] : (condition.*side).others)
          far.push_back(dof);
    IndexSet needed = with(relevant, far);
    while (true)
      {
        AffineConstraints<double> result(needed);
        for (const auto &line : lines)
          {
            result.add_line(line.index);
            result.add_entries(line.index, line.entries);
            result.set_inhomogeneity(line.index, line.inhomogeneity);
          }
        if (Utilities::MPI::n_mpi_processes(communicator) > 1)
          add_lines_of_others(result, owned, needed, communicator);
        far.clear();
        for (const auto &line : result.get_lines())
          for (const auto &entry : line.entries)
            if (!needed.is_element(entry.first))
              far.push_back(entry.first);
        if (Utilities::MPI::max(static_cast<int>(!far.empty()), communicator) == 0)
          {
            result.close();
            return result;
          }
        needed = with(needed, far);
      }
  }



  AffineConstraints<double>
  ConstraintGraph::make_basis_change(Side ReducedCondition::         *kind,
                                     const AffineConstraints<double> &constraints,
                                     const IndexSet                  &owned,
                                     const IndexSet                  &relevant,
                                     const MPI_Comm                   communicator) const
  {
    int here = 0;
    for (const auto &[node, reduced] : nodes)
      for (const ReducedCondition &condition : reduced)
        here |= (condition.treatment == Treatment::spring);
    if (Utilities::MPI::max(here, communicator) == 0)
      return AffineConstraints<double>();

    // Two rounds, as a line must not refer to another changed dof (CondensedSystem substitutes
    // once): the first finds out which dofs are changed on all ranks, the second makes their
    // lines without these.
    std::vector<Index> far;
    for (const auto &line : constraints.get_lines())
      for (const auto &entry : line.entries)
        far.push_back(entry.first);
    for (const auto &[node, reduced] : nodes)
      for (const ReducedCondition &condition : reduced)
        for (const auto &[dof, coefficient] : (condition.*kind).others)
          far.push_back(dof);
    const IndexSet            needed = with(relevant, far);
    AffineConstraints<double> known(needed);
    for (const bool with_entries : {false, true})
      {
        AffineConstraints<double> result(needed);
        const auto                plain = [&](const Index i) {
          return !known.is_constrained(i) && !constraints.is_constrained(i);
        };
        for (const auto &[node, reduced] : nodes)
          for (const ReducedCondition &condition : reduced)
            {
              const Index index = dim * node + condition.pivot;
              if (condition.treatment != Treatment::spring || constraints.is_constrained(index))
                continue;
              result.add_line(index);
              if (!with_entries)
                continue;
              std::map<Index, double> entries;
              // References to eliminated dofs are resolved at once, so that B follows C in T = C
              // B D; references to other changed dofs are dropped, which any change of basis
              // allows (doc/theory.md, end of section 7).
              const auto add = [&](const Index dof, const double factor) {
                if (constraints.is_constrained(dof))
                  {
                    for (const auto &entry : *constraints.get_constraint_entries(dof))
                      if (plain(entry.first))
                        entries[entry.first] += factor * entry.second;
                  }
                else if (plain(dof))
                  entries[dof] += factor;
              };
              const Side &side = condition.*kind;
              for (unsigned int d = 0; d < dim; ++d)
                if (d != condition.pivot && side.direction[d] != 0.)
                  add(dim * node + d, -side.direction[d]);
              for (const auto &[dof, coefficient] : side.others)
                if (coefficient != 0.)
                  add(dof, -coefficient);
              result.add_entries(index, {entries.begin(), entries.end()});
            }
        if (Utilities::MPI::n_mpi_processes(communicator) > 1)
          add_lines_of_others(result, owned, needed, communicator);
        known.clear();
        known.reinit(needed);
        known.copy_from(result);
      }
    known.close();
    return known;
  }
} // namespace Touchstone

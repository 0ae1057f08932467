// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/archive/archive.h>
#include <touchstone/contact/contact.h>
#include <touchstone/contact/enforcement/enforcement.h>
#include <touchstone/contact/enforcement/row_terms.h>
#include <touchstone/contact/friction/friction_response.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

// Penalty method and augmented Lagrangian (doc/theory.md 6): each accepted condition of an active
// row is a spring of stiffness epsilon = factor E A / h; the system stays definite and needs no
// multipliers. The two differ in whether the force is augmented and which gap is admitted when
// convergence is judged.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /**
     * Springs between slave node and master surface, lambda = lambda_k - epsilon g:
     * with lambda_k = 0 the penalty method, with lambda_k following the forces the
     * augmented Lagrangian. Without friction and with frozen normals the system stays
     * symmetric positive definite.
     * Alart and Curnier (1991), Comput. Methods Appl. Mech. Engng 92;
     * Laursen (2002), Computational Contact and Impact Mechanics.
     */
    class SpringEnforcement : public Enforcement
    {
    public:
      /** @param factor Spring stiffness over ContactRow::stiffness. */
      explicit SpringEnforcement(const double factor)
        : augmentation(*this, "augmentation")
        , factor(factor)
      {
      }

      void
      begin_step() override
      {
        solved   = false;
        n_solves = 0;
      }

      void
      commit() override
      {
        Enforcement::commit();
        committed_growth = growth;
      }

      void
      rollback() override
      {
        Enforcement::rollback();
        growth = committed_growth;
      }

      void
      save(ArchiveWriter &archive) const override
      {
        Enforcement::save(archive);
        archive.put("spring growth", committed_growth);
      }

      void
      load(const ArchiveReader &archive) override
      {
        Enforcement::load(archive);
        growth = committed_growth = archive.get<double>("spring growth");
      }

      void
      take(const LinearSolution &solution) override
      {
        // Force after the solve: lambda_k - epsilon (g + dg), with dg from the increment. It
        // differs from -epsilon g of the next state by what the linearisation leaves out.
        std::vector<LinearForm> forms;
        for (const Spring &spring : springs)
          forms.push_back(by_unknowns(spring.condition.motion_form()));
        const std::vector<double> elongations = evaluate_forms(forms, solution.increment);
        for (std::size_t k = 0; k < springs.size(); ++k)
          springs[k].force -= springs[k].epsilon * elongations[k];
      }

      double
      round_off_squared(const ContactRows &rows, const double length) const override
      {
        // Positions of magnitude `length` are known up to machine precision; a gap is the
        // difference of a few of them, and the spring turns its error into a force.
        double sum = 0.;
        for (const ContactRow &row : rows)
          if (row_states[row].active() && by_gap(row))
            sum += std::pow(4. * std::numeric_limits<double>::epsilon() * length * factor *
                              row.stiffness,
                            2);
        return sum;
      }

    protected:
      /** Force at the last augmentation: normal force, and the rest of it. */
      struct Augmentation
      {
        double         lambda = 0.;
        Tensor<1, dim> rest;

        template <class Self, class Visitor>
        static void
        visit_state(Self &self, Visitor &&visit)
        {
          visit(self.lambda);
          visit(self.rest);
        }
      };
      Memory<Augmentation> augmentation;

      void
      evaluate(const Contact &contact, const Vector &, const ConstraintGraph &) override
      {
        for (const ContactRow &row : contact.rows())
          {
            RowState &state = row_states[row];
            if (!state.active() || state.dropped())
              continue;
            if (solved && row.friction && state.fully_constrained())
              augment_unconstrained(row, state);
            if (solved && !row.friction && !by_gap(row))
              evaluate_force(row, state); // the force of the linear solve
            else
              evaluate_row(row, state);
            admit_gap(row, solved);
          }
        if (solved && stiffens())
          stiffen(contact.communicator());
        solved = false;
      }

      void
      constrain(const Contact &contact, ConstraintGraph &graph, LinearSystem &system) override
      {
        // The residual was judged with the forces before the augmentation; the linear system
        // starts from those after it, so its residual is computed again.
        Vector residual;
        if (system.keep_symmetric)
          {
            residual = system.rhs;
            contact.add_forces(residual);
          }
        for (const ContactRow &row : contact.rows())
          if (RowState &state = row_states[row]; state.active() && row.friction)
            {
              // The forces may have been augmented since they were evaluated, so that the friction
              // response has to be made anew for the linear system.
              choose_formulation(row, state, epsilon(row));
              friction_response(row, state.status, normal_force(row), state.friction);
              if (system.keep_symmetric)
                lag_friction(row, state, balancing_force(row, residual, graph));
            }

        springs.clear();
        RowTerms terms(system);
        // As in ExactEnforcement: of two dependent conditions the graph keeps the earlier one, and
        // those along normals precede those of stick.
        std::vector<std::pair<const ContactRow *, Condition>> stick;
        for (const ContactRow &row : contact.rows())
          {
            start_row(row_states[row]);
            const std::vector<Condition> conditions =
              row_conditions(row, row_states[row], system.keep_symmetric);
            for (std::size_t k = 0; k < conditions.size(); ++k)
              if (k == 0 || row.tied)
                add_spring(row, conditions[k], graph, system, terms);
              else
                stick.emplace_back(&row, conditions[k]);
          }
        for (const auto &[row, condition] : stick)
          add_spring(*row, condition, graph, system, terms);
        terms.finish();
      }

      void
      set_forces(const Contact &) override
      {
        for (const Spring &spring : springs)
          row_states[*spring.row].force = Tensor<1, dim>();
        for (const Spring &spring : springs)
          row_states[*spring.row].force += spring.force * spring.condition.direction;
        std::set<const ContactRow *> found;
        for (const Spring &spring : springs)
          // After the sum over all springs of a row, which can be three.
          if (found.insert(spring.row).second)
            {
              const ContactRow &row   = *spring.row;
              RowState         &state = row_states[row];
              state.lambda            = state.force * spring.normal;
              if (row.friction && state.fully_constrained())
                set_stick(state, spring.normal);
            }
        solved = true;
        ++n_solves;
      }

      void
      adopted(const ContactRow &row) override
      {
        augment(row);
      }

      /** Augmentation: the present force becomes lambda_k, to which the spring adds. */
      void
      augment(const ContactRow &row)
      {
        const RowState &state    = row_states[row];
        augmentation[row].rest   = row.tied ? state.force : state.force - state.lambda * row.normal;
        augmentation[row].lambda = state.lambda;
      }

      /** Set the admissible gap of the row, and decide whether its force is augmented;
       * @p solved says that the gap is the outcome of a solve, and not the
       * overlap that a step begins with. */
      virtual void
      admit_gap(const ContactRow &row, bool solved) = 0;

      /** Whether the force of the row is that of its spring at the present gap, and not that
       * which the spring had in the last linear solve. */
      virtual bool
      by_gap(const ContactRow &) const
      {
        return true;
      }

      /** Whether the springs become stiffer where an iteration closes gaps too little. */
      virtual bool
      stiffens() const
      {
        return false;
      }

      /** Decide what the friction of the row starts from; @p epsilon is the
       * stiffness of the normal spring. */
      virtual void
      choose_formulation(const ContactRow &row, RowState &state, double epsilon) const = 0;

    private:
      /** A condition that a spring meets: its force before a solve, then after it; its stiffness;
       * the normal of the row in the linear system. */
      struct Spring
      {
        const ContactRow *row;
        Condition         condition;
        double            force, epsilon;
        Tensor<1, dim>    normal;
      };

      const double        factor;
      std::vector<Spring> springs; // of rows that do not go by_gap()
      bool                solved = false;
      /** How many times stiffer the springs are than when the run began, and after the last step;
       * the linear solves of the step. */
      double       growth = 1., committed_growth = 1.;
      unsigned int n_solves = 0;

      /** Stiffness of the springs of a row, force per length. */
      double
      epsilon(const ContactRow &row) const
      {
        return growth * factor * row.stiffness;
      }

      /** Component of gap or slip along the condition of a spring, at present. */
      static double
      violation(const Spring &spring)
      {
        const ContactRow     &row       = *spring.row;
        const Tensor<1, dim> &direction = spring.condition.direction;
        if (row.tied)
          return row.gap_vector * direction;
        // Tangents are perpendicular to the normal of the linear system.
        const bool normal = direction * spring.normal > 0.5;
        return normal ? row.gap : row.friction->kinematics.slip * direction;
      }

      /**
       * Stiffer springs from now on if the last linear solve has not closed the gaps
       * by a factor of four. The method of multipliers reduces them by 1/(1 + epsilon s), with s
       * the eigenvalues of B K^-1 B^T: slowly where the bodies are much stiffer than E A / h, as
       * near incompressibility, and not at all for small negative ones, where the tangent is
       * indefinite and only contact makes the state stable. The first solve of a step brings the
       * change of the load, and is not judged. Bertsekas (1982), Constrained Optimization and
       * Lagrange Multiplier Methods, section 2.2.
       */
      void
      stiffen(const MPI_Comm communicator)
      {
        constexpr double closes = 0.25, by = 10., stiffest = 1e3;
        double           before = 0., after = 0.;
        for (const Spring &spring : springs)
          if (row_states[*spring.row].active())
            {
              const double size = spring.row->size;
              before            = std::max(before, std::abs(spring.condition.value) / size);
              after             = std::max(after, std::abs(violation(spring)) / size);
            }
        before = Utilities::MPI::max(before, communicator);
        after  = Utilities::MPI::max(after, communicator);
        if (n_solves > 1 && after > closes * before)
          growth = std::min(by * growth, stiffest);
      }

      /**
       * The normal force that would balance the slave node, as the last linear solution intended.
       * Normals and weights change during an increment, and the linearised gap misses that; times
       * epsilon this error is a large force. Friction lagged with it would move the nodes along the
       * surface, which causes the next error of this kind: with stiff springs on warped faces the
       * iteration would not converge (doc/theory.md 6.3, "Lagged friction").
       */
      double
      balancing_force(const ContactRow      &row,
                      const Vector          &residual,
                      const ConstraintGraph &graph) const
      {
        Tensor<1, dim> rest;
        for (unsigned int d = 0; d < dim; ++d)
          rest[d] = residual(dim * row.slave + d);
        return row_states[row].lambda - graph.free_part(row.slave, rest) * row.normal;
      }

      /** Normal force of a row: of its spring at the present gap, or, with friction and not
       * by_gap(), that of the last linear solve. */
      double
      normal_force(const ContactRow &row) const
      {
        return !row.friction || by_gap(row) ? augmentation[row].lambda - epsilon(row) * row.gap
                                            : row_states[row].lambda;
      }

      /** Forces of an active row from its gap and slip. */
      void
      evaluate_row(const ContactRow &row, RowState &state)
      {
        if (row.tied)
          {
            state.force  = augmentation[row].rest - epsilon(row) * row.gap_vector;
            state.lambda = state.force * row.normal;
            return;
          }
        state.lambda = normal_force(row);
        if (row.friction)
          choose_formulation(row, state, epsilon(row));
        evaluate_force(row, state);
      }

      /** Meet a condition of a row by a spring, if the graph accepts it. */
      void
      add_spring(const ContactRow &row,
                 const Condition  &condition,
                 ConstraintGraph  &graph,
                 LinearSystem     &system,
                 RowTerms         &terms)
      {
        if (!row_states[row].record(condition,
                                    graph.accept(condition, ConstraintGraph::Treatment::spring)))
          return;
        if (!condition.symmetric())
          system.symmetric = false;
        // The force after the iteration is lambda_k - epsilon (g + dg),
        // and the condition's value is -g.
        const double         stiffness = epsilon(row);
        const Tensor<1, dim> direction = condition.force();
        Tensor<1, dim>       augmented = augmentation[row].rest;
        if (!row.tied)
          augmented += (augmentation[row].lambda - augmented * row.normal) * row.normal;
        const double force = augmented * condition.direction + stiffness * condition.value;
        terms.add_load(row, force * direction);
        terms.add_stiffness(row, stiffness * direction, condition.motion_form());
        if (!by_gap(row))
          springs.push_back({&row, condition, force, stiffness, row.normal});
      }
    };



    class Penalty : public SpringEnforcement
    {
    public:
      explicit Penalty(const ContactParameters &parameters)
        : SpringEnforcement(100. * parameters.penalty_factor)
        , factor(100. * parameters.penalty_factor)
        , rule{ImpulseRule::Method::bulk_springs, 0.1 * parameters.penalty_factor}
      {
      }

      const ImpulseRule *
      impulse_rule() const override
      {
        return &rule;
      }

      /** No component of a unit normal exceeds this: cyclic rows are kept, for each has a spring
       * of its own and no system becomes singular. */
      double
      cycle_threshold() const override
      {
        return 2.;
      }

    private:
      const double      factor;
      const ImpulseRule rule;

      void
      admit_gap(const ContactRow &row, bool) override
      {
        RowState &state = row_states[row];
        if (by_gap(row))
          state.admissible_gap = row.tied ? row.gap_vector.norm() : row.gap;
        else
          // lambda / epsilon is the penetration that belongs to the force of the linear solve; what
          // the gap differs from it is judged. After a change of the mesh the springs begin with
          // the transferred force as augmentation.
          state.admissible_gap =
            (augmentation[row].lambda - state.lambda) / (factor * row.stiffness);
      }

      /** Friction depends on the normal force. Before equilibrium -epsilon g is wrong by the error
       * of the gap times epsilon: with stiff springs all rows would stick at first, and their
       * geometric stiffness would be too large (doc/theory.md 6.3, "Penalty with friction"). */
      bool
      by_gap(const ContactRow &row) const override
      {
        // Tied rows and those without friction: the present gap, others: the last linear solve.
        return row.tied || !row.friction;
      }

      void
      choose_formulation(const ContactRow &row, RowState &state, double) const override
      {
        regularise_friction(row, state);
      }
    };

    class AugmentedLagrange : public SpringEnforcement
    {
    public:
      explicit AugmentedLagrange(const ContactParameters &parameters)
        : SpringEnforcement(20. * parameters.penalty_factor)
        , merged(parameters.augmentation == ContactParameters::Augmentation::merged)
        , rule{ImpulseRule::Method::augmentation, parameters.penalty_factor}
      {
      }

      const ImpulseRule *
      impulse_rule() const override
      {
        return &rule;
      }

      void
      balanced(const Contact &contact) override
      {
        for (const ContactRow &row : contact.rows())
          augment(row);
      }

    private:
      const bool        merged;
      const ImpulseRule rule;

      bool
      stiffens() const override
      {
        return merged;
      }

      void
      admit_gap(const ContactRow &row, const bool solved) override
      {
        // The augmentation closes gaps, so none is admitted. Merged augmentation follows each
        // linear solve; the overlap with which a step begins must not become a force.
        row_states[row].admissible_gap = 0.;
        if (merged && solved)
          augment(row);
      }

      /** Merged, the force is that of the linearised gap and slip. One of the gap itself would turn
       * the change of normals and contact points into forces, the larger the stiffer the
       * springs; with friction these move nodes along the surface, change stick and slip, and the
       * iteration does not converge. */
      bool
      by_gap(const ContactRow &) const override
      {
        return !merged;
      }

      void
      choose_formulation(const ContactRow &row,
                         RowState         &state,
                         const double      epsilon) const override
      {
        // Merged: as with multipliers, but springs meet the conditions of stick.
        choose_friction(row, state);
        FrictionForce &f = state.friction;
        if (merged || f.carried)
          return;
        // Augmented friction: no condition and no elastic slip, the base is the force of the last
        // augmentation (table in doc/theory.md 6.1).
        f.constrained = false;
        f.c           = epsilon;
        f.base        = augmentation[row].rest;
      }
    };

    const EnforcementRegistry::Entry<Penalty>
      penalty("penalty", "springs; leaves a penetration of force over penalty");
    const EnforcementRegistry::Entry<AugmentedLagrange>
      augmented_lagrange("augmented lagrange",
                         "springs whose forces are augmented until gaps close");
  } // namespace
} // namespace Touchstone

#include <touchstone/contact/enforcement.h>

#include <cmath>
#include <limits>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /**
     * Springs between slave node and master surface, lambda = lambda_k - epsilon g:
     * with lambda_k = 0 the penalty method, with lambda_k following the forces the
     * augmented Lagrangian. The system stays symmetric positive definite.
     * Alart and Curnier (1991), Comput. Methods Appl. Mech. Engng 92;
     * Laursen (2002), Computational Contact and Impact Mechanics.
     */
    class SpringEnforcement : public Enforcement
    {
    public:
      /** @param factor Spring stiffness over ContactRow::stiffness. */
      explicit SpringEnforcement(const double factor)
        : factor(factor)
      {
      }

      void
      recover(Contact &contact, const Vector &, const ConstraintGraph &) override
      {
        for (auto &pair_rows : contact.rows)
          for (ContactRow &row : pair_rows)
            {
              if (!row.active() || row.dropped())
                continue;
              const double epsilon = factor * row.stiffness;
              if (row.status == ContactStatus::slip)
                {
                  row.lambda = row.augmented * row.normal - epsilon * row.gap;
                  row.force  = row.lambda * row.normal;
                }
              else
                {
                  row.force  = row.augmented - epsilon * row.gap_vector;
                  row.lambda = row.force * row.normal;
                }
              grant(row, solved);
            }
        solved = false;
      }

      void
      enforce(Contact &contact, ConstraintGraph &graph, LinearSystem &system) override
      {
        std::vector<Index>  unknowns;
        std::vector<double> forces;
        for (auto &pair_rows : contact.rows)
          for (ContactRow &row : pair_rows)
            for (const Condition &condition : start_row(row))
              {
                const bool accepted =
                  graph.accept(condition, ConstraintGraph::Treatment::multiplier);
                row.take(accepted);
                if (accepted)
                  add_spring(condition,
                             factor * row.stiffness,
                             row.augmented * condition.direction,
                             system,
                             unknowns,
                             forces);
              }
        system.rhs.add(unknowns, forces);
        system.rhs.compress(VectorOperation::add);
      }

      void
      update(Contact &, const std::vector<double> &) override
      {
        solved = true;
      }

      double
      round_off_squared(const Contact &contact, const double length) const override
      {
        double sum = 0.;
        for (const auto &pair_rows : contact.rows)
          for (const ContactRow &row : pair_rows)
            if (row.active())
              sum += std::pow(4. * std::numeric_limits<double>::epsilon() * length * factor *
                                row.stiffness,
                              2);
        return sum;
      }

    protected:
      /** Decide what gap the row may have, and whether its force is augmented;
       * @p solved says that the gap is the outcome of a solve, and not the
       * overlap that a step begins with. */
      virtual void
      grant(ContactRow &row, bool solved) const = 0;

    private:
      const double factor;
      bool         solved = false;

      /** The force after the iteration is lambda_k - epsilon (g + B du), where
       * the condition's value is -g. */
      static void
      add_spring(const Condition     &condition,
                 const double         epsilon,
                 const double         augmented,
                 LinearSystem        &system,
                 std::vector<Index>  &unknowns,
                 std::vector<double> &forces)
      {
        std::vector<std::pair<Index, double>> row;
        for (unsigned int d = 0; d < dim; ++d)
          if (condition.direction[d] != 0.)
            {
              row.emplace_back(dim * condition.node + d, condition.direction[d]);
              for (const StencilEntry &entry : condition.stencil)
                row.emplace_back(dim * entry.node + d, -entry.weight * condition.direction[d]);
            }
        for (const auto &[i, bi] : row)
          {
            unknowns.push_back(i);
            forces.push_back(bi * (augmented + epsilon * condition.value));
            for (const auto &[j, bj] : row)
              system.terms.push_back({i, j, epsilon * bi * bj});
          }
      }
    };



    class Penalty : public SpringEnforcement
    {
    public:
      explicit Penalty(const ContactParameters &parameters)
        : SpringEnforcement(100. * parameters.penalty_factor)
      {
      }

    private:
      void
      grant(ContactRow &row, bool) const override
      {
        row.granted_gap = row.tied ? row.gap_vector.norm() : row.gap;
      }
    };

    class AugmentedLagrange : public SpringEnforcement
    {
    public:
      explicit AugmentedLagrange(const ContactParameters &parameters)
        : SpringEnforcement(20. * parameters.penalty_factor)
        , merged(parameters.augmentation == "merged")
      {
      }

      void
      balanced(Contact &contact) override
      {
        for (auto &pair_rows : contact.rows)
          for (ContactRow &row : pair_rows)
            row.augmented = row.force;
      }

    private:
      const bool merged;

      void
      grant(ContactRow &row, const bool solved) const override
      {
        row.granted_gap = 0.;
        if (merged && solved)
          row.augmented = row.force;
      }
    };

    const EnforcementRegistry::Entry<Penalty>
      penalty("penalty", "springs; leaves a penetration of force over penalty");
    const EnforcementRegistry::Entry<AugmentedLagrange>
      augmented_lagrange("augmented lagrange",
                         "springs whose forces are augmented until gaps close");
  } // namespace
} // namespace Touchstone

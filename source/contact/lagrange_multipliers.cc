#include <touchstone/contact/enforcement.h>
#include <touchstone/contact/row_terms.h>

#include <deal.II/base/mpi.h>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Contact forces are unknowns of the saddle-point system
     * [K B^T; B 0] [du; -lambda] = [f; -g]. */
    class LagrangeMultipliers : public Enforcement
    {
    public:
      explicit LagrangeMultipliers(const ContactParameters &)
      {
      }

      void
      recover(Contact &contact, const Vector &, const ConstraintGraph &) override
      {
        // The force follows the present normal.
        for (auto &pair_rows : contact.rows)
          for (ContactRow &row : pair_rows)
            if (row.active() && !row.tied)
              {
                if (row.friction)
                  choose_friction(row);
                respond(row);
              }
      }

      void
      enforce(Contact &contact, ConstraintGraph &graph, LinearSystem &system) override
      {
        multipliers.clear();
        for (auto &pair_rows : contact.rows)
          for (ContactRow &row : pair_rows)
            {
              for (const Condition &condition : start_row(row, system.keep_symmetric))
                {
                  const bool accepted =
                    graph.accept(condition, ConstraintGraph::Treatment::multiplier);
                  row.take(accepted);
                  if (accepted)
                    multipliers.push_back({&row, condition, row.stiffness});
                }
            }

        system.n_extra = multipliers.size();
        const auto counts =
          Utilities::MPI::all_gather(system.rhs.get_mpi_communicator(), multipliers.size());
        const unsigned int rank =
          Utilities::MPI::this_mpi_process(system.rhs.get_mpi_communicator());
        system.first_extra = system.rhs.size();
        for (unsigned int r = 0; r < rank; ++r)
          system.first_extra += counts[r];
        system.definite = false;
        for (unsigned int k = 0; k < multipliers.size(); ++k)
          {
            const Index      extra     = system.first_extra + k;
            const Condition &condition = multipliers[k].condition;
            // Scaled to the size of the stiffness, so that neither block is lost
            // in the other's round-off.
            const double scale = multipliers[k].scale;
            system.terms.push_back({{{extra, scale}}, by_unknowns(condition.motion_form())});
            system.terms.push_back({by_unknowns(condition.force_form()), {{extra, scale}}});
            if (!condition.symmetric())
              system.symmetric = false;
            system.extra_rhs.push_back(scale * condition.value);
          }
      }

      void
      update(Contact &, const std::vector<double> &extra) override
      {
        for (const Multiplier &multiplier : multipliers)
          multiplier.row->force = Tensor<1, dim>();
        for (unsigned int k = 0; k < multipliers.size(); ++k)
          multipliers[k].row->force -=
            multipliers[k].scale * extra[k] * multipliers[k].condition.direction;
        for (const Multiplier &multiplier : multipliers)
          {
            ContactRow &row = *multiplier.row;
            row.lambda      = row.force * row.normal;
            if (row.friction && row.held())
              row.friction->base = row.force - row.lambda * row.normal;
          }
      }

    private:
      struct Multiplier
      {
        ContactRow *row;
        Condition   condition;
        double      scale;
      };
      std::vector<Multiplier> multipliers;
    };

    const EnforcementRegistry::Entry<LagrangeMultipliers>
      entry("lagrange multipliers", "contact forces as unknowns; needs a direct solver");
  } // namespace
} // namespace Touchstone

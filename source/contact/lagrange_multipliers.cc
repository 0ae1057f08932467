#include <touchstone/contact/exact_enforcement.h>
#include <touchstone/contact/row_terms.h>

#include <deal.II/base/mpi.h>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Contact forces are unknowns of the saddle-point system
     * [K B^T; B 0] [du; -lambda] = [f; -g]. */
    class LagrangeMultipliers : public ExactEnforcement
    {
    public:
      explicit LagrangeMultipliers(const ContactParameters &)
      {
      }

    protected:
      ConstraintGraph::Treatment
      treatment() const override
      {
        return ConstraintGraph::Treatment::multiplier;
      }

      void
      add_to_system(const std::vector<Accepted> &accepted, LinearSystem &system) override
      {
        const MPI_Comm communicator = system.rhs.get_mpi_communicator();
        system.n_extra              = accepted.size();
        const auto counts           = Utilities::MPI::all_gather(communicator, accepted.size());
        system.first_extra          = system.rhs.size();
        for (unsigned int r = 0; r < Utilities::MPI::this_mpi_process(communicator); ++r)
          system.first_extra += counts[r];
        system.definite = false;
        for (std::size_t k = 0; k < accepted.size(); ++k)
          {
            const Index      extra     = system.first_extra + k;
            const Condition &condition = accepted[k].condition;
            // Scaled to the size of the stiffness, so that neither block is lost
            // in the other's round-off.
            const double scale = accepted[k].row->stiffness;
            system.terms.push_back({{{extra, scale}}, by_unknowns(condition.motion_form())});
            system.terms.push_back({by_unknowns(condition.force_form()), {{extra, scale}}});
            if (!condition.symmetric())
              system.symmetric = false;
            system.extra_rhs.push_back(scale * condition.value);
          }
      }

      std::vector<double>
      multipliers(const std::vector<Accepted> &accepted,
                  const LinearSolution        &solution) const override
      {
        std::vector<double> result;
        for (std::size_t k = 0; k < accepted.size(); ++k)
          result.push_back(-accepted[k].row->stiffness * solution.extra[k]);
        return result;
      }
    };

    const EnforcementRegistry::Entry<LagrangeMultipliers>
      entry("lagrange multipliers", "contact forces as unknowns; needs a direct solver");
  } // namespace
} // namespace Touchstone

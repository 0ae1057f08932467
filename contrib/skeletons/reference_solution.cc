// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/verification/reference_solution.h>

namespace Touchstone
{
  namespace
  {
    /** @brief The magnitude of the contact force of a pair. */
    class TotalForce : public ReferenceSolution
    {
    public:
      explicit TotalForce(const Scene &scene)
        : pair(reference_pair(scene))
      {
        ReferenceValues values(scene.reference.values);
        exact = values.positive_number("force");
        values.finish(); // complains about names that nobody asked for
      }

      ReferenceComparison
      compare(const ReferenceInput &input) const override
      {
        ReferenceComparison result;
        result.add("total_force", "contact force", input.pair_results[pair].force.norm(), exact);
        return result;
      }

    private:
      unsigned int pair;
      double       exact;
    };

    const ReferenceRegistry::Entry<TotalForce>
      total_force("total force", "The contact force of a pair. Values: 'force'.");
  } // namespace
} // namespace Touchstone

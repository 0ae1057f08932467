// SPDX-License-Identifier: LGPL-2.1-or-later
// A field of the VTU files of bodies to start from. Copy to source/output/NAME.cc and change
// what is marked TODO: nothing else need be edited.

#include <touchstone/output/volume_field.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>

namespace Touchstone
{
  namespace
  {
    /** TODO: what the field shows: here the largest principal stress, which opens cracks. */
    class LargestPrincipalStress : public VolumeField
    {
    public:
      void
      evaluate(const VolumeState &state, std::vector<double> &values) const override
      {
        for (std::size_t k = 0; k < values.size(); ++k)
          values[k] = dealii::eigenvalues(state.node_stress[k])[0]; // they are in descending order
      }
    };

    // TODO: the name in the files, and what it is, with its unit.
    const VolumeFieldRegistry::Entry<LargestPrincipalStress>
      largest_principal_stress("largest_principal_stress",
                               "Largest eigenvalue of the stress; force per area.");
  } // namespace
} // namespace Touchstone

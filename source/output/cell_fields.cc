// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/volume_field.h>
#include <touchstone/output/von_mises.h>

/**
 * @file
 * Stresses of the cells as they are, not averaged at nodes: how far neighbours differ says how far
 * the mesh is from the solution. They are written if the scene asks for them.
 */

namespace Touchstone
{
  namespace
  {
    class UnsmoothedField : public VolumeField
    {
    public:
      Location
      location() const override
      {
        return Location::cells;
      }
      bool
      available(const VolumeState &state) const override
      {
        return state.cell_values;
      }
    };



    class CellStress : public UnsmoothedField
    {
    public:
      unsigned int
      n_components() const override
      {
        return dim * dim;
      }
      unsigned int
      order() const override
      {
        return 103;
      }
      void
      evaluate(const VolumeState &state, std::vector<double> &values) const override
      {
        std::size_t k = 0;
        for (const dealii::SymmetricTensor<2, dim> &stress : state.cell_stress)
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              values[k++] = stress[i][j];
      }
    };



    class CellVonMises : public UnsmoothedField
    {
    public:
      unsigned int
      order() const override
      {
        return 104;
      }
      void
      evaluate(const VolumeState &state, std::vector<double> &values) const override
      {
        for (std::size_t c = 0; c < values.size(); ++c)
          values[c] = von_mises(state.cell_stress[c]);
      }
    };

    const VolumeFieldRegistry::Entry<CellStress>
      cell_stress_field("cell_stress", "Mean Cauchy stress of the cell; force per area.");
    const VolumeFieldRegistry::Entry<CellVonMises>
      cell_von_mises_field("cell_von_mises",
                           "Equivalent stress of the mean stress of the cell; force per area.");
  } // namespace
} // namespace Touchstone

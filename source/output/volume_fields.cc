// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/volume_field.h>
#include <touchstone/output/von_mises.h>
#include <touchstone/solid/solid.h>

/**
 * @file
 * The fields of the VTU output of the bodies, one class for each, registered by name. Stresses are
 * nodal averages that VolumeOutput::node_stress() has made; fields only take their components and
 * invariants.
 */

namespace Touchstone
{
  using dealii::SymmetricTensor;

  namespace
  {
    /** The owned entries of a vector over the dofs, node by node. */
    void
    copy_owned(const Solid &solid, const Vector &field, std::vector<double> &values)
    {
      std::size_t i = 0;
      // Owned indices in ascending order, the order that VolumeField promises.
      for (const Index dof : solid.owned)
        values[i++] = field(dof);
    }



    class DisplacementField : public VolumeField
    {
    public:
      unsigned int
      n_components() const override
      {
        return dim;
      }
      unsigned int
      order() const override
      {
        return 0;
      }
      void
      evaluate(const VolumeState &state, std::vector<double> &values) const override
      {
        copy_owned(state.solid, state.displacement, values);
      }
    };



    class VelocityField : public VolumeField
    {
    public:
      unsigned int
      n_components() const override
      {
        return dim;
      }
      unsigned int
      order() const override
      {
        return 1;
      }
      bool
      available(const VolumeState &state) const override
      {
        return state.velocity != nullptr;
      }
      void
      evaluate(const VolumeState &state, std::vector<double> &values) const override
      {
        copy_owned(state.solid, *state.velocity, values);
      }
    };



    class ReactionField : public VolumeField
    {
    public:
      unsigned int
      n_components() const override
      {
        return dim;
      }
      unsigned int
      order() const override
      {
        return 2;
      }
      bool
      available(const VolumeState &state) const override
      {
        return state.reaction != nullptr;
      }
      void
      evaluate(const VolumeState &state, std::vector<double> &values) const override
      {
        copy_owned(state.solid, *state.reaction, values);
      }
    };



    /** All of the nodal Cauchy stress at once, for filters that take tensors. */
    class StressTensor : public VolumeField
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
        return 9;
      }
      void
      evaluate(const VolumeState &state, std::vector<double> &values) const override
      {
        std::size_t k = 0;
        for (const SymmetricTensor<2, dim> &stress : state.node_stress)
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              values[k++] = stress[i][j];
      }
    };



    /** A scalar function of the nodal Cauchy stress. */
    template <unsigned int number>
    class StressField : public VolumeField
    {
    public:
      unsigned int
      order() const override
      {
        return 10 + number;
      }
      void
      evaluate(const VolumeState &state, std::vector<double> &values) const override
      {
        for (std::size_t k = 0; k < values.size(); ++k)
          values[k] = of(state.node_stress[k]);
      }

    protected:
      virtual double
      of(const SymmetricTensor<2, dim> &stress) const = 0;
    };

    template <unsigned int number, unsigned int i, unsigned int j>
    class StressComponent : public StressField<number>
    {
      double
      of(const SymmetricTensor<2, dim> &stress) const override
      {
        return stress[i][j];
      }
    };

    class VonMisesStress : public StressField<6>
    {
      double
      of(const SymmetricTensor<2, dim> &stress) const override
      {
        return von_mises(stress);
      }
    };

    // Pressure -tr(sigma)/3: positive in compression.
    class HydrostaticPressure : public StressField<7>
    {
      double
      of(const SymmetricTensor<2, dim> &stress) const override
      {
        return -dealii::trace(stress) / 3.;
      }
    };



    template <unsigned int number>
    class CellField : public VolumeField
    {
    public:
      Location
      location() const override
      {
        return Location::cells;
      }
      unsigned int
      order() const override
      {
        return 100 + number;
      }
    };

    class EquivalentPlasticStrain : public CellField<0>
    {
    public:
      bool
      available(const VolumeState &state) const override
      {
        return state.solid.plastic();
      }
      void
      evaluate(const VolumeState &state, std::vector<double> &values) const override
      {
        // Means over the quadrature points of each cell.
        const dealii::Vector<double> strain = state.solid.cell_plastic_strain();
        values.assign(strain.begin(), strain.end());
      }
    };

    class BodyNumber : public CellField<1>
    {
    public:
      void
      evaluate(const VolumeState &state, std::vector<double> &values) const override
      {
        for (const auto &cell : state.solid.dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
            values[cell->active_cell_index()] = cell->material_id();
      }
    };

    // The partition, to judge the balance of load.
    class RankNumber : public CellField<2>
    {
    public:
      void
      evaluate(const VolumeState &state, std::vector<double> &values) const override
      {
        for (const auto &cell : state.solid.dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
            values[cell->active_cell_index()] = cell->subdomain_id();
      }
    };

    const VolumeFieldRegistry::Entry<DisplacementField> displacement_field("displacement",
                                                                           "Displacement; length.");
    const VolumeFieldRegistry::Entry<VelocityField>     velocity_field("velocity",
                                                                   "Velocity; length per time.");
    const VolumeFieldRegistry::Entry<ReactionField>
      reaction_field("reaction", "Forces of the supports at the nodes; force.");
    const VolumeFieldRegistry::Entry<StressTensor> stress_field("stress",
                                                                "Cauchy stress; force per area.");
    const VolumeFieldRegistry::Entry<StressComponent<0, 0, 0>>
      stress_xx_field("stress_xx", "Cauchy stress; force per area.");
    const VolumeFieldRegistry::Entry<StressComponent<1, 1, 1>>
      stress_yy_field("stress_yy", "Cauchy stress; force per area.");
    const VolumeFieldRegistry::Entry<StressComponent<2, 2, 2>>
      stress_zz_field("stress_zz", "Cauchy stress; force per area.");
    const VolumeFieldRegistry::Entry<StressComponent<3, 0, 1>>
      stress_xy_field("stress_xy", "Cauchy stress; force per area.");
    const VolumeFieldRegistry::Entry<StressComponent<4, 1, 2>>
      stress_yz_field("stress_yz", "Cauchy stress; force per area.");
    const VolumeFieldRegistry::Entry<StressComponent<5, 0, 2>>
      stress_xz_field("stress_xz", "Cauchy stress; force per area.");
    const VolumeFieldRegistry::Entry<VonMisesStress>
      von_mises_field("von_mises", "Equivalent stress of von Mises; force per area.");
    const VolumeFieldRegistry::Entry<HydrostaticPressure>
      hydrostatic_field("hydrostatic_pressure", "A third of the trace, negative; force per area.");
    const VolumeFieldRegistry::Entry<EquivalentPlasticStrain>
      plastic_strain_field("equivalent_plastic_strain", "Mean of the cell; no unit.");
    const VolumeFieldRegistry::Entry<BodyNumber> body_field("body", "Number of the body.");
    const VolumeFieldRegistry::Entry<RankNumber> rank_field("rank", "Rank that owns the cell.");
  } // namespace
} // namespace Touchstone

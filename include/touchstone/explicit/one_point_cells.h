// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_one_point_cells_h
#define touchstone_explicit_one_point_cells_h

#include <touchstone/explicit/block_law.h>
#include <touchstone/explicit/cell_forces.h>
#include <touchstone/explicit/cell_states.h>
#include <touchstone/explicit/one_point_block.h>

#include <vector>

namespace Touchstone
{
  /**
   * @brief Hexahedra with one point of integration and control of the four hourglass modes.
   *
   * Total Lagrangian with the means of the gradients over the undeformed cell: patches of constant
   * strain are exact, forces have neither resultant nor moment, and elastic forces an energy. See
   * doc/explicit.md, section 5.
   */
  class OnePointCells : public CellForces
  {
  public:
    OnePointCells(const NodeMap                   &map,
                  const std::vector<unsigned int> &cells,
                  const BodyParameters            &body);

    unsigned int
    subtract_forces(const NodeField     &u,
                    const NodeField     &v,
                    double               step,
                    const BulkViscosity *bulk,
                    NodeField           &force,
                    NodeField           &viscous) override;
    void
    set_volume_rates(const NodeField &u, const NodeField &v, std::vector<double> &result) override;
    void
    add_energies(const NodeField &u, CellEnergies &energies) override;
    void
    square_frequencies(const NodeField &u, std::vector<double> &result) override;
    void
    forget() override
    {
      estimate.assign(estimate.size(), 0.);
    }

    CellStates *
    history() override
    {
      return states.size() > 0 ? &states : nullptr;
    }
    std::vector<double>
    state(unsigned int c) const override;
    void
    set_state(unsigned int c, const std::vector<double> &values) override;

  private:
    BlockLaw               law;
    const bool             finite;
    CellStates             states;
    OnePointBlock::Control control;
    /** The block that was last asked for by cell, and its number. */
    mutable OnePointBlock block;
    mutable unsigned int  present = dealii::numbers::invalid_unsigned_int;
    /** See KernelCells. At small strain frequencies do not change: there is no estimate. */
    std::vector<double> exact, estimate;

    const OnePointBlock &
    block_of(unsigned int c) const;
    /** Stiffness of hourglass mode @p m along edge @p i of cell @p c, force per length. */
    double
    stiffness(unsigned int c, unsigned int m, unsigned int i) const;
    dealii::Tensor<2, dim>
    displacement_gradient(unsigned int c, const NodeField &u) const;
    /** Largest squared frequency of what hourglass control adds, and the largest squared cosine of
     * the angle between its motions and those of constant strain. */
    std::pair<double, double>
    hourglass_frequency(unsigned int c, const NodalMasses &masses) const;
    double
    hourglass_energy(unsigned int c, const NodeField &u, const dealii::Tensor<2, dim> &H) const;
    /** An upper bound of the largest squared frequency of all that a cell resists. */
    double
    coupled_frequency(unsigned int c, const NodeField &u, const NodalMasses &masses) const;
  };
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_one_point_cells_h
#define touchstone_explicit_one_point_cells_h

#include <touchstone/explicit/block_law.h>
#include <touchstone/explicit/cell_forces.h>
#include <touchstone/explicit/cell_states.h>

#include <vector>

namespace Touchstone
{
  /** @brief Eight one-point cells, of which everything is computed at once. */
  struct OnePointBlock
  {
    static constexpr unsigned int n_cells = n_lanes, n_nodes = NodeMap::nodes_per_cell, n_modes = 4;

    /** Local nodes of each cell. */
    unsigned int nodes[n_cells][n_nodes];
    /** Means of the gradients of the shapes over the undeformed cell, [3a+i]. */
    double gradients[dim * n_nodes][n_cells];
    /** Hourglass vectors times positions, [3m+i]. */
    double warp[dim * n_modes][n_cells];
    double volume[n_cells];
    /** Unit vectors along the edges of the undeformed cell, [3i+j]. */
    double edges[dim * dim][n_cells];
    /** Stiffness of the control of hourglass modes, force per length: of bending along each edge,
     * and of warping; or the viscosity of each mode, if the control is viscous. */
    double control[n_modes][n_cells];

    /** @brief Whether mode @p m along edge @p i is a warping, across both of its own edges. */
    static constexpr bool
    warps(const unsigned int m, const unsigned int i)
    {
      return m < dim && i == (m + 2) % dim;
    }
    /** @brief The stiffness of bending of mode @p m relative to that in #control. */
    static constexpr double
    part(const unsigned int m)
    {
      return m < dim ? 1. : 1. / 3.;
    }
  };

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
    add_energies(const NodeField &u, CellEnergies &energies) override;
    void
    square_frequencies(const NodeField                &u,
                       const std::vector<NodalMasses> &masses,
                       std::vector<double>            &result) override;
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
    BlockLaw                   law;
    const bool                 finite;
    CellStates                 states;
    std::vector<OnePointBlock> blocks;
    /** See KernelCells. */
    std::vector<double> exact, estimate;
    /** Gradients of the displacement of a block, and stresses. */
    double gradient[dim * dim][OnePointBlock::n_cells], stress[dim * dim][OnePointBlock::n_cells];

    void
    set_block(OnePointBlock &block, unsigned int first);
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

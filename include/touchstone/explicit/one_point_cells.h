// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_one_point_cells_h
#define touchstone_explicit_one_point_cells_h

#include <touchstone/base/vectorised.h>
#include <touchstone/explicit/cell_forces.h>
#include <touchstone/solid/material_law.h>

#include <memory>
#include <vector>

namespace Touchstone
{
  /** @brief Eight one-point cells, of which everything is computed at once. */
  struct OnePointBlock
  {
    static constexpr unsigned int n_cells = 8, n_nodes = NodeMap::nodes_per_cell, n_modes = 4;
    using Lanes = Simd<double, n_cells>::type;

    /** Local nodes of each cell. */
    unsigned int nodes[n_cells][n_nodes];
    /** Means of the gradients of the shapes over the undeformed cell, [3a+i]. */
    double gradients[dim * n_nodes][n_cells];
    /** Hourglass vectors times positions, [3m+i]. */
    double warp[dim * n_modes][n_cells];
    double volume[n_cells];
    /** Unit vectors along the edges of the undeformed cell, [3i+j], and the stiffness of each
     * hourglass mode in these directions, [3m+i], force per length. */
    double edges[dim * dim][n_cells], stiffness[dim * n_modes][n_cells];
    /** Viscosity of each hourglass mode. */
    double viscosity[n_modes][n_cells];
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
    subtract_forces(const NodeField &u,
                    const NodeField &v,
                    double           step,
                    NodeField       &force,
                    NodeField       &viscous) override;
    void
    add_viscosity(const NodeField           &u,
                  const NodeField           &v,
                  const Viscosity           &coefficients,
                  const std::vector<double> &squares,
                  NodeField                 &viscous) override;
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

    bool
    has_history() const override
    {
      return n_state > 0;
    }
    std::vector<double>
    state(unsigned int c) const override;
    void
    set_state(unsigned int c, const std::vector<double> &values) override;
    void
    commit() override
    {
      kept = present;
    }
    void
    rollback() override
    {
      present = kept;
    }

  private:
    /** How stresses are computed: by formulas for eight cells at once, or by the law of the
     * material for one after the other. */
    enum class Formulas
    {
      linear_elastic,
      neo_hookean,
      von_mises,
      any_law
    };

    std::shared_ptr<const MaterialLaw> law;
    Formulas                           formulas;
    bool                               finite;
    unsigned int                       n_state = 0;
    /** History of a cell at both ends of a cycle. */
    std::vector<double>        state_before, state_after;
    std::vector<OnePointBlock> blocks;
    /** Histories, [block][variable][cell of the block]. */
    std::vector<double> present, kept;
    /** See KernelCells. */
    std::vector<double> exact, estimate;
    /** Gradients of the displacement of a block, and stresses. */
    double gradient[dim * dim][OnePointBlock::n_cells], stress[dim * dim][OnePointBlock::n_cells];

    void
    set_block(OnePointBlock &block, unsigned int first);
    /** Subtract the forces of a block, [3a+i], from those of its nodes. */
    void
    scatter(unsigned int b, const double (*forces)[OnePointBlock::n_cells], NodeField &sum) const;
    /** Stresses of the cells of block @p b by the law, or of those that are marked. @return the
     * first cell that fails. */
    unsigned int
    respond(unsigned int b, double step, const double *marked = nullptr);
    /** History variable @p k of cell @p c. */
    double &
    variable(const unsigned int c, const unsigned int k)
    {
      return present[(c / OnePointBlock::n_cells * n_state + k) * OnePointBlock::n_cells +
                     c % OnePointBlock::n_cells];
    }
    void
    get_state(const std::vector<double> &states, unsigned int c, double *values) const;
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

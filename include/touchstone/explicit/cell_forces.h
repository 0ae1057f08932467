// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_cell_forces_h
#define touchstone_explicit_cell_forces_h

#include <touchstone/base/exact_sum.h>
#include <touchstone/explicit/cell_states.h>
#include <touchstone/explicit/node_map.h>
#include <touchstone/explicit/one_point_block.h>
#include <touchstone/explicit/viscosity.h>
#include <touchstone/solid/body_parameters.h>

#include <array>
#include <memory>
#include <vector>

namespace Touchstone
{
  /** @brief Energies of the cells of a body that a rank owns, force times length. */
  struct CellEnergies
  {
    /** Elastic; dissipated by the material; stored in or dissipated by the control of hourglass
     * modes. */
    ExactSum strain, plastic, hourglass;
  };

  /**
   * @brief Internal forces of the cells of one body in explicit dynamics, and their history.
   *
   * A derived class is one way to integrate a cell. Forces are added cell by cell in the order of
   * the keys of NodeMap.
   */
  class CellForces
  {
  public:
    /** Mass that a cell gives to each of its nodes. */
    using NodalMasses = std::array<double, NodeMap::nodes_per_cell>;

    /** @brief Masses that cell number @p c of this body gives to its nodes, without scaling: the
     * density times int N_a dV. They are computed anew from the positions, which
     * takes little time and no memory. */
    NodalMasses
    masses(unsigned int c) const;

    /** @brief Add the masses of all cells to those of the local nodes, scaled by these factors, or
     * not if there are none. */
    void
    add_masses(const std::vector<double> &factors, std::vector<double> &nodal_mass) const;

    /** @param cells Numbers of the body's cells in NodeMap::cells(). */
    CellForces(const NodeMap                   &map,
               const std::vector<unsigned int> &cells,
               const BodyParameters            &body)
      : map(map)
      , cells(cells)
      , body(body)
    {
    }
    virtual ~CellForces() = default;

    /** @brief The time of the forces that follow, for materials that depend on it. */
    virtual void
    set_time(double /*time*/)
    {
    }

    /** @brief What suits the body. */
    static std::unique_ptr<CellForces>
    make(const NodeMap &map, const std::vector<unsigned int> &cells, const BodyParameters &body);

    /** @brief Bulk viscosity of the body in a cycle. */
    struct BulkViscosity
    {
      Viscosity viscosity;
      /** By cell, see Viscosity. */
      const std::vector<double> &periods;
    };

    /**
     * @brief Subtract the internal forces from @p force, and let the history of the material go on
     * to the displacement @p u.
     * @param v    Velocity, for the viscous control of hourglass modes and bulk viscosity.
     * @param step Time since the last call, for materials that depend on it; 0 if none.
     * @param bulk Null: no bulk viscosity.
     * @param viscous From which the forces of both are subtracted.
     * @return the place in cells of the first cell that cannot go on, as it is inverted or its law
     * has no answer; invalid_unsigned_int if there is none.
     */
    virtual unsigned int
    subtract_forces(const NodeField     &u,
                    const NodeField     &v,
                    double               step,
                    const BulkViscosity *bulk,
                    NodeField           &force,
                    NodeField           &viscous) = 0;

    /** @brief Rates of the volumes of all cells, relative to them, as bulk viscosity sees them. */
    virtual void
    set_volume_rates(const NodeField &u, const NodeField &v, std::vector<double> &result);

    /** @brief Largest square of the rate of the edges of each cell, relative to them. */
    void
    set_edge_rates(const NodeField &u, const NodeField &v, std::vector<double> &result) const;

    /** @brief Add the energies of owned cells at the displacement of the last subtract_forces(). */
    virtual void
    add_energies(const NodeField &u, CellEnergies &energies) = 0;

    /** @brief An upper bound of the squared largest frequency of each cell by itself in the
     * displacement @p u, at most two per cent above the exact one. */
    virtual void
    square_frequencies(const NodeField &u, std::vector<double> &result) = 0;

    /** @brief Drop frequencies that are kept from earlier cycles. */
    virtual void
    forget()
    {
    }

    /** @name History */
    /** @{ */
    /** @brief Null if there is none. */
    virtual CellStates *
    history()
    {
      return nullptr;
    }

    /** @brief Committed state of cell number @p c of this body in the form of Solid::cell_state().
     */
    virtual std::vector<double>
    state(unsigned int /*c*/) const
    {
      return {};
    }

    /** @brief Set the present and the committed state. */
    virtual void
    set_state(unsigned int /*c*/, const std::vector<double> & /*values*/)
    {
    }
    /** @} */

    const std::vector<unsigned int> &
    cell_numbers() const
    {
      return cells;
    }

  protected:
    const NodeMap                  &map;
    const std::vector<unsigned int> cells;
    const BodyParameters           &body;

    /** The nodes of eight cells from this one on; of the last cell where there are fewer.
     * @param space For those that do not stand so in memory. */
    const BlockNodes &
    block_nodes(unsigned int first, BlockNodes &space) const;

    /** Frequencies of the cells as if they had one point, see one_point_frequency(). */
    void
    set_one_point_frequencies(const NodeField &u, std::vector<double> &result) const;

    /** Subtract the forces of bulk viscosity, if there is any: its pressure times the rate of the
     * volume. */
    void
    subtract_viscosity(const NodeField     &u,
                       const NodeField     &v,
                       const BulkViscosity *bulk,
                       NodeField           &viscous) const;

    const NodeMap::Cell &
    cell(const unsigned int c) const
    {
      return map.cells()[cells[c]];
    }

    const NodeMap::CellNodes &
    nodes(const unsigned int c) const
    {
      return map.nodes(cells[c]);
    }

    /** Masses that a block of cells gives to its nodes, [a]. */
    void
    set_masses(const BlockNodes &nodes, double (*masses)[n_lanes]) const;

    /** Tensors of a field stand one after the other. */
    static const double *
    numbers_of(const NodeField &field)
    {
      return reinterpret_cast<const double *>(field.data());
    }

    /** Subtract the forces of the first @p n_used cells of a block, [3a+i], from those of its
     * nodes. */
    static void
    scatter(const unsigned int (*nodes)[NodeMap::nodes_per_cell],
            const unsigned int n_used,
            const double (*forces)[n_lanes],
            NodeField &sum)
    {
      for (unsigned int lane = 0; lane < n_used; ++lane)
        for (unsigned int a = 0; a < NodeMap::nodes_per_cell; ++a)
          for (unsigned int i = 0; i < dim; ++i)
            sum[nodes[lane][a]][i] -= forces[dim * a + i][lane];
    }

    /** Subtract the forces of a cell, 3a+i, from those of its nodes. */
    template <class Forces>
    static void
    subtract(const NodeMap::CellNodes &nodes, const Forces &forces, NodeField &force)
    {
      for (unsigned int a = 0; a < NodeMap::nodes_per_cell; ++a)
        for (unsigned int d = 0; d < dim; ++d)
          force[nodes[a]][d] -= forces[dim * a + d];
    }
  };
} // namespace Touchstone

#endif

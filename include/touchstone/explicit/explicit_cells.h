// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_explicit_cells_h
#define touchstone_explicit_explicit_cells_h

#include <touchstone/explicit/cell_forces.h>
#include <touchstone/explicit/explicit_parameters.h>
#include <touchstone/solid/cell_history.h>

#include <deal.II/base/point.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief A cell as messages name it, the same on all ranks. */
  struct CellPlace
  {
    /** Of NodeMap; the highest number: no cell. */
    std::uint64_t key  = static_cast<std::uint64_t>(-1);
    unsigned int  body = 0;
    /** Reference position of its centre, length. */
    double position[dim] = {};

    bool
    valid() const
    {
      return key != static_cast<std::uint64_t>(-1);
    }

    /** @brief "body 'NAME' at (x, y, z)". */
    std::string
    text(const std::vector<BodyParameters> &bodies) const;
  };

  /** @brief The longest stable step and the cell that decides it. */
  struct StableStep
  {
    double    length = 0.;
    CellPlace cell;
    /** For so long no cell needs a much shorter one, if velocities stay as they are; time. */
    double holds = 0.;
  };

  /**
   * @brief All cells of an explicit run: masses, forces, energies and the stable step.
   *
   * Forces at owned nodes are complete without communication, and have the same bits on any number
   * of ranks (doc/explicit.md, section 2).
   */
  class ExplicitCells : public CellHistory
  {
  public:
    ExplicitCells(const NodeMap                     &map,
                  const std::vector<BodyParameters> &bodies,
                  const ExplicitParameters          &parameters);

    /** @brief Lumped masses of the local nodes, with what mass scaling has added. */
    const std::vector<double> &
    masses() const
    {
      return nodal_mass;
    }

    /**
     * @brief Set the forces of stress on the nodes (as they act on these), and those of bulk
     * viscosity; the history of materials goes on to @p u.
     * @param time The present one. @param step Time since the last call.
     * @return the first cell that is inverted or whose law fails, of this rank.
     */
    CellPlace
    evaluate(const NodeField &u,
             const NodeField &v,
             double           time,
             double           step,
             NodeField       &force,
             NodeField       &viscous);

    /** @brief Compute the stable step in the displacement @p u. @p v as for evaluate().
     * Collective. */
    StableStep
    stable_step(const NodeField &u, const NodeField &v);

    /** @brief Give mass to cells that need a shorter cycle than the parameters want, before the
     * first step. @return the mass of all bodies and what was added. Collective.
     * @throws InputError if that is too much. */
    std::pair<double, double>
    scale_masses(const NodeField &u);

    /** @brief Energies at the displacement of the last evaluate(), summed over the ranks.
     * Collective. */
    struct Energies
    {
      double strain, plastic, hourglass;
    };
    Energies
    energies(const NodeField &u);

    /** @name History, see CellForces */
    /** @{ */
    void
    commit();
    void
    rollback();
    /** @brief Drop what only saves time. */
    void
    forget();
    std::vector<double>
    committed_state(unsigned int cell) const override;
    void
    set_state(unsigned int cell, const std::vector<double> &values) override;
    /** @} */

    /** @brief Of the ranks the first cell by key. Collective. */
    CellPlace
    first(const CellPlace &mine) const;

  private:
    const NodeMap                           &map;
    const std::vector<BodyParameters>       &bodies;
    const ExplicitParameters                &parameters;
    std::vector<std::unique_ptr<CellForces>> of_bodies;
    /** By body and cell: the factor of mass scaling, none if there is none, and the period with
     * it, see Viscosity. */
    std::vector<std::vector<double>> factors, periods;
    std::vector<double>              nodal_mass;
    /** Number in its body of each active cell of the triangulation that has history, and the
     * body; -1 for the others. */
    std::vector<std::pair<int, unsigned int>> place_of;

    void
    sum_masses();
    void
    update_periods(const NodeField &u);
    CellPlace
    place(unsigned int body, unsigned int c) const;
    double
    time_to_shorten(double step, const NodeField &u, const NodeField &v) const;
    /** Of the cells of a body. */
    std::vector<double>
    steps_of(unsigned int body, const NodeField &u, const NodeField &v) const;
  };
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_cell_forces_h
#define touchstone_explicit_cell_forces_h

#include <touchstone/base/exact_sum.h>
#include <touchstone/explicit/node_map.h>
#include <touchstone/solid/body_parameters.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

    /** @brief What suits the body. */
    static std::unique_ptr<CellForces>
    make(const NodeMap &map, const std::vector<unsigned int> &cells, const BodyParameters &body);

    /**
     * @brief Subtract the internal forces from @p force, and let the history of the material go on
     * to the displacement @p u.
     * @param v    Velocity, for the viscous control of hourglass modes.
     * @param viscous From which the forces of viscous control are subtracted.
     * @param step Time since the last call, for materials that depend on it; 0 if none.
     * @return the place in cells of the first cell that cannot go on, as it is inverted or its law
     * has no answer; invalid_unsigned_int if there is none.
     */
    virtual unsigned int
    subtract_forces(const NodeField &u,
                    const NodeField &v,
                    double           step,
                    NodeField       &force,
                    NodeField       &viscous) = 0;

    /** @brief Coefficients of the bulk viscosity of a body, see add_viscosity(). */
    struct Viscosity
    {
      /** 2 kappa b_1 / omega times the frequency: force per area. */
      double linear;
      /** (2 kappa b_2 / omega)^2 / (kappa + 4/3 mu), times the squared frequency: force per area.
       */
      double quadratic;
      /** 2 kappa, force per area, and the length of a cycle: time. */
      double modulus, step;

      /** The largest viscosity of a cell of squared frequency @p square with which cycles of this
       * length are stable: h = 2/omega (sqrt(1 + xi^2) - xi), solved for xi. */
      double
      largest(const double square) const
      {
        if (step == 0.)
          return std::numeric_limits<double>::max();
        const double turn = step * std::sqrt(square);
        return modulus / std::sqrt(square) * std::max(0., (1. - 0.25 * turn * turn) / turn);
      }
    };

    /**
     * @brief Add the forces of bulk viscosity to @p viscous: the pressure -(linear / omega -
     * quadratic / omega^2 min(0, r)) r at the rate r of the volume, but no more than is stable: the
     * cycle was chosen before an impact came (doc/explicit.md, section 4).
     * @param squares Of the frequencies omega, by cell.
     */
    virtual void
    add_viscosity(const NodeField           &u,
                  const NodeField           &v,
                  const Viscosity           &coefficients,
                  const std::vector<double> &squares,
                  NodeField                 &viscous);

    /** @brief Rate of the volume of a cell, relative to it, and the derivative of the volume by the
     * positions of the nodes. */
    double
    volume_rate(unsigned int                           c,
                const NodeField                       &u,
                const NodeField                       &v,
                std::array<dealii::Tensor<1, dim>, 8> &derivative) const;

    /** @brief Add the energies of owned cells at the displacement of the last subtract_forces(). */
    virtual void
    add_energies(const NodeField &u, CellEnergies &energies) = 0;

    /**
     * @brief An upper bound of the squared largest frequency of each cell by itself in the
     * displacement @p u, at most two per cent above the exact one.
     * @param masses Of the nodes of each cell.
     */
    virtual void
    square_frequencies(const NodeField                &u,
                       const std::vector<NodalMasses> &masses,
                       std::vector<double>            &result) = 0;

    /** @brief Drop frequencies that are kept from earlier cycles. */
    virtual void
    forget()
    {
    }

    /** @name History */
    /** @{ */
    /** @brief Whether there is any. */
    virtual bool
    has_history() const
    {
      return false;
    }

    /** @brief Committed state of cell number @p c of this body in the form of Solid::cell_state().
     */
    virtual std::vector<double>
    state(unsigned int /*c*/) const
    {
      return {};
    }

    virtual void
    set_state(unsigned int /*c*/, const std::vector<double> & /*values*/)
    {
    }

    /** @brief Keep the present state for rollback(), and return to the one that was kept. */
    virtual void
    commit()
    {
    }
    virtual void
    rollback()
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

    const NodeMap::Cell &
    cell(const unsigned int c) const
    {
      return map.cells()[cells[c]];
    }

    /** Subtract the forces of a cell, 3a+i. */
    template <class Forces>
    static void
    subtract(const NodeMap::Cell &one, const Forces &forces, NodeField &force)
    {
      for (unsigned int a = 0; a < NodeMap::nodes_per_cell; ++a)
        for (unsigned int d = 0; d < dim; ++d)
          force[one.nodes[a]][d] -= forces[dim * a + d];
    }
  };
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_kernel_cells_h
#define touchstone_explicit_kernel_cells_h

#include <touchstone/explicit/cell_forces.h>
#include <touchstone/explicit/cell_stiffness.h>
#include <touchstone/solid/cell_kernel.h>

#include <algorithm>

namespace Touchstone
{
  /** @brief Cells of a nonlinear material by the CellKernel of implicit runs: the same forces. */
  class KernelCells : public CellForces
  {
  public:
    KernelCells(const NodeMap                   &map,
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
    square_frequencies(const NodeField &u, std::vector<double> &result) override;

    void
    set_time(const double time) override
    {
      kernel->set_time(time);
    }

    void
    forget() override
    {
      std::fill(estimate.begin(), estimate.end(), 0.);
    }

    CellStates *
    history() override
    {
      return states.size() > 0 ? &states : nullptr;
    }
    std::vector<double>
    state(const unsigned int c) const override
    {
      return states.committed_state(c);
    }
    void
    set_state(const unsigned int c, const std::vector<double> &values) override
    {
      states.set(c, values);
    }

  private:
    std::unique_ptr<CellKernel> kernel;

  protected:
    CellStates states;
    /** By cell: the smallest ratio of a present to a reference volume in a point, when forces were
     * evaluated last, at finite strain. */
    std::vector<double> smallest_ratio;

  private:
    /** Of the isotropic elasticity at small strain. */
    CellStiffness elastic;
    /** History of a cell. */
    std::vector<double> before;
    /** By cell: the frequency that was computed last, the estimate beside it, and the
     * #smallest_ratio of then. */
    std::vector<double> exact, estimate, ratio_then;

    /** @return the smallest determinant. */
    double
    go_to(unsigned int c, const NodeField &u);
  };
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_state_transfer_h
#define touchstone_solid_state_transfer_h

#include <touchstone/solid/solid.h>

#include <deal.II/distributed/cell_data_transfer.h>
#include <deal.II/distributed/tria.h>

#include <memory>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Carries the history of the material over a change of the mesh.
   *
   * The points of a child take the state of the nearest quadrature point of the parent.
   * Where children are merged a point takes the volume average of the child that it lies
   * in, or of those on whose border it lies, which the law then makes admissible
   * (MaterialLaw::restore()). So a state that is the same everywhere stays what it is.
   */
  class StateTransfer
  {
  public:
    /** @brief To be made when the cells are marked, before the mesh changes. Does nothing
     * for bodies without history. */
    StateTransfer(dealii::parallel::TriangulationBase<dim> &triangulation, Solid &solid);

    /** @brief The mesh has changed and the solid begun anew (Solid::reinit()): give it the
     * states. Collective. */
    void
    finish();

  private:
    using State  = std::vector<double>;
    using States = std::vector<State>;
    using Cell   = dealii::Triangulation<dim>::cell_iterator;

    Solid &solid;
    /** By active cell. */
    States states;
    /** By body, as the solid itself is made anew; null without history. */
    std::vector<std::shared_ptr<const MaterialLaw>> laws;
    /** Nearest quadrature point of the parent, by child and its point. */
    std::vector<std::vector<unsigned int>> nearest;
    /** Children that a quadrature point of the parent belongs to. */
    std::vector<std::vector<unsigned int>>                                             containing;
    std::vector<double>                                                                weights;
    std::unique_ptr<dealii::parallel::distributed::CellDataTransfer<dim, dim, States>> transfer;

    States
    refine(const State &parent) const;
    State
    coarsen(const Cell &parent, const States &children) const;
  };
} // namespace Touchstone

#endif

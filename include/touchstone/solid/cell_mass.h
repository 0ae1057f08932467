// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_cell_mass_h
#define touchstone_solid_cell_mass_h

#include <touchstone/algebra/vector.h>
#include <touchstone/solid/mass.h>
#include <touchstone/solid/solid.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace Touchstone
{
  /** @brief The mass matrix of one component in a cell. */
  class CellMass
  {
  public:
    /** @param no_mass Positive at the first unknown of massless nodes; with ghosts. */
    CellMass(MassKind kind, const Solid &solid, const Vector &no_mass, double step);

    /** First unknowns of the nodes. */
    std::vector<Index> nodes;
    /** As it is, and with the mass of massless nodes at the others. */
    dealii::FullMatrix<double> complete, moved;

    /** @brief Integrate the masses of a cell. */
    void
    reinit(const dealii::DoFHandler<dim>::active_cell_iterator &cell);

  private:
    const MassKind          kind;
    const Solid            &solid;
    const Vector           &no_mass;
    const double            step;
    const dealii::FE_Q<dim> scalar_fe;
    dealii::FEValues<dim>   values;
    std::vector<double>     lumped;
    std::vector<Index>      dofs;

    /** Move the mass of massless nodes to the other nodes of the cell. */
    void
    move();
  };
} // namespace Touchstone

#endif

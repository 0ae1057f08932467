// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_linear_cells_h
#define touchstone_solid_linear_cells_h

#include <touchstone/algebra/matrix.h>
#include <touchstone/solid/element_kernel.h>

#include <vector>

namespace Touchstone
{
  /** @brief Assembles cells of a linear elastic body, eight at a time. */
  class LinearCells
  {
  public:
    LinearCells(const dealii::Mapping<dim>       &mapping,
                const dealii::FiniteElement<dim> &fe,
                const BodyParameters             &body)
      : kernel(mapping, fe, body.element(), body.material)
      , stiffness(kernel.stiffness_of_cells())
      , dofs(fe.n_dofs_per_cell())
    {
    }

    /** @brief Add a cell to the batch, if it has rows of this rank; matrices are computed and added
     * for eight cells at once. */
    void
    add(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell, Matrix &matrix);

    /** @brief Add the cells of an incomplete batch. */
    void
    finish(Matrix &matrix);

  private:
    ElementKernel       kernel;
    ElementStiffness<8> stiffness;
    unsigned int        n_waiting = 0;
    std::vector<Index>  dofs;
    /** Rows and nodes of the cells in the batch, as Matrix::add() expects them. */
    std::vector<int>          rows;
    std::vector<unsigned int> nodes;
  };
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_node_numbers_h
#define touchstone_output_node_numbers_h

#include <touchstone/solid/solid.h>

#include <deal.II/base/partitioner.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <memory>
#include <vector>

namespace Touchstone
{
  /**
   * @brief The nodes that a rank knows, those that it owns first, in the order of their numbers,
   * and scalar fields over them.
   */
  class NodeNumbers
  {
  public:
    using Field = dealii::LinearAlgebra::distributed::Vector<double>;
    using Cell  = dealii::DoFHandler<dim>::active_cell_iterator;

    /** @brief Collective. @param solid Must outlive this object. */
    explicit NodeNumbers(const Solid &solid);

    /** @brief Zero at the owned nodes and those of ghost cells. */
    Field
    zero_field() const
    {
      return Field(partitioner);
    }

    std::size_t
    n_owned() const
    {
      return partitioner->locally_owned_size();
    }

    /** @brief Owned nodes and those of ghost cells. */
    std::size_t
    n_known() const
    {
      return n_owned() + partitioner->n_ghost_indices();
    }

    /** @brief Local numbers of the nodes of a cell that is not artificial, x fastest. */
    void
    of_cell(const Cell &cell, std::vector<unsigned int> &nodes) const;

  private:
    /** Of the nodes of a cell, x fastest: the first of their dofs in the numbering of the cell. */
    std::vector<unsigned int>                                  first_dof;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
    /** Scratch space of of_cell(). */
    mutable std::vector<Index> dofs;
  };
} // namespace Touchstone

#endif

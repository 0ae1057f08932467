// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_vertex_values_h
#define touchstone_solid_vertex_values_h

#include <touchstone/base/types.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/la_parallel_vector.h>

namespace Touchstone
{
  /** @brief A number of values for each vertex, with ghosts. */
  class VertexValues
  {
  public:
    /** @brief Zeros. @param vertices One number for each vertex. */
    VertexValues(const dealii::DoFHandler<dim> &vertices,
                 const dealii::IndexSet        &relevant,
                 const unsigned int             n)
      : n(n)
      , all(several(vertices.locally_owned_dofs()), several(relevant), vertices.get_communicator())
    {
    }

    /** @brief Value @p k of a vertex. */
    double &
    operator()(const Index vertex, const unsigned int k)
    {
      return all(vertex * n + k);
    }
    double
    operator()(const Index vertex, const unsigned int k) const
    {
      return all(vertex * n + k);
    }

    /** @brief Sum what ranks have added. Collective. */
    void
    add_up()
    {
      all.compress(dealii::VectorOperation::add);
    }

    /** @brief Update the ghosts. Collective. */
    void
    share()
    {
      all.update_ghost_values();
    }

  private:
    const unsigned int                                 n;
    dealii::LinearAlgebra::distributed::Vector<double> all;

    dealii::IndexSet
    several(const dealii::IndexSet &set) const
    {
      dealii::IndexSet result(set.size() * n);
      for (auto interval = set.begin_intervals(); interval != set.end_intervals(); ++interval)
        result.add_range(*interval->begin() * n, (interval->last() + 1) * n);
      result.compress();
      return result;
    }
  };
} // namespace Touchstone

#endif

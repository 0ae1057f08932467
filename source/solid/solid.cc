#include <touchstone/solid/element_kernel.h>
#include <touchstone/solid/solid.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <Epetra_CrsMatrix.h>
#include <algorithm>
#include <cmath>
#include <limits>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The stiffness rows of this rank as plain arrays, written to node by node:
     * the three rows of a node have the same columns. */
    class RowWriter
    {
    public:
      explicit RowWriter(Matrix &matrix)
        : matrix(const_cast<Epetra_CrsMatrix &>(matrix.trilinos_matrix()))
      {
        this->matrix.OptimizeStorage();
        const int error = this->matrix.ExtractCrsDataPointers(begin, columns, values);
        AssertThrow(error == 0, ExcMessage("The stiffness matrix is not in compressed storage."));
      }

      /** Local row of a global unknown, or -1 if another rank owns it. */
      int
      row(const Index global) const
      {
        return matrix.RowMap().LID(static_cast<int>(global));
      }

      int
      column(const Index global) const
      {
        return matrix.ColMap().LID(static_cast<int>(global));
      }

      /** Position, within each of the rows of a node, of a column. */
      int
      position(const int row, const int column) const
      {
        const int *first = columns + begin[row];
        const int *last  = columns + begin[row + 1];
        return std::lower_bound(first, last, column) - first;
      }

      double *
      entry(const int row, const int position)
      {
        return values + begin[row] + position;
      }

      std::vector<double>
      absolute_row_sums() const
      {
        std::vector<double> sums(matrix.NumMyRows(), 0.);
        for (int i = 0; i < matrix.NumMyRows(); ++i)
          for (int k = begin[i]; k < begin[i + 1]; ++k)
            sums[i] += std::abs(values[k]);
        return sums;
      }

    private:
      Epetra_CrsMatrix &matrix;
      int              *begin = nullptr, *columns = nullptr;
      double           *values = nullptr;
    };
  } // namespace



  Solid::Solid(const Scene &scene, const Forest &forest, const MPI_Comm communicator)
    : fe(FE_Q<dim>(scene.discretisation.degree), dim)
    , mapping(scene.discretisation.degree)
    , dof_handler(forest.triangulation)
    , communicator(communicator)
    , scene(scene)
  {
    dof_handler.distribute_dofs(fe);
    owned = dof_handler.locally_owned_dofs();
    DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);

    // Contact counts nodes, not unknowns: three consecutive unknowns are a node.
    std::vector<Index> dofs(fe.n_dofs_per_cell());
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cell->get_dof_indices(dofs);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            AssertThrow(dofs[i] % dim == fe.system_to_component_index(i).first,
                        ExcMessage("The unknowns are not numbered by nodes."));
        }

    // Rows are built from owned and ghost cells, so no rank waits for another.
    DynamicSparsityPattern pattern(dof_handler.n_dofs(), dof_handler.n_dofs(), owned);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        {
          cell->get_dof_indices(dofs);
          std::sort(dofs.begin(), dofs.end());
          for (const Index row : dofs)
            if (owned.is_element(row))
              pattern.add_entries(row, dofs.begin(), dofs.end(), true);
        }
    matrix.reinit(owned, owned, pattern, communicator);
  }



  void
  Solid::assemble()
  {
    matrix = 0.;
    RowWriter                                   writer(matrix);
    std::vector<std::unique_ptr<ElementKernel>> kernels;
    for (const BodyParameters &body : scene.bodies)
      kernels.push_back(
        std::make_unique<ElementKernel>(mapping, fe, body.element(), body.material));

    std::vector<Index> dofs(fe.n_dofs_per_cell());
    std::vector<int>   rows, columns;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        {
          ElementKernel     &kernel = *kernels[cell->material_id()];
          const unsigned int n      = kernel.nodes_per_cell();
          cell->get_dof_indices(dofs);
          rows.assign(n, -1);
          columns.assign(n, -1);
          bool any = false;
          for (unsigned int a = 0; a < n; ++a)
            {
              rows[a]    = writer.row(dofs[kernel.local_dof(a, 0)]);
              columns[a] = writer.column(dofs[kernel.local_dof(a, 0)]);
              any        = any || rows[a] >= 0;
            }
          if (!any)
            continue;
          kernel.reinit(cell);
          const FullMatrix<double> &k = kernel.stiffness();
          for (unsigned int a = 0; a < n; ++a)
            if (rows[a] >= 0)
              for (unsigned int b = 0; b < n; ++b)
                {
                  const int position = writer.position(rows[a], columns[b]);
                  for (unsigned int i = 0; i < dim; ++i)
                    {
                      double *entry = writer.entry(rows[a] + i, position);
                      for (unsigned int j = 0; j < dim; ++j)
                        entry[j] += k(dim * a + i, dim * b + j);
                    }
                }
        }
    row_sums = writer.absolute_row_sums();
  }



  void
  Solid::internal_force(const Vector &u, Vector &force) const
  {
    matrix.vmult(force, u);
  }



  double
  Solid::round_off(const Vector &u) const
  {
    double sum = 0.;
    for (std::size_t i = 0; i < row_sums.size(); ++i)
      sum += std::pow(row_sums[i] * u.begin()[i], 2);
    return std::numeric_limits<double>::epsilon() *
           std::sqrt(Utilities::MPI::sum(sum, communicator));
  }



  void
  Solid::for_each_stress(
    const Vector &u,
    const std::function<
      void(unsigned int, const Point<dim> &, const SymmetricTensor<2, dim> &, double)> &visit) const
  {
    std::vector<std::unique_ptr<ElementKernel>> kernels;
    for (const BodyParameters &body : scene.bodies)
      kernels.push_back(
        std::make_unique<ElementKernel>(mapping, fe, body.element(), body.material));
    std::vector<Index>  dofs(fe.n_dofs_per_cell());
    std::vector<double> values(fe.n_dofs_per_cell());
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          ElementKernel &kernel = *kernels[cell->material_id()];
          cell->get_dof_indices(dofs);
          for (unsigned int a = 0; a < kernel.nodes_per_cell(); ++a)
            for (unsigned int d = 0; d < dim; ++d)
              values[dim * a + d] = u(dofs[kernel.local_dof(a, d)]);
          kernel.reinit(cell);
          kernel.set_displacement(values);
          for (unsigned int q = 0; q < kernel.n_quadrature_points(); ++q)
            visit(cell->material_id(), kernel.point(q), kernel.stress(q), kernel.volume(q));
        }
  }



  std::vector<SymmetricTensor<2, dim>>
  Solid::cell_stress(const Vector &u) const
  {
    std::vector<SymmetricTensor<2, dim>> result;
    std::vector<unsigned int>            cells;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        cells.push_back(cell->active_cell_index());
    result.resize(dof_handler.get_triangulation().n_active_cells());
    const unsigned int n_points = Utilities::pow(fe.degree + 1, dim);
    unsigned int       counter  = 0;
    for_each_stress(u,
                    [&](const unsigned int,
                        const Point<dim> &,
                        const SymmetricTensor<2, dim> &stress,
                        const double) {
                      result[cells[counter++ / n_points]] += stress / n_points;
                    });
    return result;
  }
} // namespace Touchstone

#ifndef touchstone_solid_finite_strain_cells_h
#define touchstone_solid_finite_strain_cells_h

#include <touchstone/algebra/vector.h>
#include <touchstone/scene/scene.h>
#include <touchstone/solid/finite_strain_kernel.h>
#include <touchstone/solid/row_writer.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q.h>

#include <memory>
#include <vector>

namespace Touchstone
{
  /**
   * @brief The cells of bodies with a law for finite strain, as plain arrays: what is
   * evaluated in each Newton iteration.
   *
   * Each rank holds the cells that have a node that it owns, ghost cells
   * included, so rows and forces are complete without communication. Displacement
   * vectors are those of ghosted(). Nothing is changed for nodes of other bodies.
   */
  class FiniteStrainCells
  {
  public:
    FiniteStrainCells(const Scene                   &scene,
                      const dealii::FESystem<dim>   &fe,
                      const dealii::MappingQ<dim>   &mapping,
                      const dealii::DoFHandler<dim> &dof_handler,
                      const Matrix                  &stiffness);

    /** @brief Whether no body of the scene has such a law; the same on all ranks. */
    bool
    empty() const
    {
      return !any_body;
    }

    /** @brief Replace the rows of these cells' nodes by the tangent at @p u. */
    void
    assemble(const Vector &u, RowWriter &writer);

    /** @brief Replace the forces on these cells' nodes (no ghosts) by the internal
     * forces at @p u. */
    void
    internal_force(const Vector &u, Vector &force);

    /** @brief Energy of the cells that this rank owns at @p u, force times length. */
    double
    energy(const Vector &u);

    /** @brief Smallest det F of the quadrature points of the cells that this rank
     * owns. */
    double
    smallest_determinant(const Vector &u);

    /** @brief The kernel of cell number @p cell (of the triangulation, active), at
     * @p u; null if the cell is not of such a body. */
    const FiniteStrainKernel *
    at(unsigned int cell, const Vector &u);

    /** @brief Length to which round-off of the deformation gradient amounts
     * beside that of the displacement, by local row; 0 for other bodies. */
    const std::vector<double> &
    round_off_length() const
    {
      return size;
    }

  private:
    /** One cell; its nodes stand in the arrays below. */
    struct Cell
    {
      unsigned int body;
      bool         owned;
    };

    bool                                             any_body = false;
    unsigned int                                     n_nodes;
    std::vector<std::unique_ptr<FiniteStrainKernel>> kernels;
    std::vector<Cell>                                cells;
    /** By active cell of the triangulation; -1 for none. */
    std::vector<int> number;
    /** By cell and node: first unknown, first local row (or -1), the three local
     * columns. */
    std::vector<Index> dofs;
    std::vector<int>   rows, columns;
    /** Reference positions, by cell, node and component. */
    std::vector<double> positions;
    /** First row of each owned node. */
    std::vector<int>    node_rows;
    std::vector<double> size;
    /** Displacements of the present cell. */
    std::vector<double> displacement;

    /** Evaluate the deformation of cell @p c. */
    FiniteStrainKernel &
    go_to(std::size_t c, const Vector &u, double &determinant);
  };
} // namespace Touchstone

#endif

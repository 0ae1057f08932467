// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_nonlinear_cells_h
#define touchstone_solid_nonlinear_cells_h

#include <touchstone/algebra/matrix.h>
#include <touchstone/solid/body_parameters.h>
#include <touchstone/solid/cell_history.h>
#include <touchstone/solid/cell_kernel.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q.h>

#include <functional>
#include <memory>
#include <vector>

namespace Touchstone
{
  /**
   * @brief The cells of bodies with a nonlinear material, as plain arrays: what is evaluated
   * in each Newton iteration; and the history of those that have one.
   *
   * Each rank holds the cells that have a node that it owns, ghost cells
   * included, so rows and forces are complete without communication. Displacement
   * vectors are those of ghosted(). Nothing is changed for nodes of other bodies.
   *
   * The committed state belongs to the end of the last step. The present one is set by
   * internal_force() alone, from the committed state and the displacement.
   *
   * The arrays of nodes are those of assembly, and are made by connect(): steps that assemble
   * nothing do without them, and with keep_in() without those of history (doc/explicit.md, section
   * 8).
   */
  class NonlinearCells
  {
  public:
    NonlinearCells(const std::vector<BodyParameters> &bodies, const dealii::FESystem<dim> &fe);

    /** @brief Find the cells; both are kept by reference. */
    void
    reinit(const dealii::MappingQ<dim> &mapping, const dealii::DoFHandler<dim> &dof_handler);

    /** @brief Find where in @p stiffness their nodes are: assemble() and what depends on a
     * displacement, but for at(), come after it. */
    void
    connect(const Matrix &stiffness);

    /** @brief Whether no body of the scene has such a material; the same on all ranks. */
    bool
    empty() const
    {
      return !any_body;
    }

    /** @brief Whether any body has history; the same on all ranks. */
    bool
    has_history() const
    {
      return any_history;
    }

    /** @brief Whether any body has a law with plastic flow; the same on all ranks. */
    bool
    plastic() const
    {
      return any_plastic;
    }

    /** @brief Whether a law may have no answer; the same on all ranks. */
    bool
    can_fail() const
    {
      return any_failure;
    }

    /** @brief The present time for all materials. */
    void
    set_time(double time);

    /** @brief Time since the committed state for all materials, see MaterialInput. */
    void
    set_step_length(double length);

    /** @brief Whether all tangents are symmetric; the same on all ranks. */
    bool
    symmetric() const
    {
      return all_symmetric;
    }

    /** @brief Replace the rows of these cells' nodes by the tangent at @p u, or its
     * symmetric part. @return false if a material has no answer. */
    bool
    assemble(const Vector &u, bool symmetric_part, Matrix &stiffness);

    /** @brief Replace the forces on these cells' nodes (no ghosts) by the internal
     * forces at @p u, and the present state by that of @p u. @return false if a material
     * has no answer. */
    bool
    internal_force(const Vector &u, Vector &force);

    /** @brief Elastic energy of the cells that this rank owns at @p u, force times
     * length. */
    double
    elastic_energy(const Vector &u);

    /** @brief Smallest det F of the quadrature points of the cells that this rank
     * owns. */
    double
    smallest_determinant(const Vector &u);

    /** @brief The kernel of a cell, in its committed state and at @p u; null if the cell is not
     * of such a body. */
    CellKernel *
    at(const dealii::DoFHandler<dim>::active_cell_iterator &cell, const Vector &u);

    /** @brief Length to which round-off of the deformation gradient amounts
     * beside that of the displacement, by local row; 0 unless strain is finite. */
    const std::vector<double> &
    round_off_length() const
    {
      return size;
    }

    /** @brief First rows of the owned nodes of these cells. */
    const std::vector<int> &
    rows_of_nodes() const
    {
      return node_rows;
    }

    /** @name History */
    /** @{ */
    /** @brief Make the present state the committed one. */
    void
    commit()
    {
      committed = present;
    }

    /** @brief From now on history is kept elsewhere; null: here, virgin. */
    void
    keep_in(CellHistory *other);

    /** @brief Return to the committed state. */
    void
    rollback()
    {
      present = committed;
    }

    /** @brief Committed state of an active cell of the triangulation; empty if it has
     * none. */
    std::vector<double>
    state(unsigned int cell) const;

    /** @brief Set both states. @throws dealii::ExcDimensionMismatch */
    void
    set_state(unsigned int cell, const std::vector<double> &values);

    /** @brief The law of a body with history; null if it has none. */
    std::shared_ptr<const MaterialLaw>
    law(unsigned int body) const;

    /** @brief Visit the quadrature points with history of the owned cells: body, active
     * cell, reference volume, present state (for which law() has the meaning). */
    void
    for_each_state(const std::function<
                   void(unsigned int body, unsigned int cell, double volume, const double *state)>
                     &visit) const;
    /** @} */

  private:
    /** One cell; its nodes stand in the arrays below. */
    struct Cell
    {
      unsigned int body;
      bool         owned;
      /** Of the triangulation. */
      unsigned int number;
      /** Where its history begins. */
      std::size_t state;
    };

    const dealii::MappingQ<dim>   *mapping     = nullptr;
    const dealii::DoFHandler<dim> *dof_handler = nullptr;
    bool                           any_failure = false;
    bool         any_body = false, any_history = false, any_plastic = false, all_symmetric = true;
    unsigned int n_nodes;
    std::vector<std::unique_ptr<CellKernel>> kernels;
    std::vector<Cell>                        cells;
    /** By active cell of the triangulation; -1 for none. */
    std::vector<int> number;
    /** By cell and node: first unknown, first local row (or -1), local number. */
    std::vector<Index>        dofs;
    std::vector<int>          rows;
    std::vector<unsigned int> nodes;
    /** Reference positions, by cell, node and component. */
    std::vector<double> positions;
    /** First row of each owned node. */
    std::vector<int>    node_rows;
    std::vector<double> size;
    /** Numbers of the history of all cells. They are made when they are first needed, unless
     * they are elsewhere. */
    std::size_t                 n_history = 0;
    mutable std::vector<double> committed, present;
    CellHistory                *elsewhere = nullptr;
    /** Positions and displacements of a cell. */
    std::vector<dealii::Point<dim>> unit_points;
    mutable std::vector<double>     position, displacement;
    /** History of the cell of at(). */
    std::vector<double> kernel_state;

    /** Have history here, unless it is elsewhere. */
    void
    need_history() const;
    /** Set the positions of a cell. */
    void
    set_position(const dealii::DoFHandler<dim>::active_cell_iterator &cell) const;
    /** Evaluate the deformation of cell @p c. */
    CellKernel &
    go_to(std::size_t c, const Vector &u, double &determinant);
  };
} // namespace Touchstone

#endif

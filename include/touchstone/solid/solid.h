// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_solid_h
#define touchstone_solid_solid_h

#include <touchstone/algebra/ghost_import.h>
#include <touchstone/algebra/vector.h>
#include <touchstone/base/stateful.h>
#include <touchstone/mesh/forest.h>
#include <touchstone/solid/body_parameters.h>
#include <touchstone/solid/nonlinear_cells.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/vector.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>

namespace Touchstone
{
  /** @brief States of the quadrature points of cells, by active cell index. */
  using MaterialHistory = std::map<unsigned int, std::vector<double>>;

  /**
   * @brief The bodies as a discretised continuum: dofs, stiffness, internal
   * forces and stresses, without any boundary condition.
   *
   * The three displacement components of node k are the dofs 3k, 3k+1, 3k+2.
   */
  class Solid : public Stateful
  {
  public:
    /** @param bodies In the order of the forest; kept by reference.
     * @param degree Polynomial degree of the displacements. */
    Solid(const std::vector<BodyParameters> &bodies,
          unsigned int                       degree,
          const Forest                      &forest,
          MPI_Comm                           communicator);

    const std::vector<BodyParameters> &bodies;
    const dealii::FESystem<dim>        fe;
    const dealii::MappingQ<dim>        mapping;
    dealii::DoFHandler<dim>            dof_handler;
    dealii::IndexSet                   owned;
    /** Locally relevant dofs: owned ones and those of ghost cells. */
    dealii::IndexSet relevant;
    const MPI_Comm   communicator;
    /** Constraints of hanging nodes, on edges and faces of larger neighbours. */
    dealii::AffineConstraints<double> hanging;

    /** @brief Set up dofs after the mesh has changed; assemble() comes next. Collective. */
    void
    reinit();

    /** @brief Whether any rank has a hanging node. */
    bool
    has_hanging_nodes() const
    {
      return any_hanging;
    }

    /** @brief Move the forces on hanging nodes to the nodes that constrain them: only there do
     * forces balance. @p force has no ghosts; collective. */
    void
    condense(Vector &force) const;

    /** @brief Whether the bodies are linear, so that the stiffness never changes. */
    bool
    linear() const
    {
      return nonlinear->empty();
    }

    /** @brief Assemble the stiffness of the undeformed bodies. */
    void
    assemble();

    /** @brief Whether the stiffness is symmetric at all displacements. */
    bool
    symmetric() const
    {
      return nonlinear->symmetric();
    }

    /**
     * @brief Assemble the tangent stiffness at @p u (no ghosts): that of bodies
     * with a nonlinear material; the others keep what assemble() made.
     * @param symmetric_part Its symmetric part, where it is not symmetric().
     * @throws MaterialFailure on all ranks
     */
    void
    assemble(const Vector &u, bool symmetric_part = false);

    /** @brief Stiffness, force per length, with no condition applied. It is made when it is
     * first asked for, here or by what computes with it: explicit steps never do. Collective. */
    const Matrix &
    stiffness() const
    {
      return matrix_to_fill();
    }

    /** @brief Zero, over the owned dofs. Its copies share one layout, so that deal.II assigns them
     * to each other without messages; between layouts of their own it plans an exchange in each
     * assignment. */
    const Vector &
    zero_vector() const
    {
      return zero;
    }

    /** @brief A vector over the dofs, with ghosts. Collective. */
    Vector
    ghosted(const Vector &u) const;

    /** @brief Internal nodal forces of the displacement @p u (no ghosts), which becomes
     * the one that commit() keeps the history of. @throws MaterialFailure on all ranks */
    void
    internal_force(const Vector &u, Vector &force) const;

    /** @brief Elastic energy of all bodies, force times length. @p u has no ghosts;
     * collective. */
    double
    strain_energy(const Vector &u) const;

    /** @brief Whether det F > 0 at all quadrature points of bodies with a law for
     * finite strain. @p u has no ghosts; collective. */
    bool
    admissible(const Vector &u) const;

    /** @brief Norm of the round-off error of the internal forces of
     * @p u: no residual can fall below it. Force; collective. */
    double
    round_off(const Vector &u) const;

    /** @brief Visit the quadrature points of the owned cells with body number,
     * reference position, stress and volume: of bodies with a law for finite
     * strain the Cauchy stress and the present volume, so that their product
     * integrates. @p u has ghosts. */
    void
    for_each_stress(const Vector                             &u,
                    const std::function<void(unsigned int                           body,
                                             const dealii::Point<dim>              &x,
                                             const dealii::SymmetricTensor<2, dim> &stress,
                                             double volume)> &visit) const;

    /** @brief Stress (see for_each_stress()) averaged per owned cell, in the order of
     * active cell indices, zero elsewhere; force per area. @p u has ghosts. */
    std::vector<dealii::SymmetricTensor<2, dim>>
    cell_stress(const Vector &u) const;

    /** @name History of the material
     * The present state is a function of the committed one and of the displacement of the
     * last internal_force(). reinit() brings back virgin material. */
    /** @{ */
    bool
    has_history() const
    {
      return nonlinear->has_history();
    }

    /** @brief Whether any law has plastic flow. */
    bool
    plastic() const
    {
      return nonlinear->plastic();
    }

    /** @brief Forces and stiffness are now those of a state that follows upon the committed
     * one after the time @p length, until commit() or rollback(). @param end Its time. */
    void
    begin_step(const double length, const double end)
    {
      nonlinear->set_step_length(length);
      set_time(end);
    }

    /** @brief The time of forces and stresses, of a step that has no end to be cut from. */
    void
    set_time(const double present)
    {
      time = present;
      nonlinear->set_time(time);
    }

    /** @brief Keep the state of the last internal_force(); no time passes any more. */
    void
    commit() override
    {
      nonlinear->commit();
      nonlinear->set_step_length(0.);
      committed_time = time;
    }

    void
    rollback() override
    {
      nonlinear->rollback();
      nonlinear->set_step_length(0.);
      set_time(committed_time);
    }

    void
    save(ArchiveWriter &archive) const override;
    void
    load(const ArchiveReader &archive) override;

    /** @brief Committed state of an owned active cell; empty if it has none. The numbers of
     * its quadrature points follow one another. */
    std::vector<double>
    cell_state(const unsigned int active_cell_index) const
    {
      return nonlinear->state(active_cell_index);
    }

    /** @brief The committed states of all cells that this rank knows, by active cell index; the
     * bodies are virgin and at time 0 afterwards. */
    MaterialHistory
    take_history();
    /** @brief Give back on the same mesh what take_history() has taken; of time @p committed. */
    void
    give_history(const MaterialHistory &history, double committed);

    /** @brief From now on @p other keeps the history of the cells of this mesh, and no copy is
     * here; null: virgin material, kept here. */
    void
    keep_history_in(CellHistory *other)
    {
      nonlinear->keep_in(other);
    }

    /** @brief Set the state of an owned cell; exchange_cell_states() must follow. */
    void
    set_cell_state(const unsigned int active_cell_index, const std::vector<double> &values)
    {
      nonlinear->set_state(active_cell_index, values);
    }

    /** @brief Give the ghost cells the states of their owners. Collective. */
    void
    exchange_cell_states();

    /** @brief The law of a body with history; null if it has none. */
    std::shared_ptr<const MaterialLaw>
    history_law(const unsigned int body) const
    {
      return nonlinear->law(body);
    }

    unsigned int
    n_bodies() const
    {
      return bodies.size();
    }

    /** @brief Energy that all bodies have dissipated, or stored for good, since the start, at
     * the state of the last internal_force(): plastic work, for example; force times length.
     * Collective. */
    double
    dissipation() const;

    /** @brief Equivalent plastic strain averaged per owned cell, in the order of active cell
     * indices, zero elsewhere. */
    dealii::Vector<double>
    cell_plastic_strain() const;

    /** @brief Equivalent plastic strain at all quadrature points in the order of
     * for_each_stress(), zero where there is no plastic flow; empty without any. */
    std::vector<double>
    point_plastic_strain() const;

    /** @brief Largest equivalent plastic strain at a quadrature point by body number, of
     * bodies with plastic flow. Collective. */
    std::map<unsigned int, double>
    largest_plastic_strain() const;
    /** @} */

  private:
    Vector zero;
    /** Zero, over the relevant dofs, and what fills its copies; empty on one rank. */
    Vector                     zero_with_ghosts;
    std::optional<GhostImport> import_ghosts;
    /** Null until it is asked for. */
    mutable std::unique_ptr<Matrix> matrix;
    bool                            any_hanging = false;
    /** Present time, and that of the committed state. */
    double time = 0., committed_time = 0.;
    /** Sum of the absolute entries of each owned row. */
    std::vector<double> row_sums;
    /** Behind a pointer: its kernels are scratch space of const functions. */
    std::unique_ptr<NonlinearCells> nonlinear;

    /** Whether any body has thermal strain. */
    bool
    thermal() const;
    Matrix &
    matrix_to_fill() const;
    void
    check_solved(bool solved) const;
  };
} // namespace Touchstone

#endif

#ifndef touchstone_solid_solid_h
#define touchstone_solid_solid_h

#include <touchstone/algebra/vector.h>
#include <touchstone/mesh/forest.h>
#include <touchstone/scene/scene.h>
#include <touchstone/solid/finite_strain_cells.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/lac/affine_constraints.h>

#include <functional>
#include <memory>

namespace Touchstone
{
  /**
   * @brief The bodies as a discretised continuum: unknowns, stiffness, internal
   * forces and stresses, without any boundary condition.
   *
   * The three displacement components of node k are the unknowns 3k, 3k+1, 3k+2.
   */
  class Solid
  {
  public:
    Solid(const Scene &scene, const Forest &forest, MPI_Comm communicator);

    const dealii::FESystem<dim> fe;
    const dealii::MappingQ<dim> mapping;
    dealii::DoFHandler<dim>     dof_handler;
    dealii::IndexSet            owned;
    /** Owned unknowns and those of ghost cells. */
    dealii::IndexSet relevant;
    const MPI_Comm   communicator;
    /** Nodes on edges and faces of larger neighbours, which follow these. */
    dealii::AffineConstraints<double> hanging;

    /** @brief Begin anew after the mesh has changed: unknowns and matrix; assemble()
     * comes next. Collective. */
    void
    reinit();

    /** @brief Whether a node of any rank hangs. */
    bool
    has_hanging_nodes() const
    {
      return any_hanging;
    }

    /** @brief Hand nodal forces on hanging nodes over to the nodes that these
     * follow: only there do forces balance. @p force has no ghosts; collective. */
    void
    condense(Vector &force) const;

    /** @brief Whether the bodies are linear, so that the stiffness never changes. */
    bool
    linear() const
    {
      return finite->empty();
    }

    /** @brief Assemble the stiffness of the undeformed bodies. */
    void
    assemble();

    /** @brief Assemble the tangent stiffness at @p u (no ghosts): that of bodies
     * with a law for finite strain; the others keep what assemble() made. */
    void
    assemble(const Vector &u);

    /** @brief Stiffness, force per length, with no condition applied. */
    const Matrix &
    stiffness() const
    {
      return matrix;
    }

    /** @brief A vector over the unknowns, with ghosts. Collective. */
    Vector
    ghosted(const Vector &u) const;

    /** @brief Internal nodal forces of the displacement @p u (no ghosts). */
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

    /** @brief Norm of the error that round-off makes in the internal forces of
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

  private:
    const Scene &scene;
    Matrix       matrix;
    bool         any_hanging = false;
    /** Sum of the absolute entries of each owned row. */
    std::vector<double> row_sums;
    /** Behind a pointer: its kernels are scratch space of const functions. */
    std::unique_ptr<FiniteStrainCells> finite;
  };
} // namespace Touchstone

#endif

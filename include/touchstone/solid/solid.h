#ifndef touchstone_solid_solid_h
#define touchstone_solid_solid_h

#include <touchstone/algebra/vector.h>
#include <touchstone/mesh/forest.h>
#include <touchstone/scene/scene.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q.h>

#include <functional>

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

    /** @brief Assemble the stiffness of all bodies; linear bodies need it once. */
    void
    assemble();

    /** @brief Stiffness, force per length, with no condition applied. */
    const Matrix &
    stiffness() const
    {
      return matrix;
    }

    /** @brief Internal nodal forces of the displacement @p u (no ghosts). */
    void
    internal_force(const Vector &u, Vector &force) const;

    /** @brief Norm of the error that round-off makes in the internal forces of
     * @p u: no residual can fall below it. Force; collective. */
    double
    round_off(const Vector &u) const;

    /** @brief Visit the quadrature points of the owned cells with body number,
     * reference position, stress and volume. @p u has ghosts. */
    void
    for_each_stress(const Vector                             &u,
                    const std::function<void(unsigned int                           body,
                                             const dealii::Point<dim>              &x,
                                             const dealii::SymmetricTensor<2, dim> &stress,
                                             double volume)> &visit) const;

    /** @brief Stress averaged per owned cell (in the order of active cell
     * indices, zero elsewhere), force per area. @p u has ghosts. */
    std::vector<dealii::SymmetricTensor<2, dim>>
    cell_stress(const Vector &u) const;

  private:
    const Scene &scene;
    Matrix       matrix;
    /** Sum of the absolute entries of each owned row. */
    std::vector<double> row_sums;
  };
} // namespace Touchstone

#endif

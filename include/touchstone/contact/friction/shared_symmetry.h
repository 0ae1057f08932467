// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_friction_shared_symmetry_h
#define touchstone_contact_friction_shared_symmetry_h

#include <touchstone/contact/geometry/surface.h>
#include <touchstone/contact/pairing/pairing.h>
#include <touchstone/mesh/obstacle_parameters.h>

#include <deal.II/base/mpi.h>

#include <map>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Which planes of symmetry of a body are planes of symmetry of a contact pair.
   *
   * The mirrored half of a scene cancels the friction across a plane of symmetry (doc/theory.md 6),
   * and continues the surfaces beyond it.
   * But 'Symmetry' also supports bodies as rollers do, on a plane that is none of what they touch:
   * a shaft that is drawn through a sleeve, or a tool that moves across. There friction acts in all
   * tangential directions, and the support carries what goes across.
   */
  class SharedSymmetry
  {
  public:
    using Normals = std::map<Index, std::vector<dealii::Tensor<1, dim>>>;

    /** @brief With another body, the master of slave nodes or the slave of master nodes: it has the
     * plane, too.
     * @param normals Of the planes of symmetry that owned nodes of all bodies lie on. Collective.
     */
    SharedSymmetry(const Surface &other, const Normals &normals, MPI_Comm communicator);

    /** @brief With an obstacle: no point of the plane is moved across it, by formulas (at equal
     * times until the end of the run) or by forces.
     * @param obstacle Must live as long as this. @param end Time at the end of the run. */
    SharedSymmetry(const Pairing &pairing, const ObstacleParameters &obstacle, double end);

    /** @brief Whether the plane with this unit normal that a node lies on is one of the pair. */
    bool
    holds(const SurfaceNode &node, const dealii::Tensor<1, dim> &normal) const;

  private:
    struct Plane
    {
      dealii::Point<dim>     point;
      dealii::Tensor<1, dim> normal;

      bool
      is(const dealii::Point<dim> &other, const dealii::Tensor<1, dim> &normal, double size) const;
    };

    bool
    obstacle_stays(const SurfaceNode &slave, const dealii::Tensor<1, dim> &normal) const;

    std::vector<Plane>        planes;
    const ObstacleParameters *obstacle = nullptr;
    /** Where the obstacle is at those times. */
    std::vector<RigidMotion> motions;
  };
} // namespace Touchstone

#endif

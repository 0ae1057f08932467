// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/contact/friction/shared_symmetry.h>

#include <algorithm>
#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Of planes, distance by the size of a face and sine of the angle: coordinates in mesh files
     * may have six digits. */
    constexpr double same_place = 1e-3, same_direction = 1e-3;
    /** Of motions by formulas, by the size of a face: beyond round-off. */
    constexpr double no_motion = 1e-6;
    /** At so many times formulas for the motion of an obstacle are looked at. */
    constexpr unsigned int n_times = 256;
  } // namespace



  bool
  SharedSymmetry::Plane::is(const Point<dim>     &other,
                            const Tensor<1, dim> &direction,
                            const double          size) const
  {
    return cross_product_3d(normal, direction).norm() < same_direction &&
           std::abs((other - point) * normal) < same_place * size;
  }



  SharedSymmetry::SharedSymmetry(const Surface &other,
                                 const Normals &normals,
                                 const MPI_Comm communicator)
  {
    // A few planes with many nodes on each: one node of each plane says all.
    const auto add = [this](const Plane &plane, const double size) {
      if (std::none_of(planes.begin(), planes.end(), [&](const Plane &known) {
            return known.is(plane.point, plane.normal, size);
          }))
        planes.push_back(plane);
    };
    for (const SurfaceNode &node : other.owned_nodes())
      if (const auto found = normals.find(node.node); found != normals.end())
        for (const Tensor<1, dim> &normal : found->second)
          add({node.reference, normal}, node.size);
    planes = gather_all(planes, communicator);
  }



  SharedSymmetry::SharedSymmetry(const Pairing            &pairing,
                                 const ObstacleParameters &obstacle,
                                 const double              end)
    : obstacle(&obstacle)
  {
    for (unsigned int k = 0; k <= n_times; ++k)
      motions.push_back(pairing.motion(k * end / n_times));
  }



  bool
  SharedSymmetry::holds(const SurfaceNode &node, const Tensor<1, dim> &normal) const
  {
    if (obstacle)
      return obstacle_stays(node, normal);
    return std::any_of(planes.begin(), planes.end(), [&](const Plane &plane) {
      return plane.is(node.reference, normal, node.size);
    });
  }



  bool
  SharedSymmetry::obstacle_stays(const SurfaceNode &slave, const Tensor<1, dim> &normal) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        Tensor<1, dim> axis;
        axis[d] = 1.;
        if (obstacle->free.is_free(d) && std::abs(normal[d]) > same_direction)
          return false;
        if (obstacle->free.is_free(dim + d) &&
            cross_product_3d(normal, axis).norm() > same_direction)
          return false;
      }
    return std::all_of(motions.begin(), motions.end(), [&](const RigidMotion &motion) {
      return std::abs(motion.since(motions.front(), slave.reference) * normal) <
             no_motion * slave.size;
    });
  }
} // namespace Touchstone

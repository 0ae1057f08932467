// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_free_motion_parameters_h
#define touchstone_mesh_free_motion_parameters_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Keys of an obstacle whose motion is not prescribed in some directions but follows from
   * the forces on it. Components 0 to 2 are translations along the axes, 3 to 5 turns about them.
   */
  struct FreeMotionParameters
  {
    static constexpr unsigned int n_components = 6;

    /** Words: x, y, z, about x, about y, about z. */
    std::vector<std::string> directions;
    /** What the obstacle turns about, and its centre of mass; moves with it. Length. */
    dealii::Tensor<1, 3> reference_point;
    /** Components of force and moment about the reference point, formulas in t; empty is zero. */
    std::array<std::string, n_components> loads;
    /** Mass, and moments of inertia about the axes through the reference point at time 0. */
    double               mass = 0.;
    dealii::Tensor<1, 3> inertia;
    /** At time 0: length, and radians, per time. */
    dealii::Tensor<1, 3> velocity, angular_velocity;

    /** @brief Name of a component: x, y, z, about x, about y, about z. */
    static std::string
    word(unsigned int component);

    /** @brief Key of the load along a component. */
    static std::string
    load_key(unsigned int component);

    /** @brief Whether the motion along a component follows from forces. */
    bool
    is_free(unsigned int component) const;

    bool
    any() const
    {
      return !directions.empty();
    }

    /** @brief Whether it may turn. */
    bool
    turns() const
    {
      return is_free(3) || is_free(4) || is_free(5);
    }

    /** @brief Mass or moment of inertia that resists a component. */
    double
    resistance(const unsigned int component) const
    {
      return component < 3 ? mass : inertia[component - 3];
    }

    /** @brief Velocity at time 0 along a component. */
    double
    start(const unsigned int component) const
    {
      return component < 3 ? velocity[component] : angular_velocity[component - 3];
    }

    void
    declare(dealii::ParameterHandler &prm);

    /** @param prescribed Formulas of the motion along the axes and of the angle, "0" where there is
     * none.
     * @throws InputError */
    void
    check(const std::string &section, const std::array<std::string, 4> &prescribed) const;

  private:
    void
    check_directions(const std::string &section) const;
    void
    check_inertia(const std::string &section) const;
  };
} // namespace Touchstone

#endif

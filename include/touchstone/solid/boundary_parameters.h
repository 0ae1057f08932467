// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_boundary_parameters_h
#define touchstone_solid_boundary_parameters_h

#include <touchstone/base/keyword.h>
#include <touchstone/solid/material_parameters.h>

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Section "Body NAME/Boundary BOUNDARY": what is prescribed on one
   * boundary of one body. Every value is an expression in x, y, z, t
   * (reference coordinates and time); an empty one prescribes nothing.
   */
  struct BoundaryParameters
  {
    /** Prescribed displacement components, length. */
    std::string displacement_x, displacement_y, displacement_z;
    /** Traction components, force per reference area. */
    std::string traction_x, traction_y, traction_z;
    /** Pressure against the outward normal, force per area: of the deformed surface if
     * it follows that. */
    std::string pressure;
    /** What the pressure follows: the deformed surface, or nothing (a dead load); automatic:
     * the surface if the law of the material is for finite strain. */
    enum class Follows
    {
      automatic,
      surface,
      nothing
    };
    Keyword<Follows> pressure_follows{Follows::automatic,
                                      {{"automatic", Follows::automatic},
                                       {"surface", Follows::surface},
                                       {"nothing", Follows::nothing}}};

    /** Force and moment components that are carried to the boundary, expressions in t. */
    std::array<std::string, 3> force, moment;
    /** Where the force acts, length: x, y, z, or nothing for the centroid. */
    std::vector<double> reference_point;
    /** Springs to the ground, force per area and length. */
    double spring_normal = 0., spring_tangential = 0.;

    /** @brief Whether a force or moment is carried to the boundary. */
    bool
    has_resultant() const;

    /** @brief The pressure acts on the deformed surface: as the key says, and if that
     * says nothing for materials with a law for finite strain. */
    bool
    follows(const MaterialParameters &material) const
    {
      return pressure_follows == Follows::surface ||
             (pressure_follows == Follows::automatic && material.finite_strain());
    }

    /** @brief The formulas by their keys, the pressure first; empty ones too. */
    std::vector<std::pair<std::string, std::string>>
    formulas() const;

    /** @brief Neither a displacement nor a load nor springs. */
    bool
    prescribes_nothing() const;

    void
    declare(dealii::ParameterHandler &prm);
    /** Every expression parses; a component is not both moved and loaded. */
    void
    check(const std::string &section) const;
  };
} // namespace Touchstone

#endif

#ifndef touchstone_solid_boundary_parameters_h
#define touchstone_solid_boundary_parameters_h

#include <touchstone/solid/material_parameters.h>

#include <deal.II/base/parameter_handler.h>

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
    /** What the pressure follows: "surface", "nothing", or "automatic". */
    std::string pressure_follows = "automatic";

    /** @brief The pressure acts on the deformed surface: as the key says, and if that
     * says nothing for materials with a law for finite strain. */
    bool
    follows(const MaterialParameters &material) const
    {
      return pressure_follows == "surface" ||
             (pressure_follows == "automatic" && material.finite_strain());
    }

    /** @brief The formulas by their keys, the pressure first; empty ones too. */
    std::vector<std::pair<std::string, std::string>>
    formulas() const;

    void
    declare(dealii::ParameterHandler &prm);
    /** Every expression parses; a component is not both moved and loaded. */
    void
    check(const std::string &section) const;
  };
} // namespace Touchstone

#endif

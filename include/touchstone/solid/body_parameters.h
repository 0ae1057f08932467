// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_body_parameters_h
#define touchstone_solid_body_parameters_h

#include <touchstone/base/keyword.h>
#include <touchstone/solid/boundary_parameters.h>
#include <touchstone/solid/material_parameters.h>

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace Touchstone
{
  class Geometry;

  /** @brief How the cells of a body interpolate strain. */
  enum class ElementType
  {
    /** Chosen by degree and material law, see automatic_element(). */
    automatic,
    full,
    b_bar,
    incompatible_modes,
    f_bar,
    /** Of explicit dynamics. */
    one_point
  };

  /** @brief Section "Body NAME". */
  struct BodyParameters
  {
    std::string name;
    /** The key "Type" of the subsection "Geometry" ("box", "tube", ...). */
    Choice<Registry<Geometry>> geometry_type{"box"};
    /** The geometry with its own parameters read. */
    std::shared_ptr<Geometry> geometry;
    /** "automatic" is replaced by the scene (see automatic_element()). */
    Keyword<ElementType> element_type{ElementType::automatic,
                                      {{"automatic", ElementType::automatic},
                                       {"full", ElementType::full},
                                       {"b-bar", ElementType::b_bar},
                                       {"incompatible modes", ElementType::incompatible_modes},
                                       {"F-bar", ElementType::f_bar},
                                       {"one point", ElementType::one_point}}};
    /** What holds the hourglass modes of one-point cells: springs, dampers, or nothing. */
    enum class Hourglass
    {
      stiffness,
      viscous,
      none
    };
    Keyword<Hourglass> hourglass{Hourglass::stiffness,
                                 {{"stiffness", Hourglass::stiffness},
                                  {"viscous", Hourglass::viscous},
                                  {"none", Hourglass::none}}};
    /** Factor of the elastic stiffness, or part of critical damping; a number or "automatic"; no
     * unit. */
    std::string hourglass_coefficient = "automatic";
    /** @brief That factor: "automatic" stands for 1 with springs of elastic bodies, and for 0.1
     * else. */
    double
                       hourglass_factor() const;
    MaterialParameters material;
    /** Boundaries on which the normal displacement is zero (must be plane). */
    std::vector<std::string> symmetry;
    /** Boundaries on which all displacements are zero. */
    std::vector<std::string> fixed;
    /** @brief Displacements are prescribed somewhere. */
    bool
    supported() const;
    /** Boundaries with a subsection "Boundary NAME" of their own. */
    std::vector<std::string>                  conditions;
    std::map<std::string, BoundaryParameters> boundaries;
    /** Expressions in x, y, z: velocity (length per time) and displacement (length) at
     * time 0; empty ones are zero. */
    std::array<std::string, 3> initial_velocity, initial_displacement;
    /** Expressions in x, y, z, t: force per reference volume, as gravity is. */
    std::array<std::string, 3> body_force;
    /** Expressions in x, y, z, t: the displacement that the reference solution "formula"
     * compares with, length; empty ones are not compared. */
    std::array<std::string, 3> reference_displacement;

    /** @brief "Body NAME". */
    std::string
    section() const;
    ElementType
    element() const
    {
      return element_type;
    }
    /** @brief What "automatic" stands for: full for degree 2; for degree 1 F-bar
     * with a law for finite strain, b-bar with plasticity at small strain, and else
     * incompatible modes. */
    ElementType
    automatic_element(unsigned int degree) const;

    /**
     * @brief Declare all entries, those of the geometry included; @p conditions
     * must be known before, for it names subsections.
     * @param values Of this section: geometry, law and hardening decide on other keys.
     */
    void
    declare(dealii::ParameterHandler &prm, const EarlyValues &values);
    void
    check() const;

  private:
    /** Initial state, body force and reference displacement. */
    void
    declare_formulas(dealii::ParameterHandler &prm);
    void
    declare_geometry(dealii::ParameterHandler &prm, const EarlyValues &values);
  };
} // namespace Touchstone

#endif

#ifndef touchstone_scene_body_parameters_h
#define touchstone_scene_body_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace Touchstone
{
  class Geometry;
  class HardeningLaw;

  /** @brief Section "Body NAME/Material": an isotropic elastic or elastoplastic material. */
  struct MaterialParameters
  {
    /** "linear elastic" (small strain) or the name of a HyperelasticLaw, a SmallStrainLaw
     * or a FiniteStrainLaw, whose constants are those of linear elasticity at the
     * undeformed state. */
    std::string law = "linear elastic";
    /** Young's modulus, force per area; must be positive. */
    double young_modulus = 0.;
    /** Poisson's ratio, -1 < nu < 0.5. */
    double poisson_ratio = 0.3;
    /** Mass per volume; must be positive where there is inertia. */
    double density = 0.;
    /** Rayleigh damping C = a M + b K, with K at the undeformed state: a per
     * time, b time. */
    double rayleigh_mass = 0., rayleigh_stiffness = 0.;

    /** @name Subsection "Plasticity", of plastic laws only */
    /** @{ */
    /** Name under which the isotropic hardening is registered, and that with its own
     * parameters read; null if the law is elastic. */
    std::string                   hardening_name = "none";
    std::shared_ptr<HardeningLaw> hardening;
    /** C of Armstrong and Frederick, force per area, 0 for none; and gamma, no unit, 0 for
     * linear kinematic hardening. */
    double kinematic_modulus = 0., kinematic_recovery = 0.;
    /** @} */

    /** @brief The law is "linear elastic". */
    bool
    linear() const
    {
      return law == "linear elastic";
    }
    /** @brief Whether the law has history: it is a SmallStrainLaw or a FiniteStrainLaw. */
    bool
    plastic() const;
    /** @brief Whether the law is for finite strain. */
    bool
    finite_strain() const;
    /** @brief mu, force per area. */
    double
    shear_modulus() const
    {
      return young_modulus / (2. * (1. + poisson_ratio));
    }
    /** @brief kappa, force per area. */
    double
    bulk_modulus() const
    {
      return young_modulus / (3. * (1. - 2. * poisson_ratio));
    }
    /** @brief Declare all entries; @p law and @p hardening_name must be known before, for
     * they decide on others. */
    void
    declare(dealii::ParameterHandler &prm);
    void
    check(const std::string &section) const;

  private:
    void
    check_plasticity(const std::string &section) const;
  };

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

  /** @brief How the cells of a body interpolate strain. */
  enum class ElementType
  {
    full,
    b_bar,
    incompatible_modes,
    f_bar
  };

  /** @brief Section "Body NAME". */
  struct BodyParameters
  {
    std::string name;
    /** Name under which the geometry is registered ("box", "tube", ...), the
     * key "Type" of the subsection "Geometry". */
    std::string geometry_name = "box";
    /** The geometry with its own parameters read. */
    std::shared_ptr<Geometry> geometry;
    /** "full", "b-bar", "incompatible modes" or "F-bar"; "automatic" is replaced
     * by the scene (see automatic_element()). */
    std::string        element_name = "automatic";
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
    element() const;
    /** @brief What "automatic" stands for: full for degree 2; for degree 1 F-bar
     * with a law for finite strain, b-bar with plasticity at small strain, and else
     * incompatible modes. */
    std::string
    automatic_element(unsigned int degree) const;

    /**
     * @brief Declare all entries, those of the geometry included; @p conditions
     * must be known before, for it names subsections, and law and hardening of the
     * material.
     * @param geometry_type Name under which the geometry is registered.
     */
    void
    declare(dealii::ParameterHandler &prm, const std::string &geometry_type);
    /** @param degree Polynomial degree of the discretisation. */
    void
    check(unsigned int degree) const;

  private:
    void
    check_element(unsigned int degree) const;
  };
} // namespace Touchstone

#endif

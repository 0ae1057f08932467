// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_material_law_h
#define touchstone_solid_material_law_h

#include <touchstone/base/registry.h>
#include <touchstone/base/types.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

namespace Touchstone
{
  struct MaterialParameters;

  /** @brief Input of a material law at one quadrature point. */
  struct MaterialInput
  {
    /** Finite strain: deformation gradient F, det F > 0. Small strain: the displacement
     * gradient, of which the symmetric part counts. */
    const dealii::Tensor<2, dim> &deformation;
    /** State at the end of the last step. */
    const double *committed;
    /** Time since then; 0 where no time passes: at the end of a step that has been committed,
     * and for the stiffness before the first step. */
    double step_length;
    /** Reference position of the point, and the present time, for what depends on them. */
    dealii::Point<dim> position = dealii::Point<dim>();
    double             time     = 0.;
  };

  /** @brief Output of a material law at one quadrature point. */
  struct MaterialResponse
  {
    /** Potential of the stress per reference volume, up to a constant of the step: the stress
     * of a symmetric law is its derivative. The elastic energy, and what the step dissipates
     * (half of that where the dissipation is quadratic in the rate). */
    double energy = 0.;
    /** Elastic energy per reference volume. */
    double elastic_energy = 0.;
    /** Stress[i][J], force per reference area. */
    dealii::Tensor<2, dim> stress;
    /** Derivative of the stress by the deformation, [i][J][k][L], force per area. */
    dealii::Tensor<4, dim> tangent;
    /** False if the local equations of the law have no solution that could be found. */
    bool solved = true;
  };

  /** @brief Which quantities a material law must compute: each includes the state, and the last the
   * stress. */
  enum class Demand
  {
    energy,
    stress,
    tangent
  };

  /**
   * @brief A nonlinear material at one point, with or without history.
   *
   * The history is an array of n_state() numbers. The response and the present state are
   * functions of the deformation and the committed state alone: evaluating twice changes
   * nothing.
   */
  class MaterialLaw
  {
  public:
    virtual ~MaterialLaw() = default;

    /** @brief Number of history variables of a point. */
    virtual unsigned int
    n_state() const
    {
      return 0;
    }

    /** @brief Write the state of the virgin material. */
    virtual void
    start(double * /*state*/) const
    {
    }

    /** @brief Turn an average of several states into an admissible one. */
    virtual void
    restore(double * /*state*/) const
    {
    }

    /** @brief Energy per reference volume that has been dissipated, or stored for good, since
     * the start. */
    virtual double
    dissipation(const double * /*state*/) const
    {
      return 0.;
    }

    /** @brief Whether there is plastic flow: results then show the equivalent plastic
     * strain. */
    virtual bool
    plastic() const
    {
      return false;
    }

    /** @brief Equivalent plastic strain of a plastic() law; no unit. */
    virtual double
    plastic_strain(const double * /*state*/) const
    {
      return 0.;
    }

    /** @brief Whether the tangent is symmetric, A[i][J][k][L] = A[k][L][i][J]. */
    virtual bool
    symmetric() const
    {
      return true;
    }

    /** @brief Whether the law has a response to the deformation, which is not inverted. Unlike
     * MaterialResponse::solved this is asked for before anything is evaluated: a Newton increment
     * is shortened until it is true. */
    virtual bool
    admits(const MaterialInput & /*input*/) const
    {
      return true;
    }

    /** @brief Whether respond() can fail, also without history. */
    virtual bool
    can_fail() const
    {
      return n_state() > 0;
    }

    /** @brief Whether no state is stiffer than the undeformed one, as of material that flows or
     * relaxes: the stable step of explicit dynamics then follows from the elastic stiffness, else
     * from the tangent. */
    virtual bool
    stiffest_at_rest() const
    {
      return n_state() > 0;
    }

    /**
     * @brief The response to a deformation that follows upon the committed state.
     * @param present State that belongs to the deformation.
     */
    virtual void
    respond(const MaterialInput &input,
            Demand               demand,
            MaterialResponse    &response,
            double              *present) const = 0;
  };

  /** @brief A law with history for small strain. */
  class SmallStrainLaw : public MaterialLaw
  {
  };

  /** @brief A law with history for finite strain; those without are HyperelasticLaws. */
  class FiniteStrainLaw : public MaterialLaw
  {
  };

  /** @brief The laws by the name that the key "Law" of a material takes. */
  using SmallStrainRegistry  = Registry<SmallStrainLaw, const MaterialParameters &>;
  using FiniteStrainRegistry = Registry<FiniteStrainLaw, const MaterialParameters &>;
} // namespace Touchstone

#endif

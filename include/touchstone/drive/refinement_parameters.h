// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_refinement_parameters_h
#define touchstone_drive_refinement_parameters_h

#include <touchstone/base/keyword.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace Touchstone
{
  /** @brief Section "Refinement": a mesh that follows the solution. */
  struct RefinementParameters
  {
    /** What decides where the mesh is refined. */
    enum class Estimator
    {
      none,
      /** The formula of the key "Region" alone. */
      region,
      /** Jumps of stress between cells. */
      kelly,
      /** Distance of stress from averaged stress. */
      recovered_stress,
      /** The same, weighted by what it means for the contact forces (ForceEstimate). */
      contact_force
    };
    Keyword<Estimator> estimator{Estimator::none,
                                 {{"none", Estimator::none},
                                  {"region", Estimator::region},
                                  {"Kelly", Estimator::kelly},
                                  {"recovered stress", Estimator::recovered_stress},
                                  {"contact force", Estimator::contact_force}}};
    /** Of solving and refining in the first step, and in each later one. */
    unsigned int cycles = 3, cycles_per_step = 1;
    /** Share of the estimated squared error in the cells that are refined, and in
     * those that may be coarsened. */
    double refine_fraction = 0.3, coarsen_fraction = 0.02;
    /** Share of the squared variation of the contact pressure in the slave faces
     * that are refined. */
    double contact_fraction = 0.7;
    /** Times that a cell is halved at most. */
    unsigned int maximum_level = 4;
    unsigned int maximum_cells = 1000000;
    /** Relative estimated error at which refinement ends; no unit. */
    double tolerance = 0.;
    /** Formula of x, y, z, t; refined where it is positive. */
    std::string region;

    bool
    active() const
    {
      return estimator != Estimator::none;
    }

    /** @brief Whether the mesh changes: without cycles errors are only estimated. */
    bool
    changes_mesh() const
    {
      return active() && cycles + cycles_per_step > 0;
    }

    void
    declare(dealii::ParameterHandler &prm);
    void
    check(const std::string &section) const;
  };
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_block_law_h
#define touchstone_explicit_block_law_h

#include <touchstone/explicit/n_lanes.h>
#include <touchstone/explicit/one_point_plasticity.h>
#include <touchstone/solid/body_parameters.h>
#include <touchstone/solid/material_law.h>

#include <memory>
#include <vector>

namespace Touchstone
{
  /** @brief The material of a body at one point of each of eight cells: by formulas for all at
   * once, where there are any, or by the law of implicit runs for one after the other. */
  class BlockLaw
  {
  public:
    explicit BlockLaw(const BodyParameters &body);

    /** @brief Null: linear elastic. */
    const MaterialLaw *
    law() const
    {
      return of_points.get();
    }

    /** @brief Whether there are formulas for eight cells. */
    bool
    has_formulas() const
    {
      return formulas != Formulas::any_law;
    }

    bool
    finite_strain() const
    {
      return finite;
    }

    /**
     * @brief First Piola-Kirchhoff stresses, [3i+j].
     * @param gradient Gradients of the displacement, [3i+j].
     * @param step     Time since the last call.
     * @param n_used   Cells whose failure counts.
     * @param state    History, [variable], which goes on.
     * @return the first cell that is inverted or whose law has no answer; n_lanes if there is none.
     */
    unsigned int
    respond(const double (*gradient)[n_lanes],
            double       step,
            unsigned int n_used,
            double (*state)[n_lanes],
            double (*stress)[n_lanes]);

  private:
    enum class Formulas
    {
      linear_elastic,
      neo_hookean,
      von_mises,
      any_law
    };

    const bool                         finite;
    Formulas                           formulas;
    std::shared_ptr<const MaterialLaw> of_points;
    /** The yield stress is that of virgin material. */
    VonMisesConstants constants;
    /** History of a point at both ends of a cycle. */
    std::vector<double> before, after;

    /** By the law itself, of the cells that are marked or of all. */
    unsigned int
    respond_singly(const double (*gradient)[n_lanes],
                   double       step,
                   unsigned int n_used,
                   double (*state)[n_lanes],
                   double (*stress)[n_lanes],
                   const double *marked);
  };
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_converged_step_h
#define touchstone_output_converged_step_h

#include <touchstone/algebra/vector.h>
#include <touchstone/contact/results.h>
#include <touchstone/explicit/impulse_work.h>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace Touchstone
{
  class Solid;

  /** @brief A load step that has converged and been committed: what StepQuantity and
   * Simulation::after_step() see. */
  struct ConvergedStep
  {
    /** From 1. */
    unsigned int number = 0;
    /** At the end of the step, and its length. */
    double       time              = 0.;
    double       step_size         = 0.;
    unsigned int newton_iterations = 0;
    unsigned int linear_iterations = 0;
    /** How often the step was cut before it converged. */
    unsigned int cuts = 0;
    /** Number of its phase, from 1; 0 if there are none. */
    unsigned int phase = 0;
    /** By name of the contact pair, summed over all ranks. */
    std::map<std::string, PairResult> pairs;
    /** Estimated relative errors of their forces, NaN where there is no estimate; empty if none
     * were asked for. */
    std::map<std::string, double> force_errors;
    /** Shortening and tension of pairs with pretension: length, force. */
    std::map<std::string, std::pair<double, double>> pretension;
    /** Obstacles that forces move, by name. */
    std::map<std::string, RigidToolResult> tools;
    /** Reaction forces, by "BODY/BOUNDARY". */
    std::map<std::string, dealii::Tensor<1, dim>> reactions;
    /** Energies by name, force times length. */
    std::map<std::string, double> energies;
    /** Where there is inertia: momentum, and angular momentum about the origin. */
    std::optional<dealii::Tensor<1, dim>> momentum, angular_momentum;

    /** Of explicit dynamics: number of cycles in the step, and the length of the shortest; and what
     * contact had to do in them, if there are contact pairs. */
    std::optional<std::pair<unsigned int, double>> cycles;
    std::optional<ImpulseWork>                     contact_work;

    /** @name The state itself, on this rank; null or empty where nobody provides it */
    /** @{ */
    const Solid *solid = nullptr;
    /** With ghosts, length: component d of node k is (*displacement)(3 * k + d). */
    const Vector *displacement = nullptr;
    /** The contact rows of the slave nodes that this rank owns. */
    std::vector<ContactPoint> points;
    /** @} */
  };
} // namespace Touchstone

#endif

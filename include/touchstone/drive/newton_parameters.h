// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_newton_parameters_h
#define touchstone_drive_newton_parameters_h

#include <touchstone/base/keyword.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace Touchstone
{
  /** @brief Section "Newton": the semismooth Newton method of a step. */
  struct NewtonParameters
  {
    /** Out-of-balance force relative to the forces that act; no unit. */
    double residual_tolerance = 1e-10;
    /** Gap or penetration relative to the size of the slave faces; no unit. */
    double       gap_tolerance      = 1e-8;
    unsigned int maximum_iterations = 40;
    /** Whether a part of increments that make things worse is taken back. */
    enum class LineSearch
    {
      automatic,
      none
    };
    Keyword<LineSearch> line_search{LineSearch::automatic,
                                    {{"automatic", LineSearch::automatic},
                                     {"none", LineSearch::none}}};

    void
    declare(dealii::ParameterHandler &prm);
    void
    check(const std::string &section) const;
  };
} // namespace Touchstone

#endif

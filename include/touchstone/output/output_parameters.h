// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_output_parameters_h
#define touchstone_output_output_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace Touchstone
{
  /** @brief Section "Output". */
  struct OutputParameters
  {
    /** Folder; empty: output/STEM for a scene file STEM.prm. */
    std::string directory;
    /** Write solution and contact VTU files every so many steps; 0: never. */
    unsigned int vtu_interval = 1;

    void
    declare(dealii::ParameterHandler &prm);
    void
    check(const std::string &section) const;
  };
} // namespace Touchstone

#endif

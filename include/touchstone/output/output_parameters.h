// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_output_parameters_h
#define touchstone_output_output_parameters_h

#include <touchstone/base/keyword.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace Touchstone
{
  /** @brief In what kind of files fields are written, see FileSeries. */
  enum class ResultFormat
  {
    /** VTK's XML files, numbers in single precision. */
    vtu,
    /** One HDF5 file for all ranks, numbers in double precision. */
    xdmf
  };

  /** @brief What is written as it is in the cells, without averages at nodes. */
  enum class Unsmoothed
  {
    none,
    /** The mean stress of each cell. */
    cells,
    /** Stresses at the quadrature points. */
    points,
    both
  };

  /** @brief Section "Output". */
  struct OutputParameters
  {
    /** Folder; empty: output/STEM for a scene file STEM.prm. */
    std::string directory;
    /** Write solution and contact files every so many steps; 0: never. */
    unsigned int          vtu_interval = 1;
    Keyword<ResultFormat> format{ResultFormat::vtu,
                                 {{"vtu", ResultFormat::vtu}, {"xdmf", ResultFormat::xdmf}}};
    Keyword<Unsmoothed>   unsmoothed{Unsmoothed::none,
                                   {{"none", Unsmoothed::none},
                                      {"cells", Unsmoothed::cells},
                                      {"points", Unsmoothed::points},
                                      {"both", Unsmoothed::both}}};

    bool
    cell_values() const
    {
      return unsmoothed == Unsmoothed::cells || unsmoothed == Unsmoothed::both;
    }

    bool
    point_values() const
    {
      return unsmoothed == Unsmoothed::points || unsmoothed == Unsmoothed::both;
    }

    void
    declare(dealii::ParameterHandler &prm);
    void
    check(const std::string &section) const;
  };
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/output_parameters.h>

namespace Touchstone
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  void
  OutputParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Directory",
                      directory,
                      "Folder for all output; empty: output/STEM for a scene file "
                      "STEM.prm.",
                      Patterns::Anything());
    prm.add_parameter("VTU interval",
                      vtu_interval,
                      "Pictures (solution.pvd, contact.pvd) every so many steps and "
                      "at the end; 0: never.",
                      Patterns::Integer(0));
    format.declare(prm,
                   "Format",
                   "Files of these pictures. 'vtu': a file for each rank, numbers in single "
                   "precision. 'xdmf': one HDF5 file for all ranks (solution.xdmf, contact.xdmf), "
                   "numbers in double precision, for large runs and for further computations.");
    unsmoothed.declare(prm,
                       "Unsmoothed values",
                       "Stresses as they are in the cells, beside the averages at nodes. 'cells': "
                       "the mean of each cell (cell_stress and cell_von_mises in solution.pvd). "
                       "'points': at the quadrature points, as a cloud of points (points.pvd). "
                       "'both': these two.");
  }



  void
  OutputParameters::check(const std::string &) const
  {
  }
} // namespace Touchstone

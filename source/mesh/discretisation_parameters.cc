// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/base/parameter_checks.h>
#include <touchstone/mesh/discretisation_parameters.h>

// Keys of the section 'Discretisation', common to all bodies: degree of the elements, refinement,
// and the distribution of the mesh over the ranks.
namespace Touchstone
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  void
  DiscretisationParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Degree",
                      degree,
                      "Polynomial degree of the hexahedra, 1 or 2, for all bodies.",
                      Patterns::Integer(1, 2));
    prm.add_parameter("Refinement factor",
                      refinement_factor,
                      "Multiplies the number of cells per direction of the built-in "
                      "geometries; powers of two refine the mesh with its "
                      "manifolds. Meshes from files accept only those.",
                      Patterns::Double(0.));
    partitioner.declare(
      prm,
      "Partitioner",
      "How cells are spread over ranks: 'coordinates' cuts across the longest side, "
      "and the halves again; 'p4est' cuts its space-filling curve, which goes "
      "through one body after the other, and can refine the mesh; 'automatic' is "
      "'p4est' where the run refines, 'coordinates' elsewhere; 'METIS' cuts the "
      "graph of cells and faces, with cells and contact work balanced each for "
      "itself; 'METIS, cells only' leaves contact out. The results are the same.");
    prm.add_parameter("Contact weight",
                      contact_weight,
                      "Work of a slave face over that of a cell, for 'coordinates' and 'p4est'; "
                      "a master face counts a quarter of it. [no unit]",
                      Patterns::Double(0., 1000.));
  }



  void
  DiscretisationParameters::check(const std::string &section) const
  {
    check_positive(section,
                   "Refinement factor",
                   refinement_factor,
                   "1 takes the cells as they are given, 2 halves their size");
#ifndef TOUCHSTONE_WITH_METIS
    if (partitioner == Partitioner::metis || partitioner == Partitioner::metis_cells_only)
      throw InputError(section,
                       "Partitioner",
                       partitioner.word(),
                       "this program was built without METIS",
                       "set it to 'automatic', or install libmetis-dev and build again");
#endif
  }
} // namespace Touchstone

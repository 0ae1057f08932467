// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_discretisation_parameters_h
#define touchstone_mesh_discretisation_parameters_h

#include <touchstone/base/keyword.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace Touchstone
{
  /** @brief Section "Discretisation". */
  struct DiscretisationParameters
  {
    /** Polynomial degree of FE_Q, 1 or 2, for all bodies. */
    unsigned int degree = 1;
    /** Multiplies the number of cells per direction of built-in geometries;
     * whole powers of two refine the mesh with its manifolds. Meshes from
     * files accept powers of two only. */
    double refinement_factor = 1.;
    /** How cells are spread over the ranks. */
    enum class Partitioner
    {
      /** p4est where the run refines, coordinates elsewhere. */
      automatic,
      coordinates,
      p4est,
      metis,
      metis_cells_only
    };
    Keyword<Partitioner> partitioner{Partitioner::automatic,
                                     {{"automatic", Partitioner::automatic},
                                      {"coordinates", Partitioner::coordinates},
                                      {"p4est", Partitioner::p4est},
                                      {"METIS", Partitioner::metis},
                                      {"METIS, cells only", Partitioner::metis_cells_only}}};
    /** For p4est, contact work of a slave face over the work of a cell; no unit. */
    double contact_weight = 0.;

    void
    declare(dealii::ParameterHandler &prm);
    void
    check(const std::string &section) const;
  };
} // namespace Touchstone

#endif

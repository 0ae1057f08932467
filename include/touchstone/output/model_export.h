// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_model_export_h
#define touchstone_output_model_export_h

#include <touchstone/scene/scene.h>

#include <deal.II/base/mpi.h>

#include <string>

namespace Touchstone
{
  /**
   * @brief The discrete problem of a scene as JSON, for other programs: what
   * contrib/benchmark turns into decks of CalculiX.
   *
   * - `title`, `degree`, and of the reference solution `type`, `pair`, `values`;
   * - `nodes`: positions x, y, z, length; everything below counts nodes from 0;
   * - `bodies`: `name`, `element`, `law`, `young_modulus`, `poisson_ratio`, and `cells`,
   *   each with its 8 or 27 nodes in lexicographic order, x of the unit cell fastest;
   * - `pairs`: `name`, `behaviour`, `friction_coefficient`, the faces `slave` and
   *   `master`, each with its 4 or 9 nodes in lexicographic order such that the
   *   cross product of the face's axes points outward (empty for an obstacle);
   * - `steps`: each with its `time`, the prescribed `displacements` BOUNDARY: [node,
   *   direction x, y, z, value] by "BODY/BOUNDARY", where the component along the
   *   unit direction has the value, length; and the nodal `forces` [node, x, y, z].
   *
   * @param folder_of_scene For mesh files with relative names.
   * @param path            File that is written.
   * @throws InputError for a bad scene and on more than one rank; OutputError
   */
  void
  export_model(const Scene       &scene,
               const std::string &folder_of_scene,
               const std::string &path,
               MPI_Comm           communicator);
} // namespace Touchstone

#endif

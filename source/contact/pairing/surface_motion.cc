// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/surface_motion.h>

#include <deal.II/base/mpi.h>

namespace Touchstone
{
  using namespace dealii;

  SurfaceMotion::SurfaceMotion(const Surface &slave,
                               const Surface &master,
                               const MPI_Comm communicator)
    : slave(slave)
    , master(master)
    , communicator(communicator)
  {
  }



  bool
  SurfaceMotion::has_moved(const bool other_changes)
  {
    // Exact equality is meant: the first update of a step has the displacements of the last update
    // of the step before, and the integrals can be kept. All ranks must agree, since to integrate
    // is collective.
    std::vector<Tensor<1, dim>> now;
    for (const Surface *surface : {&slave, &master})
      for (const Face &face : surface->owned_faces())
        now.insert(now.end(),
                   face.displacement.begin(),
                   face.displacement.begin() + face.n_nodes());
    const bool same = now == present && !other_changes;
    present.swap(now);
    return Utilities::MPI::min(same ? 1 : 0, communicator) == 0;
  }



  bool
  SurfaceMotion::exceeds(const double distance)
  {
    // All nodes of this rank's slave and master faces are compared with where they were at the
    // last search. One rank alone cannot decide: a master face that moves on one rank may come
    // near a slave face of another.
    const double square = distance * distance;
    bool         close  = searched.size() == present.size();
    for (std::size_t i = 0; close && i < present.size(); ++i)
      close = (present[i] - searched[i]).norm_square() <= square;
    if (Utilities::MPI::min(close ? 1 : 0, communicator) == 1)
      return false;
    searched = present;
    return true;
  }



  void
  SurfaceMotion::forget_search()
  {
    searched.clear();
  }



  void
  SurfaceMotion::forget()
  {
    searched.clear();
    present.clear();
  }
} // namespace Touchstone

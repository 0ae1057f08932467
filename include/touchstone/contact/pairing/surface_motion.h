// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_surface_motion_h
#define touchstone_contact_pairing_surface_motion_h

#include <touchstone/contact/geometry/surface.h>

#include <vector>

namespace Touchstone
{
  /** @brief How the slave and the master surface of a pair have moved since its last update, and
   * since all facing faces were looked for last. All ranks get the same answers. */
  class SurfaceMotion
  {
  public:
    /** @param slave, master Must live as long. */
    SurfaceMotion(const Surface &slave, const Surface &master, MPI_Comm communicator);

    /** @brief Whether any face has moved since the last call. A step begins where the one before
     * has ended, and nothing need be integrated again. Collective.
     * @param other_changes Something else of this rank has changed, which counts as motion. */
    bool
    has_moved(bool other_changes);

    /** @brief Whether any node has moved by more than @p distance (length) since this was true
     * last; true the first time. Collective. */
    bool
    exceeds(double distance);

    /** @brief The next exceeds() is true. */
    void
    forget_search();

    /** @brief So is the next has_moved(). */
    void
    forget();

  private:
    const Surface &slave, &master;
    const MPI_Comm communicator;
    /** Displacements of the faces of this rank, slaves and then masters: at the last has_moved(),
     * if any, and when exceeds() was true last. */
    std::vector<dealii::Tensor<1, dim>> present, searched;
  };
} // namespace Touchstone

#endif

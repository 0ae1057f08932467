// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_verification_edge_fit_h
#define touchstone_verification_edge_fit_h

#include <deal.II/base/mpi.h>

#include <array>

namespace Touchstone
{
  /**
   * @brief Where a traction that falls like sqrt(1 - r^2/a^2) vanishes.
   *
   * The nodes resolve the edge of a contact no better than their distance, but
   * the square of such a traction falls linearly with r^2 and so tells where it
   * vanishes: the least-squares line through all nodes.
   */
  class EdgeFit
  {
  public:
    /** @brief Take a node into account.
     * @param area     Its weight.
     * @param r        Its distance from the middle of the contact, length.
     * @param traction Force per area. */
    void
    add(double area, double r, double traction);

    /** @brief The edge a, length. Collective.
     * @param fallback Taken where there is no line to be fitted, as with a
     *                 single ring of nodes. */
    double
    edge(MPI_Comm communicator, double fallback) const;

  private:
    /** Moments of the line: weight, r^2, r^4, t^2, r^2 t^2. */
    std::array<double, 5> sums = {{0., 0., 0., 0., 0.}};
  };
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_interruption_h
#define touchstone_base_interruption_h

#include <deal.II/base/mpi.h>

#include <stdexcept>

namespace Touchstone
{
  /**
   * @brief A signal asks the run to end: SIGINT (Ctrl-C), SIGTERM, or SIGUSR1, which batch systems
   * send ahead of a time limit and mpirun passes on to all ranks.
   *
   * The run ends at the next iteration of Newton's method or cycle of explicit dynamics, with the
   * last converged state on disk. No NonConvergence, since nothing is wrong with the step.
   */
  class Interruption : public std::runtime_error
  {
  public:
    explicit Interruption(int signal);

    /** @brief From now on the first of these signals is only noted. A second one of its kind ends
     * the program at once, as without this class. For programs that call pending() or check(); a
     * library that others link to leaves their signals alone. */
    static void
    listen();

    /** @brief The signal that this rank has received, or 0. */
    static int
    pending();

    /** @brief Collective. @throws Interruption on all ranks if any has received a signal. */
    static void
    check(MPI_Comm communicator);
  };
} // namespace Touchstone

#endif

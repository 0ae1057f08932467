// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/interruption.h>

#include <csignal>
#include <initializer_list>
#include <string>

namespace Touchstone
{
  namespace
  {
    // All that a signal handler may write to.
    volatile std::sig_atomic_t received = 0;

    extern "C" void
    note_signal(const int signal)
    {
      received = signal;
    }

    std::string
    name_of(const int signal)
    {
      switch (signal)
        {
          case SIGINT:
            return "SIGINT";
          case SIGTERM:
            return "SIGTERM";
          case SIGUSR1:
            return "SIGUSR1";
          default:
            return std::to_string(signal);
        }
    }
  } // namespace



  Interruption::Interruption(const int signal)
    : std::runtime_error("ended by the signal " + name_of(signal))
  {
  }



  void
  Interruption::listen()
  {
    struct sigaction action = {};
    action.sa_handler       = note_signal;
    sigemptyset(&action.sa_mask);
    // Calls of the system go on after the signal; the handler is good for one.
    action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
    for (const int signal : {SIGINT, SIGTERM, SIGUSR1})
      sigaction(signal, &action, nullptr);
  }



  int
  Interruption::pending()
  {
    return received;
  }



  void
  Interruption::check(const MPI_Comm communicator)
  {
    // Not all ranks receive it, and not at the same moment.
    const int signal = dealii::Utilities::MPI::max(pending(), communicator);
    if (signal != 0)
      throw Interruption(signal);
  }
} // namespace Touchstone

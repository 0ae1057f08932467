// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_free_memory_h
#define touchstone_base_free_memory_h

#include <cstdlib>
#ifdef __GLIBC__
#  include <malloc.h>
#endif

namespace Touchstone
{
  /** @brief Give memory that has been freed back to the system, also between memory that is in use:
   * malloc itself gives back what is at the end, so that the temporaries of one part of a run, of
   * many small pieces, would add to those of another that needs large ones. Takes some
   * milliseconds a hundred megabytes. */
  inline void
  give_back_free_memory()
  {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
  }
} // namespace Touchstone

#endif

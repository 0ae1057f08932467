// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_search_search_work_h
#define touchstone_contact_search_search_work_h

#include <cstdint>

namespace Touchstone
{
  /** @brief Amount of work of the searches so far, on this rank. */
  struct SearchWork
  {
    /** Faces on which a point was projected, which were tested for a crossing, or which were
     * candidates for a slave face. */
    std::uint64_t candidates = 0;
    /** Other ranks that master faces were sent to, and those faces. */
    std::uint64_t messages = 0, faces_sent = 0;

    SearchWork &
    operator+=(const SearchWork &other)
    {
      candidates += other.candidates;
      messages += other.messages;
      faces_sent += other.faces_sent;
      return *this;
    }
  };
} // namespace Touchstone

#endif

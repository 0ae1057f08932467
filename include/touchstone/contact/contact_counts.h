// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_contact_counts_h
#define touchstone_contact_contact_counts_h

#include <touchstone/contact/search/search_work.h>

#include <cstdint>

namespace Touchstone
{
  class Contact;

  /** @brief Contact work of a rank, in counts that do not depend on the machine. */
  struct ContactCounts
  {
    std::uint64_t slave_rows = 0, master_faces = 0;
    SearchWork    search;
  };

  /** @brief Counts of this rank so far. */
  ContactCounts
  contact_counts(const Contact &contact);
} // namespace Touchstone

#endif

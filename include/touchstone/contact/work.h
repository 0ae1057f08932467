#ifndef touchstone_contact_work_h
#define touchstone_contact_work_h

#include <touchstone/contact/search/face_exchange.h>

#include <cstdint>

namespace Touchstone
{
  class Contact;

  /** @brief Contact work of a rank, in counts that do not depend on the machine. */
  struct ContactWork
  {
    std::uint64_t slave_rows = 0, master_faces = 0;
    SearchWork    search;
  };

  /** @brief Counts of this rank so far. */
  ContactWork
  contact_work(const Contact &contact);
} // namespace Touchstone

#endif

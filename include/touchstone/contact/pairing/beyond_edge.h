// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_beyond_edge_h
#define touchstone_contact_pairing_beyond_edge_h

namespace Touchstone
{
  /**
   * @brief What holds a slave node that has come over a sharp edge of the face that it lies on,
   * where its own edge fits on that of the master: a row with the normal of the master or of the
   * slave, as the pairing has it on the face, or nothing (doc/theory.md 4.2, "Flush edges").
   */
  enum class BeyondEdge
  {
    free,
    along_master_normal,
    along_slave_normal
  };
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_master_normal_h
#define touchstone_contact_geometry_master_normal_h

namespace Touchstone
{
  /** @brief Where the normal of a row comes from, and what the gap is measured to. */
  enum class MasterNormal
  {
    /** The face at the contact point. */
    face,
    /** Interpolation of the averaged normals of its nodes. */
    averaged,
    /** A smooth patch over the face, to which the gap is measured as well. */
    smoothed
  };
} // namespace Touchstone

#endif

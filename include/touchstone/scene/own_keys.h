// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_scene_own_keys_h
#define touchstone_scene_own_keys_h

#include <iosfwd>

namespace Touchstone
{
  /** @brief The keys that registered classes have of their own, with their documentation, all
   * classes of each kind: a scene has only those of the classes that it chooses. Each class is a
   * subsection, "Body NAME/Material with Law = Gent". For doc/parameters.md. */
  void
  print_own_keys(std::ostream &out);
} // namespace Touchstone

#endif

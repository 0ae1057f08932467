// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_place_in_words_h
#define touchstone_contact_place_in_words_h

#include <touchstone/base/types.h>

#include <deal.II/base/point.h>

#include <string>

namespace Touchstone
{
  /** @brief A position for messages, with components that are only round-off set to zero. */
  std::string
  place_in_words(const dealii::Point<dim> &x);
} // namespace Touchstone

#endif

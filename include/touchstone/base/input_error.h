// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_input_error_h
#define touchstone_base_input_error_h

#include <stdexcept>
#include <string>

namespace Touchstone
{
  /**
   * @brief Bad input, found before the run starts.
   *
   * The message names the section and key of the scene file, the value found
   * there, what is wrong with it, and what the user can do about it.
   */
  class InputError : public std::runtime_error
  {
  public:
    /**
     * @param section Path of the subsection, e.g. "Body inner/Material"; empty
     *                for the top level.
     * @param key     Key of the entry; empty if the section as a whole is meant.
     * @param value   The offending value as the user wrote it.
     * @param problem What is wrong, as a sentence.
     * @param remedy  What to do, as a sentence.
     */
    InputError(const std::string &section,
               const std::string &key,
               const std::string &value,
               const std::string &problem,
               const std::string &remedy);
  };
} // namespace Touchstone

#endif

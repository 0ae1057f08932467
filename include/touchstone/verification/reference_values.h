// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_verification_reference_values_h
#define touchstone_verification_reference_values_h

#include <map>
#include <set>
#include <string>

namespace Touchstone
{
  /**
   * @brief The named numbers "name: number, name: number" of the key "Values" in the section
   * "Reference solution".
   *
   * Readers call finish() at the end, which throws for names that have not been read.
   */
  class ReferenceValues
  {
  public:
    /** @throws InputError if the text is not of this form. */
    explicit ReferenceValues(const std::string &text);

    bool
    has(const std::string &name) const;

    /** @throws InputError if there is no such name. */
    double
    number(const std::string &name);

    /** @brief Like number(), but must be positive. @throws InputError */
    double
    positive_number(const std::string &name);

    double
    number(const std::string &name, double default_value);

    /** @throws InputError in the name of this key with the given problem. */
    [[noreturn]] void
    fail(const std::string &problem, const std::string &remedy) const;

    /** @throws InputError if there are names that have not been read. */
    void
    finish() const;

  private:
    const std::string             text;
    std::map<std::string, double> values;
    /** Names that have been read, whether present or not. */
    std::set<std::string> known;
  };
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_statistics_csv_h
#define touchstone_output_statistics_csv_h

#include <touchstone/output/step_quantity.h>

#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>
#include <map>
#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief The fewest digits that read back to the same number, whatever the locale. */
  std::string
  all_digits(double value);

  /**
   * @brief The table `statistics.csv`: the columns of `statistics` under names of one word with
   * their units, "fit.force_x[force]", and a row for the state that the run starts from.
   *
   * Units are those of a scene: length, time, force and what is made of them. A cell is empty where
   * a step has no such value.
   */
  class StatisticsCsv
  {
  public:
    /** @brief Begin a row. */
    void
    begin_row();

    /** @brief Add a value to the row. */
    void
    add(const StepValue &value);

    /** @brief The table as text. */
    std::string
    text() const;

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &columns &rows;
    }

  private:
    std::vector<std::string>                   columns;
    std::vector<std::map<std::string, double>> rows;
  };
} // namespace Touchstone

#endif

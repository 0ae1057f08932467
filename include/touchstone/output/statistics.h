// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_statistics_h
#define touchstone_output_statistics_h

#include <touchstone/base/folder.h>
#include <touchstone/output/statistics_csv.h>
#include <touchstone/output/step_quantity.h>

#include <deal.II/base/table_handler.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Touchstone
{
  /**
   * @brief The table `statistics`: a row for each converged step, with the columns of all
   * registered StepQuantity classes.
   *
   * The columns are described in lines that begin with '#', so that gnuplot and
   * numpy.loadtxt read the file as it is.
   */
  class Statistics
  {
  public:
    /** @param folder Must outlive this object. */
    explicit Statistics(const OutputFolder &folder);

    /** @brief Add a row and write the file. Collective; the values of rank 0
     * count. @throws OutputError */
    void
    add_step(const ConvergedStep &step);

    /** @brief Add the row of the state that the run starts from to `statistics.csv`. The table
     * `statistics` has none, as ever: programs count its rows. Collective. */
    void
    add_start(const ConvergedStep &start);

    /** @brief Values of the last step for summary.json. */
    const std::vector<StepValue> &
    for_summary() const
    {
      return last_values;
    }

    /** @name For checkpoints
     * The table as it is, the memory of the quantities by their names, and for_summary(). */
    /** @{ */
    using Memories = std::map<std::string, StepQuantity::Memory>;

    const dealii::TableHandler &
    rows() const
    {
      return table;
    }

    const StatisticsCsv &
    csv_rows() const
    {
      return csv;
    }
    Memories
    memories() const;

    /** @brief Continue from what was saved. Collective; that of rank 0 counts.
     * @throws OutputError */
    void
    restore(const dealii::TableHandler   &rows,
            const StatisticsCsv          &csv_rows,
            const Memories               &memories,
            const std::vector<StepValue> &last_values);
    /** @} */

  private:
    const OutputFolder  &folder;
    dealii::TableHandler table;
    StatisticsCsv        csv;
    /** By name, in the order of their columns. */
    std::vector<std::pair<std::string, std::shared_ptr<StepQuantity>>> quantities;
    std::vector<StepValue>                                             last_values;

    /** @brief Add a value with the format of all real numbers of the table. */
    void
    add(const std::string &column, double value);

    void
    add(const StepValue &value);

    void
    write() const;
  };
} // namespace Touchstone

#endif

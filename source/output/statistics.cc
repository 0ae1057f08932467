// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/statistics.h>

#include <algorithm>
#include <sstream>

namespace Touchstone
{
  Statistics::Statistics(const OutputFolder &folder)
    : folder(folder)
  {
    // A column that appears later, of a pair or energy, has empty cells in earlier rows.
    table.set_auto_fill_mode(true);
    for (const std::string &name : StepQuantityRegistry::names())
      quantities.emplace_back(name, StepQuantityRegistry::make(name));
    std::stable_sort(quantities.begin(), quantities.end(), [](const auto &a, const auto &b) {
      return a.second->order() < b.second->order();
    });
  }



  void
  Statistics::add(const std::string &column, const double value)
  {
    // All digits: files that are the same hold the same bits, and conservation shows to round-off.
    table.add_value(column, value);
    table.set_precision(column, 16);
    table.set_scientific(column, true);
  }



  void
  Statistics::add(const StepValue &value)
  {
    // Columns of a pair begin with its name; vectors have three columns.
    const std::string column = value.pair.empty() ? value.name : value.pair + ": " + value.name;
    if (value.kind == StepValue::count)
      table.add_value(column, static_cast<unsigned int>(value.components[0]));
    else if (value.kind == StepValue::number)
      add(column, value.components[0]);
    else
      for (unsigned int d = 0; d < dim; ++d)
        add(column + ' ' + "xyz"[d], value.components[d]);
  }



  void
  Statistics::add_start(const ConvergedStep &start)
  {
    csv.begin_row();
    for (const auto &[name, quantity] : quantities)
      if (quantity->at_start())
        {
          StepValues values;
          quantity->evaluate(start, values);
          for (const StepValue &value : values.entries)
            csv.add(value);
        }
    // Also for a run that ends in its first step, and in place of the tables of an earlier run.
    write();
  }



  void
  Statistics::add_step(const ConvergedStep &step)
  {
    last_values.clear();
    csv.begin_row();
    for (const auto &[name, quantity] : quantities)
      {
        StepValues values;
        quantity->evaluate(step, values); // collective, though only rank 0 writes
        for (const StepValue &value : values.entries)
          {
            if (folder.rank == 0)
              add(value);
            csv.add(value);
          }
        // The summary has the values of the last step.
        if (quantity->in_summary())
          last_values.insert(last_values.end(), values.entries.begin(), values.entries.end());
      }
    write();
  }



  Statistics::Memories
  Statistics::memories() const
  {
    Memories result;
    for (const auto &[name, quantity] : quantities)
      // Quantities that accumulate over steps are part of a checkpoint.
      if (const StepQuantity::Memory memory = quantity->memory(); !memory.empty())
        result[name] = memory;
    return result;
  }



  void
  Statistics::restore(const dealii::TableHandler   &rows,
                      const StatisticsCsv          &csv_rows,
                      const Memories               &memories,
                      const std::vector<StepValue> &values)
  {
    // The rows of the earlier run, then write(): the file on disk may have steps after the
    // checkpoint.
    table       = rows;
    csv         = csv_rows;
    last_values = values;
    for (const auto &[name, quantity] : quantities)
      if (const auto memory = memories.find(name); memory != memories.end())
        quantity->restore(memory->second);
    write();
  }



  void
  Statistics::write() const
  {
    std::ostringstream text;
    if (folder.rank == 0)
      table.write_text(text, dealii::TableHandler::table_with_separate_column_description);
    // The whole table is written after each step: a run that dies leaves a complete file.
    folder.write_file_atomically("statistics", text.str());
    folder.write_file_atomically("statistics.csv", csv.text());
  }
} // namespace Touchstone

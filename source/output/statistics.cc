#include <touchstone/output/statistics.h>

#include <sstream>

namespace Touchstone
{
  Statistics::Statistics(const OutputFolder &folder)
    : folder(folder)
  {
    // A pair or energy that turns up later gets empty cells in the rows before.
    table.set_auto_fill_mode(true);
  }



  void
  Statistics::add(const std::string &column, const double value)
  {
    table.add_value(column, value);
    table.set_precision(column, 8);
    table.set_scientific(column, true);
  }



  void
  Statistics::add(const std::string &column, const dealii::Tensor<1, dim> &value)
  {
    const char *const components[dim] = {" x", " y", " z"};
    for (unsigned int d = 0; d < dim; ++d)
      add(column + components[d], value[d]);
  }



  void
  Statistics::add_step(const StepRecord &record)
  {
    if (folder.rank == 0)
      {
        table.add_value("step", record.step);
        add("time", record.time);
        add("step size", record.step_size);
        table.add_value("Newton iterations", record.newton_iterations);
        table.add_value("linear iterations", record.linear_iterations);
        table.add_value("cuts", record.cuts);
        for (const auto &[name, result] : record.pairs)
          {
            add(name + ": force", result.force);
            add(name + ": moment", result.moment);
            add(name + ": area", result.area);
            add(name + ": max pressure", result.max_pressure);
            add(name + ": max penetration", result.max_penetration);
            table.add_value(name + ": active nodes", result.active);
            table.add_value(name + ": stick nodes", result.stick);
            table.add_value(name + ": slip nodes", result.slip);
          }
        for (const auto &[name, force] : record.reactions)
          add(name + ": reaction", force);
        for (const auto &[name, energy] : record.energies)
          add("energy: " + name, energy);
        if (record.momentum)
          {
            add("momentum", *record.momentum);
            add("angular momentum", *record.angular_momentum);
          }
      }
    write();
  }



  void
  Statistics::restore(const dealii::TableHandler &rows)
  {
    table = rows;
    write();
  }



  void
  Statistics::write() const
  {
    std::ostringstream text;
    if (folder.rank == 0)
      table.write_text(text, dealii::TableHandler::table_with_separate_column_description);
    folder.write_file_atomically("statistics", text.str());
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/file_series.h>
#include <touchstone/output/vtu_series.h>
#include <touchstone/output/xdmf_series.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <filesystem>
#include <regex>
#include <system_error>

namespace Touchstone
{
  std::unique_ptr<FileSeries>
  FileSeries::make(const ResultFormat format, const OutputFolder &folder, const std::string &name)
  {
    if (format == ResultFormat::xdmf)
      return std::make_unique<XdmfSeries>(folder, name);
    return std::make_unique<VtuSeries>(folder, name);
  }



  FileSeries::FileSeries(const OutputFolder &folder, const std::string &name)
    : folder(folder)
    , name(name)
  {
  }



  double
  FileSeries::rest(const double value)
  {
    const double held = static_cast<float>(value);
    return std::isfinite(held) ? value - held : 0.;
  }



  std::string
  FileSeries::stem(const unsigned int step) const
  {
    return name + "_" + dealii::Utilities::int_to_string(step, 4);
  }



  void
  FileSeries::add(const double time, const std::string &entry)
  {
    entries.emplace_back(time, entry);
    write_list();
  }



  void
  FileSeries::restore(const List &before)
  {
    // A resumed run continues the series: steps after the checkpoint are written again and not
    // listed twice.
    entries = before;
    if (!before.empty())
      write_list();
  }



  void
  FileSeries::remove_earlier_run(const unsigned int first_step) const
  {
    namespace fs = std::filesystem;
    // Nothing else in the folder is touched: it may hold what the user has put there.
    const std::regex of_step(name + R"(_(\d{4,9})(\.\d+)?\.(vtu|pvtu|h5)(\.part)?)"),
      list_of_steps(name + R"(\.(pvd|xdmf)(\.part)?)");
    folder.remove_earlier([&](const fs::directory_entry &entry) {
      const std::string file = entry.path().filename().string();
      std::smatch       parts;
      std::error_code   gone;
      return entry.symlink_status(gone).type() == fs::file_type::regular &&
             (std::regex_match(file, parts, of_step)
                ? std::stoul(parts[1]) >= first_step
                : first_step == 0 && std::regex_match(file, list_of_steps));
    });
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/vtu_series.h>

#include <deal.II/base/utilities.h>

namespace Touchstone
{
  VtuSeries::VtuSeries(const OutputFolder &folder, const std::string &name)
    : folder(folder)
    , name(name)
  {
  }



  std::string
  VtuSeries::stem(const unsigned int step) const
  {
    return name + "_" + dealii::Utilities::int_to_string(step, 4);
  }



  std::vector<std::string>
  VtuSeries::piece_names(const unsigned int step) const
  {
    // One file per rank, numbered by rank, as the .pvtu record lists them.
    std::vector<std::string> names;
    for (unsigned int rank = 0; rank < folder.n_ranks; ++rank)
      names.push_back(stem(step) + "." + std::to_string(rank) + ".vtu");
    return names;
  }



  void
  VtuSeries::write(const std::string &piece,
                   const std::string &record,
                   const unsigned int step,
                   const double       time)
  {
    // One rank writes one .vtu file; several write one piece each, and rank 0 the .pvtu record that
    // names them.
    const bool        serial = (folder.n_ranks == 1);
    const std::string file   = stem(step) + (serial ? ".vtu" : ".pvtu");

    folder.write_pieces_atomically(serial ? file : piece_names(step)[folder.rank], piece);
    if (!serial)
      folder.write_file_atomically(file, record);

    // The list of the series comes last, so that it names only files that exist, also if the run
    // dies here.
    times_and_names.emplace_back(time, file);
    write_list();
  }



  void
  VtuSeries::restore(const List &before)
  {
    // A resumed run continues the series: steps after the checkpoint are written again and not
    // listed twice.
    times_and_names = before;
    if (!before.empty())
      write_list();
  }



  void
  VtuSeries::write_list() const
  {
    std::ostringstream list;
    dealii::DataOutBase::write_pvd_record(list, times_and_names);
    folder.write_file_atomically(name + ".pvd", list.str());
  }
} // namespace Touchstone

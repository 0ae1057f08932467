// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/vtu_series.h>

#include <sstream>

namespace Touchstone
{
  VtuSeries::VtuSeries(const OutputFolder &folder, const std::string &name)
    : FileSeries(folder, name)
  {
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
  VtuSeries::write(PatchGroups &data, const unsigned int step, const double time)
  {
    // Each group is a piece of its own in the file. Of 8,192 points the patches, the arrays and
    // their text stay in the cache, and the file never is in memory as a whole.
    constexpr std::size_t n_points = 1 << 13;
    const auto            names    = data.get_dataset_names();
    const auto            ranges   = data.get_nonscalar_data_ranges();
    auto                  flags    = data.flags;
    bool                  begun = false, ended = false;
    const auto            next_part = [&]() -> std::string {
      std::ostringstream part;
      if (ended)
        return "";
      if (!begun)
        dealii::DataOutBase::write_vtu_header(part, flags);
      data.make_next(n_points / data.n_points_per_cell());
      dealii::DataOutBase::write_vtu_main(data.get_patches(), names, ranges, flags, part);
      // The time is said once.
      flags.time  = dealii::DataOutBase::VtkFlags().time;
      flags.cycle = dealii::DataOutBase::VtkFlags().cycle;
      begun       = true;
      ended       = data.finished();
      if (ended)
        dealii::DataOutBase::write_vtu_footer(part);
      return part.str();
    };
    std::ostringstream record;
    if (folder.rank == 0)
      dealii::DataOutBase::write_pvtu_record(record, piece_names(step), names, ranges, flags);
    write_texts(next_part, record.str(), step, time);
  }



  void
  VtuSeries::write(const dealii::DataOutInterface<2, 3> &data,
                   const unsigned int                    step,
                   const double                          time)
  {
    write_patches(data, step, time);
  }



  void
  VtuSeries::write(const dealii::DataOutInterface<0, 3> &data,
                   const unsigned int                    step,
                   const double                          time)
  {
    write_patches(data, step, time);
  }



  template <int patch_dim>
  void
  VtuSeries::write_patches(const dealii::DataOutInterface<patch_dim, 3> &data,
                           const unsigned int                            step,
                           const double                                  time)
  {
    std::ostringstream piece, record;
    data.write_vtu(piece);
    if (folder.rank == 0)
      data.write_pvtu_record(record, piece_names(step));
    write_texts(whole(piece.str()), record.str(), step, time);
  }



  void
  VtuSeries::write_texts(const TextInParts &piece,
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
    add(time, file);
  }



  void
  VtuSeries::write_list() const
  {
    std::ostringstream text;
    dealii::DataOutBase::write_pvd_record(text, list());
    folder.write_file_atomically(list_name(), text.str());
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_vtu_series_h
#define touchstone_output_vtu_series_h

#include <touchstone/base/folder.h>

#include <deal.II/base/data_out_base.h>

#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace Touchstone
{
  /**
   * @brief The files of a sequence of VTU files: NAME_0007.vtu (serial), or
   * NAME_0007.pvtu with one file NAME_0007.RANK.vtu for each rank, and NAME.pvd
   * that says which file belongs to which time.
   *
   * deal.II's own write_vtu_with_pvtu_record() leaves the other ranks waiting if
   * the disk is full for one of them.
   */
  class VtuSeries
  {
  public:
    /** @param folder Must outlive this object.
     * @param name   Common beginning of the file names. */
    VtuSeries(const OutputFolder &folder, const std::string &name);

    /** @brief Write the file of one step; its flags are set by the caller.
     * Collective. @throws OutputError */
    template <int patch_dim>
    void
    write(const dealii::DataOutInterface<patch_dim, 3> &data,
          const unsigned int                            step,
          const double                                  time)
    {
      std::ostringstream piece, record;
      data.write_vtu(piece);
      if (folder.rank == 0)
        data.write_pvtu_record(record, piece_names(step));
      write(piece.str(), record.str(), step, time);
    }

    /** @brief Times and file names so far. */
    using List = std::vector<std::pair<double, std::string>>;

    const List &
    list() const
    {
      return times_and_names;
    }

    /** @brief Continue after files that were written before. Collective.
     * @throws OutputError */
    void
    restore(const List &before);

  private:
    const OutputFolder &folder;
    const std::string   name;
    List                times_and_names;

    void
    write_list() const;

    std::string
    stem(unsigned int step) const;

    std::vector<std::string>
    piece_names(unsigned int step) const;

    void
    write(const std::string &piece, const std::string &record, unsigned int step, double time);
  };
} // namespace Touchstone

#endif

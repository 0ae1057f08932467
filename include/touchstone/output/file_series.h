// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_file_series_h
#define touchstone_output_file_series_h

#include <touchstone/base/folder.h>
#include <touchstone/output/output_parameters.h>
#include <touchstone/output/patch_groups.h>

#include <deal.II/base/data_out_base.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Touchstone
{
  /**
   * @brief The files of a sequence of results over time, of some format, and a list that says
   * which file belongs to which time.
   *
   * Formats are derived classes; what is written are the patches of deal.II.
   */
  class FileSeries
  {
  public:
    /** @brief Times, and what stands in the list about each of them. */
    using List = std::vector<std::pair<double, std::string>>;

    /** @brief A series of this format.
     * @param folder Must outlive the series.
     * @param name   Common beginning of the file names. */
    static std::unique_ptr<FileSeries>
    make(ResultFormat format, const OutputFolder &folder, const std::string &name);

    virtual ~FileSeries() = default;

    /** @name Write the file of one step; its flags are set by the caller
     * Solids (of which no cell has had its turn), surfaces and clouds of points. Collective.
     * @throws OutputError */
    /** @{ */
    virtual void
    write(PatchGroups &data, unsigned int step, double time) = 0;
    virtual void
    write(const dealii::DataOutInterface<2, 3> &data, unsigned int step, double time) = 0;
    virtual void
    write(const dealii::DataOutInterface<0, 3> &data, unsigned int step, double time) = 0;
    /** @} */

    /** @brief Whether nine components can be joined to a tensor. */
    virtual bool
    has_tensors() const = 0;

    /** @brief Whether numbers are written in double precision. deal.II's patches hold them in
     * single precision: what that leaves of them goes beside them, under the name rest_name(). */
    virtual bool
    has_doubles() const = 0;

    static std::string
    rest_name(const std::string &name)
    {
      return name + "(rest)";
    }

    /** @brief What single precision leaves of a number, zero where it is too large for it. */
    static double
    rest(double value);

    const List &
    list() const
    {
      return entries;
    }

    /** @brief Continue after files that were written before. Collective.
     * @throws OutputError */
    void
    restore(const List &before);

    /** @brief Remove the files of steps that an earlier run has left in the folder, of any number
     * of ranks and in any format: viewers and scripts would take them for results of this run.
     * Those of earlier steps than @p first_step stay, and with them the list. Collective.
     * @throws OutputError */
    void
    remove_earlier_run(unsigned int first_step) const;

    /** @brief Name of the file with the list. */
    virtual std::string
    list_name() const = 0;

  protected:
    FileSeries(const OutputFolder &folder, const std::string &name);

    const OutputFolder &folder;
    const std::string   name;

    /** @brief Name of the files of a step, without its ending. */
    std::string
    stem(unsigned int step) const;

    /** @brief Add to the list and write it: last, so that it names only files that exist, also if
     * the run dies here. */
    void
    add(double time, const std::string &entry);

    /** @brief Write the file with the list. */
    virtual void
    write_list() const = 0;

  private:
    List entries;
  };
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_vtu_series_h
#define touchstone_output_vtu_series_h

#include <touchstone/output/file_series.h>

#include <string>
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
  class VtuSeries : public FileSeries
  {
  public:
    /** @param folder Must outlive this object.
     * @param name   Common beginning of the file names. */
    VtuSeries(const OutputFolder &folder, const std::string &name);

    void
    write(PatchGroups &data, unsigned int step, double time) override;
    void
    write(const dealii::DataOutInterface<2, 3> &data, unsigned int step, double time) override;
    void
    write(const dealii::DataOutInterface<0, 3> &data, unsigned int step, double time) override;

    std::string
    list_name() const override
    {
      return name + ".pvd";
    }

    bool
    has_tensors() const override
    {
      return true;
    }

    bool
    has_doubles() const override
    {
      return false;
    }

  private:
    template <int patch_dim>
    void
    write_patches(const dealii::DataOutInterface<patch_dim, 3> &data,
                  unsigned int                                  step,
                  double                                        time);

    void
    write_list() const override;

    std::vector<std::string>
    piece_names(unsigned int step) const;

    void
    write_texts(const TextInParts &piece,
                const std::string &record,
                unsigned int       step,
                double             time);
  };
} // namespace Touchstone

#endif

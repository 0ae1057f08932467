// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_xdmf_series_h
#define touchstone_output_xdmf_series_h

#include <touchstone/output/file_series.h>

#include <string>

namespace Touchstone
{
  /**
   * @brief The files of a sequence of HDF5 files, NAME_0007.h5, which all ranks write together,
   * and NAME.xdmf, which says where in them the mesh and the fields of each time are.
   *
   * Numbers have double precision, put together from what patches hold of them (14 digits);
   * positions of nodes that are no vertices, single. deal.II writes scalars and vectors, of tensors
   * only the first three components, and cells of degree 2 as eight of degree 1.
   */
  class XdmfSeries : public FileSeries
  {
  public:
    /** @param folder Must outlive this object.
     * @param name   Common beginning of the file names. */
    XdmfSeries(const OutputFolder &folder, const std::string &name);

    void
    write(PatchGroups &data, unsigned int step, double time) override;
    void
    write(const dealii::DataOutInterface<2, 3> &data, unsigned int step, double time) override;
    void
    write(const dealii::DataOutInterface<0, 3> &data, unsigned int step, double time) override;

    std::string
    list_name() const override
    {
      return name + ".xdmf";
    }

    bool
    has_tensors() const override
    {
      return false;
    }

    bool
    has_doubles() const override
    {
      return true;
    }

  private:
    template <int patch_dim>
    void
    write_patches(const dealii::DataOutInterface<patch_dim, 3> &data,
                  unsigned int                                  step,
                  double                                        time);

    void
    write_list() const override;
  };
} // namespace Touchstone

#endif

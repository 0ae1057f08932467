// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/xdmf_series.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/reference_cell.h>

#include <filesystem>
#include <system_error>

namespace Touchstone
{
  namespace
  {
    /** Number of patches of this rank, which deal.II shows to derived classes only. */
    template <int patch_dim>
    std::size_t
    n_patches(const dealii::DataOutInterface<patch_dim, 3> &data)
    {
      struct Access : public dealii::DataOutInterface<patch_dim, 3>
      {
        static std::size_t
        count(const dealii::DataOutInterface<patch_dim, 3> &data)
        {
          return (data.*&Access::get_patches)().size();
        }
      };
      return Access::count(data);
    }



    /** The ranks that take part in something, as long as this lives. Collective. */
    class PartOfRanks
    {
    public:
      PartOfRanks(const bool takes_part, const OutputFolder &folder)
      {
        const int error = MPI_Comm_split(folder.communicator,
                                         takes_part ? 0 : MPI_UNDEFINED,
                                         static_cast<int>(folder.rank),
                                         &communicator);
        AssertThrowMPI(error);
      }

      ~PartOfRanks()
      {
        if (communicator != MPI_COMM_NULL)
          MPI_Comm_free(&communicator);
      }

      PartOfRanks(const PartOfRanks &) = delete;

      /** Null on ranks that take no part. */
      MPI_Comm communicator = MPI_COMM_NULL;
    };
  } // namespace



  XdmfSeries::XdmfSeries(const OutputFolder &folder, const std::string &name)
    : FileSeries(folder, name)
  {
  }



  void
  XdmfSeries::write(const dealii::DataOutInterface<3, 3> &data,
                    const unsigned int                    step,
                    const double                          time)
  {
    write_patches(data, step, time);
  }



  void
  XdmfSeries::write(const dealii::DataOutInterface<2, 3> &data,
                    const unsigned int                    step,
                    const double                          time)
  {
    write_patches(data, step, time);
  }



  void
  XdmfSeries::write(const dealii::DataOutInterface<0, 3> &data,
                    const unsigned int                    step,
                    const double                          time)
  {
    write_patches(data, step, time);
  }



  template <int patch_dim>
  void
  XdmfSeries::write_patches(const dealii::DataOutInterface<patch_dim, 3> &data,
                            const unsigned int                            step,
                            const double                                  time)
  {
    // Nodes stay apart where cells meet: merged by their places, those of two bodies that touch
    // would become one.
    dealii::DataOutBase::DataOutFilter filter(
      dealii::DataOutBase::DataOutFilterFlags(/*filter_duplicate_vertices=*/false,
                                              /*xdmf_hdf5_output=*/true));
    const std::string file = stem(step) + ".h5", part = file + ".part";
    std::string       entry;
    // deal.II 9.4 fails on ranks that have nothing to write, as most have of small surfaces.
    const PartOfRanks writers(n_patches(data) > 0, folder);
    folder.together([&] {
      if (writers.communicator == MPI_COMM_NULL)
        return;
      try
        {
          data.write_filtered_data(filter);
          data.write_hdf5_parallel(filter, folder.path(part), writers.communicator);
          entry = data.create_xdmf_entry(filter, file, time, writers.communicator)
                    .get_xdmf_content(3, dealii::ReferenceCells::get_hypercube<patch_dim>());
        }
      catch (const dealii::ExceptionBase &)
        {
          throw OutputError(folder.path(file),
                            "HDF5 reports an error",
                            "Is the disk full? Free space, write fewer pictures (\"Output/VTU "
                            "interval\"), or choose another folder with --output DIR.");
        }
      std::error_code failure;
      if (dealii::Utilities::MPI::this_mpi_process(writers.communicator) == 0)
        std::filesystem::rename(folder.path(part), folder.path(file), failure);
      if (failure)
        throw OutputError(folder.path(file), failure.message(), "Check the folder.");
    });
    // The first rank that has any cells knows the entry; checkpoints want it on all.
    for (const std::string &text : dealii::Utilities::MPI::all_gather(folder.communicator, entry))
      if (!text.empty())
        {
          add(time, text);
          return;
        }
  }



  void
  XdmfSeries::write_list() const
  {
    std::string text = "<?xml version=\"1.0\" ?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n"
                       "<Xdmf Version=\"2.0\">\n  <Domain>\n    <Grid Name=\"" +
                       name + "\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
    for (const auto &[time, grid] : list())
      text += grid;
    text += "    </Grid>\n  </Domain>\n</Xdmf>\n";
    folder.write_file_atomically(name + ".xdmf", text);
  }
} // namespace Touchstone

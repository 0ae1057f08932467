// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/xdmf_series.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/table.h>
#include <deal.II/grid/reference_cell.h>

#include <filesystem>
#include <limits>
#include <map>
#include <system_error>

namespace Touchstone
{
  namespace
  {
    /** What deal.II shows of its data to derived classes only. */
    template <int patch_dim>
    struct Access : public dealii::DataOutInterface<patch_dim, 3>
    {
      using Data = dealii::DataOutInterface<patch_dim, 3>;

      static const std::vector<dealii::DataOutBase::Patch<patch_dim, 3>> &
      patches(const Data &data)
      {
        return (data.*&Access::get_patches)();
      }

      static std::vector<std::string>
      names(const Data &data)
      {
        return (data.*&Access::get_dataset_names)();
      }

      static auto
      ranges(const Data &data)
      {
        return (data.*&Access::get_nonscalar_data_ranges)();
      }
    };



    /** Points and cells of the patches, without fields. */
    template <int patch_dim>
    void
    add_mesh(const std::vector<dealii::DataOutBase::Patch<patch_dim, 3>> &patches,
             dealii::DataOutBase::DataOutFilter                          &filter)
    {
      auto bare = patches;
      for (auto &patch : bare)
        {
          // Positions that are available are the last rows.
          const unsigned int n_rows = patch.points_are_available ? 3 : 0;
          const auto         all    = patch.data;
          patch.data.reinit(n_rows, all.n_cols());
          for (unsigned int r = 0; r < n_rows; ++r)
            for (unsigned int q = 0; q < all.n_cols(); ++q)
              patch.data(r, q) = all(all.n_rows() - n_rows + r, q);
        }
      dealii::DataOutBase::write_filtered_data(bare, {}, {}, filter);
    }



    /** The fields, each with its rest (FileSeries::rest_name()). */
    template <int patch_dim>
    void
    add_fields(const dealii::DataOutInterface<patch_dim, 3> &data,
               dealii::DataOutBase::DataOutFilter           &filter)
    {
      const auto &patches = Access<patch_dim>::patches(data);
      const auto  names   = Access<patch_dim>::names(data);
      std::size_t n       = 0;
      for (const auto &patch : patches)
        n += patch.data.n_cols();

      // Components of a vector have one name.
      std::map<std::string, std::vector<unsigned int>> rows;
      for (unsigned int c = 0; c < names.size(); ++c)
        rows[names[c]].push_back(c);
      dealii::Table<2, double> values(names.size(), n);
      std::vector<bool>        is_rest(names.size());
      const auto               add = [&](const unsigned int from, const unsigned int to) {
        std::size_t q = 0;
        for (const auto &patch : patches)
          for (unsigned int i = 0; i < patch.data.n_cols(); ++i)
            values(to, q++) += patch.data(from, i);
      };
      for (const auto &[name, of_name] : rows)
        for (unsigned int k = 0; k < of_name.size(); ++k)
          {
            add(of_name[k], of_name[k]);
            if (const auto rests = rows.find(FileSeries::rest_name(name)); rests != rows.end())
              {
                add(rests->second[k], of_name[k]);
                is_rest[rests->second[k]] = true;
              }
          }

      std::map<unsigned int, std::pair<unsigned int, std::string>> vectors;
      for (const auto &range : Access<patch_dim>::ranges(data))
        vectors[std::get<0>(range)] = {std::get<1>(range) - std::get<0>(range) + 1,
                                       std::get<2>(range)};
      for (unsigned int c = 0; c < names.size();)
        {
          const auto         vector = vectors.find(c);
          const unsigned int size   = vector != vectors.end() ? vector->second.first : 1;
          if (!is_rest[c])
            filter.write_data_set(vector != vectors.end() ? vector->second.second : names[c],
                                  size,
                                  c,
                                  values);
          c += size;
        }
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
  XdmfSeries::write(PatchGroups &data, const unsigned int step, const double time)
  {
    // deal.II's filter wants all of them.
    data.make_next(std::numeric_limits<std::size_t>::max());
    write_patches<3>(data, step, time);
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
    const PartOfRanks writers(!Access<patch_dim>::patches(data).empty(), folder);
    folder.together([&] {
      if (writers.communicator == MPI_COMM_NULL)
        return;
      try
        {
          add_mesh(Access<patch_dim>::patches(data), filter);
          add_fields(data, filter);
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
    folder.write_file_atomically(list_name(), text);
  }
} // namespace Touchstone

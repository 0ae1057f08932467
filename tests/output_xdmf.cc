// SPDX-License-Identifier: LGPL-2.1-or-later
// XDMF and HDF5 output on any number of ranks: two faces of a contact surface, which belong to the
// last rank alone, so that others have nothing to write, with values that single precision does not
// hold; and a cloud of points with a tensor. A series is continued after what a list says of
// before.

#include <touchstone/output/contact_output.h>
#include <touchstone/output/point_output.h>

#include <deal.II/base/hdf5.h>

#include <filesystem>
#include <fstream>
#include <iostream>

using namespace Touchstone;

namespace
{
  void
  print_lines(const std::string &path)
  {
    std::ifstream in(path);
    std::string   line;
    std::cout << path << (in ? ":" : " does not exist") << std::endl;
    while (std::getline(in, line))
      for (const char *pattern : {"<Time", "<Topology", "<Attribute"})
        if (line.find(pattern) != std::string::npos)
          std::cout << "  " << line << std::endl;
  }

  /** Smallest and largest number of a data set. */
  void
  print_range(dealii::HDF5::File &file, const std::string &name)
  {
    const auto values      = file.open_dataset(name).read<std::vector<double>>();
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    std::cout << "  " << name << ": " << values.size() << " numbers from " << *low << " to "
              << *high << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const MPI_Comm                           communicator = MPI_COMM_WORLD;
  const bool         root = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
  const OutputFolder folder("xdmf_test", communicator);
  const bool         last = (folder.rank + 1 == folder.n_ranks);

  // The nodes are those of the first rank.
  dealii::IndexSet owned(3 * 100);
  if (root)
    owned.add_range(0, owned.size());
  std::vector<ContactPoint> points;
  if (root)
    for (Index node = 0; node < 6; ++node)
      {
        ContactPoint point{};
        point.node               = node;
        point.reference_position = {double(node % 3), double(node / 3), 0.};
        point.pressure           = 1. + 1e-12 * node;
        point.traction[2]        = point.pressure;
        point.status             = ContactStatus::slip;
        points.push_back(point);
      }
  std::vector<ContactFace> faces;
  if (last)
    faces = {{0, 1, {{0, 1, 3, 4}}}, {0, 1, {{1, 2, 4, 5}}}};

  FileSeries::List written;
  {
    ContactOutput output(folder, ResultFormat::xdmf, "surface");
    output.write(faces, points, owned, 0, 0.);
    written = output.series().list();
  }
  ContactOutput output(folder, ResultFormat::xdmf, "surface");
  output.series().restore(written);
  output.write(faces, points, owned, 1, 0.5);

  const auto     cloud = FileSeries::make(ResultFormat::xdmf, folder, "cloud");
  PointCloudData data(std::vector<std::string>(9, "stress"), *cloud);
  if (last)
    for (unsigned int i = 0; i < 3; ++i)
      data.add({double(i), 0., 0.}, {1., 2., 3., 4., 5., 6., 7., 8., 9. + 1e-12 * i});
  cloud->write(data, 0, 0.);

  if (root)
    {
      std::cout.precision(15);
      print_lines(folder.path("surface.xdmf"));
      print_lines(folder.path("cloud.xdmf"));
      dealii::HDF5::File surface(folder.path("surface_0001.h5"),
                                 dealii::HDF5::File::FileAccessMode::open);
      for (const char *name : {"nodes", "pressure", "traction"})
        print_range(surface, name);
      dealii::HDF5::File tensors(folder.path("cloud_0000.h5"),
                                 dealii::HDF5::File::FileAccessMode::open);
      for (const char *name : {"stress_xy", "stress_zz"})
        print_range(tensors, name);
      std::cout << (std::filesystem::exists(folder.path("surface_0001.h5.part"))
                      ? "parts are left"
                      : "no parts are left")
                << std::endl;
    }
  MPI_Barrier(communicator);
  if (root)
    std::filesystem::remove_all("xdmf_test");
  return 0;
}

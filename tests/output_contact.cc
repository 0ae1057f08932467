// SPDX-License-Identifier: LGPL-2.1-or-later
// VTU output of the contact surface on any number of ranks: two bilinear faces, and
// a biquadratic one of another pair. The nodes belong to rank 0 and the faces to
// the last rank, so that others have none. Without any face nothing is written.

#include <touchstone/output/contact_output.h>

#include <filesystem>
#include <fstream>
#include <iostream>

using namespace Touchstone;

namespace
{
  void
  print_lines(const std::string &path, const std::string &pattern)
  {
    std::ifstream in(path);
    std::string   line;
    std::cout << path << (in ? ":" : " does not exist") << std::endl;
    while (std::getline(in, line))
      if (line.find(pattern) != std::string::npos)
        std::cout << "  " << line << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const MPI_Comm                           communicator = MPI_COMM_WORLD;
  const OutputFolder                       folder("contact_test", communicator);
  const bool                               root = (folder.rank == 0);
  const bool                               last = (folder.rank + 1 == folder.n_ranks);

  // The nodes are those of the first rank.
  dealii::IndexSet owned(3 * 100);
  if (root)
    owned.add_range(0, owned.size());
  std::vector<ContactPoint> points;
  if (root)
    for (unsigned int pair = 0; pair < 2; ++pair)
      for (Index node = 0; node < 9; ++node)
        {
          ContactPoint point;
          point.pair = pair;
          point.node = node;
          // 3 x 3 nodes of which the bilinear faces use the lower 6.
          point.reference_position = {double(node % 3), double(node / 3), double(pair)};
          point.normal             = dealii::Tensor<1, dim>({0., 0., 1.});
          point.pressure           = 10. * pair + node;
          point.traction           = point.pressure * point.normal;
          point.gap                = 0.;
          point.slip_length        = 3. * node;
          point.area               = 1.;
          point.status             = ContactStatus::slip;
          points.push_back(point);
        }

  std::vector<ContactFace> bilinear, biquadratic;
  if (last)
    {
      bilinear.push_back({0, 1, {{0, 1, 3, 4}}});
      bilinear.push_back({0, 1, {{1, 2, 4, 5}}});
      // A node without result: left out.
      bilinear.push_back({0, 1, {{0, 1, 3, 77}}});
      biquadratic.push_back({1, 2, {{0, 1, 2, 3, 4, 5, 6, 7, 8}}});
    }

  ContactOutput nothing(folder);
  nothing.write({}, {}, owned, 0, 0.);
  if (root)
    print_lines(folder.path("contact.pvd"), "DataSet");

  const ContactFieldList fields;
  for (const auto &[key, node] :
       collect_contact_nodes(fields, biquadratic, points, owned, communicator))
    if (last && !root)
      if (node.values[fields.position("pressure")] != 10. * key.first + key.second ||
          node.reference_position[2] != double(key.first) ||
          node.values[fields.position("slip_length")] != 3. * key.second ||
          node.values[fields.position("status")] != double(int(ContactStatus::slip)))
        std::cout << "wrong point" << std::endl;

  ContactOutput output(folder);
  output.write(bilinear, points, owned, 0, 0.);
  output.write(biquadratic, points, owned, 1, 0.5);
  // Nothing is in contact any more.
  for (ContactPoint &point : points)
    point.status = ContactStatus::no_partner;
  output.write(bilinear, points, owned, 2, 1.);

  if (root)
    {
      print_lines(folder.path("contact.pvd"), "DataSet");
      for (const auto &name : {"contact_0000", "contact_0001", "contact_0002"})
        {
          const std::string stem = folder.path(name);
          if (folder.n_ranks == 1)
            print_lines(stem + ".vtu", "<Piece");
          else
            {
              print_lines(stem + ".pvtu", "<Piece");
              for (unsigned int rank = 0; rank < folder.n_ranks; ++rank)
                print_lines(stem + "." + std::to_string(rank) + ".vtu", "<Piece");
            }
        }
      std::filesystem::remove_all("contact_test");
    }
  return 0;
}

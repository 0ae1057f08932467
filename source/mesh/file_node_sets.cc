// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/mesh/file_geometry.h>

// The sets of nodes of a body from a mesh file.
namespace Touchstone
{
  using namespace dealii;

  // Corners of cells say what a set is: nodes in the middle of edges, faces and cells belong to it
  // if all corners there do (Forest::node_set()). A file that says something else is refused.
  void
  FileGeometry::take_sets(BodyMesh                                   &mesh,
                          const MeshFile                             &mesh_file,
                          const std::map<unsigned int, unsigned int> &vertex_numbers,
                          const std::vector<unsigned int>            &cell_numbers,
                          const std::string                          &section) const
  {
    for (const auto &[name, members] : mesh_file.node_sets)
      {
        for (const unsigned int v : members)
          if (const auto found = vertex_numbers.find(v); found != vertex_numbers.end())
            mesh.node_sets[name].insert(found->second);
        for (const unsigned int c : cell_numbers)
          for (unsigned int e = 0; c < mesh_file.mid_nodes.size() && e < 12; ++e)
            if (const auto &middle = mesh_file.mid_nodes[c];
                e < middle.size() && members.count(middle[e]) > 0)
              for (const unsigned int end : MeshFile::edge_ends[e])
                if (members.count(mesh_file.cells[c].vertices[end]) == 0)
                  throw InputError(section,
                                   "File",
                                   file,
                                   "the node set '" + name +
                                     "' has a node in the middle of an edge without both of its "
                                     "ends",
                                   "add the ends to the set, or remove the node");
      }
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/trace_basis.h>

#include <algorithm>

// The basis of the continuous displacements on a face with hanging nodes, N~ = C^T N, written with
// as many nodes as the face has: the nodes that hanging ones follow replace these (doc/theory.md
// 11, "Hanging nodes").
namespace Touchstone
{
  using namespace dealii;

  bool
  TraceBasis::needed(const Face &face, const AffineConstraints<double> &hanging)
  {
    // A hanging node has all components constrained alike, so the first one tells.
    return std::any_of(face.nodes.begin(), face.nodes.begin() + face.n_nodes(), [&](const Index m) {
      return hanging.is_constrained(dim * m);
    });
  }



  TraceBasis::TraceBasis(const Face &face, const AffineConstraints<double> &hanging)
    : n(face.n_nodes())
    , nodes(face.nodes)
  {
    const auto end = nodes.begin() + n;
    // Hanging nodes are replaced by the parents that the face does not have. With
    // degree 2 a corner can hang as well: it follows the middle of the larger edge.
    std::vector<unsigned int> hanging_nodes;
    std::vector<Index>        parents;
    for (unsigned int i = 0; i < n; ++i)
      if (hanging.is_constrained(dim * face.nodes[i]))
        {
          hanging_nodes.push_back(i);
          for (const auto &entry : *hanging.get_constraint_entries(dim * face.nodes[i]))
            if (std::find(nodes.begin(), end, entry.first / dim) == end &&
                std::find(parents.begin(), parents.end(), entry.first / dim) == parents.end())
              parents.push_back(entry.first / dim);
        }
    // The order is immaterial, as the weights below refer to the new list. With more new nodes than
    // hanging ones C would not be square; that is checked below.
    for (unsigned int k = 0; k < std::min(hanging_nodes.size(), parents.size()); ++k)
      nodes[hanging_nodes[k]] = parents[k];
    for (unsigned int i = 0; i < n; ++i)
      // A node that does not hang follows itself.
      if (!hanging.is_constrained(dim * face.nodes[i]))
        weights[i][i] = 1.;
      else
        for (const auto &entry : *hanging.get_constraint_entries(dim * face.nodes[i]))
          {
            const auto found = std::find(nodes.begin(), end, entry.first / dim);
            AssertThrow(found != end,
                        ExcMessage("A face has more parents of hanging nodes than nodes."));
            // Row i of C: u_i = sum_p C_ip u_p on the face (doc/theory.md 11).
            weights[i][found - nodes.begin()] = entry.second;
          }
  }



  std::array<double, Face::max_nodes>
  TraceBasis::apply(const std::array<double, Face::max_nodes> &values) const
  {
    std::array<double, Face::max_nodes> result{};
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int p = 0; p < n; ++p)
        // C^T times values: what belongs to node i goes to the nodes that it follows.
        result[p] += weights[i][p] * values[i];
    return result;
  }



  Stencil
  TraceBasis::stencil(const unsigned int i) const
  {
    Stencil result;
    for (unsigned int p = 0; p < n; ++p)
      if (weights[i][p] != 0.)
        // Row i of C without zeros: the nodes that node i of the face follows.
        result.push_back({nodes[p], weights[i][p]});
    return result;
  }
} // namespace Touchstone

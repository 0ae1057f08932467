// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/contact_stiffness.h>
#include <touchstone/explicit/hexahedron.h>

#include <algorithm>

// How stiff cells are behind their contact faces, as penalty methods of explicit dynamics need it
// (doc/explicit.md, section 9.3).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Sums over the faces around a node. */
    struct AroundNode
    {
      double area = 0., volume = 0.;
    };

    double
    area(const Face &face)
    {
      return 0.5 * cross_product_3d(face.reference[3] - face.reference[0],
                                    face.reference[2] - face.reference[1])
                     .norm();
    }
  } // namespace



  std::vector<double>
  contact_stiffness(const Contact                     &contact,
                    const NodeMap                     &map,
                    const std::vector<BodyParameters> &bodies)
  {
    // The cells at each node, all of them at owned ones.
    std::vector<std::vector<unsigned int>> cells_of(map.n_owned());
    for (unsigned int c = 0; c < map.cells().size(); ++c)
      for (const unsigned int node : map.nodes(c))
        if (node < map.n_owned())
          cells_of[node].push_back(c);
    const auto volume_behind = [&](const Face &face, const unsigned int node) {
      for (const unsigned int c : cells_of[node])
        {
          const auto &nodes = map.nodes(c);
          bool        here  = true;
          for (unsigned int m = 0; m < face.n_nodes(); ++m)
            here = here && std::find(nodes.begin(), nodes.end(), map.local(dim * face.nodes[m])) !=
                             nodes.end();
          if (here)
            {
              Hexahedron cell;
              cell.reinit(corners(map, nodes));
              return cell.volume();
            }
        }
      AssertThrow(false, ExcInternalError());
      return 0.;
    };
    std::vector<AroundNode> sums(map.n_owned());
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      for (const Surface *const surface : {&contact.pair(p).slave(), contact.pair(p).master()})
        if (surface != nullptr)
          for (const SurfaceNode &at : surface->owned_nodes())
            {
              const unsigned int node  = map.local(dim * at.node);
              auto               faces = surface->faces_around(at.node);
              std::sort(faces.begin(), faces.end(), [](const auto &a, const auto &b) {
                return a.first->key < b.first->key;
              });
              for (const auto &[face, m] : faces)
                {
                  sums[node].area += area(*face);
                  sums[node].volume += volume_behind(*face, node);
                }
            }
    std::vector<double> result(map.n_owned());
    for (unsigned int node = 0; node < map.n_owned(); ++node)
      if (sums[node].volume > 0.)
        result[node] =
          bodies[map.body(node)].material.bulk_modulus() * sums[node].area / sums[node].volume;
    return result;
  }
} // namespace Touchstone

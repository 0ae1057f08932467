// SPDX-License-Identifier: LGPL-2.1-or-later
// Directions of the mesh must not decide anything: a face whose two directions are exchanged has
// the same smoothed patch, at a corner of the surface, too.

#include <touchstone/contact/geometry/gregory_patch.h>

#include <iostream>
#include <utility>

using namespace Touchstone;
using namespace dealii;

namespace
{
  /** A warped face with normals that are not its own. */
  Face
  warped_face(const unsigned int outer_edges)
  {
    Face face;
    face.degree           = 1;
    face.outer_edges      = outer_edges;
    const Point<dim> x[4] = {{0., 0., 0.1}, {1., 0.1, 0.}, {-0.1, 1.2, 0.}, {1.1, 1., -0.3}};
    for (unsigned int m = 0; m < 4; ++m)
      {
        face.nodes[m]     = m;
        face.reference[m] = x[m];
        Tensor<1, dim> n({0.3 * x[m][0], 0.2 * x[m][1], 1.});
        face.normals[m] = n / n.norm();
      }
    return face;
  }

  /** The same face, with its first direction second. */
  Face
  exchanged(const Face &face)
  {
    Face result(face);
    std::swap(result.reference[1], result.reference[2]);
    std::swap(result.normals[1], result.normals[2]);
    result.outer_edges = ((face.outer_edges & 3u) << 2) | (face.outer_edges >> 2);
    return result;
  }
} // namespace

int
main()
{
  for (const unsigned int outer_edges : {0u, 1u, 2u, 4u, 8u, 5u, 6u, 9u, 10u})
    {
      const Face         face = warped_face(outer_edges);
      const GregoryPatch patch(face), other(exchanged(face));
      double             difference = 0.;
      for (const double a : {-1., -0.6, 0.1, 0.7})
        for (const double b : {-0.9, -0.2, 0.5, 1.})
          difference =
            std::max(difference, (patch.evaluate({{a, b}}).x - other.evaluate({{b, a}}).x).norm());
      std::cout << "outer edges " << outer_edges << ": "
                << (difference < 1e-14 ? "same patch" : "FAILED, the patches differ") << std::endl;
    }
  return 0;
}

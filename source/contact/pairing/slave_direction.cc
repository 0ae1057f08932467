// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/slave_direction.h>

#include <algorithm>

// Directions of slave nodes (doc/theory.md 3.4).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Cosine between directions that are the same. */
    constexpr double same_direction = 1. - 1e-10;
  } // namespace



  std::vector<SlaveDirection>
  slave_directions(const Surface &surface, const Index node)
  {
    std::vector<SlaveDirection> result{{surface.normal(node), surface.normal_shares(node)}};
    for (const auto &[face, m] : surface.faces_around(node))
      {
        const Tensor<1, dim> &n = face->normals[m];
        if (std::any_of(result.begin(), result.end(), [&n](const SlaveDirection &other) {
              return other.n * n > same_direction;
            }))
          continue;
        result.push_back({n, surface.normal_shares(*face, m)});
      }
    return result;
  }
} // namespace Touchstone

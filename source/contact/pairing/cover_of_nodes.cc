// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/face_area.h>
#include <touchstone/contact/pairing/cover_of_nodes.h>
#include <touchstone/contact/pairing/facing_part.h>
#include <touchstone/contact/pairing/smooth_step.h>

// Vector areas of what a pair covers around its nodes (doc/theory.md 3.1, "Faces that several pairs
// cover"). With shape functions and not with the weights of rows, which depend on the cover by
// others: so areas are functions of positions alone.
namespace Touchstone
{
  using namespace dealii;

  void
  CoverOfNodes::add_whole(const Index             node,
                          const unsigned int      k,
                          const Face             &slave,
                          const TraceBasis *const basis)
  {
    whole[node] -= whole_areas(slave, basis, /*reference=*/false)[k] * plane_normal(slave);
  }



  template <unsigned int n>
  void
  CoverOfNodes::add(const SurfaceNode                              &node,
                    const unsigned int                              k,
                    const Tensor<1, dim>                           &plane,
                    const DualBasis                                &dual,
                    const std::vector<FacingFace>                  &masters,
                    const std::vector<OverlapIntegrals<n, double>> &parts)
  {
    own[node.node] -= dual.areas[k] * plane;
    for (std::size_t f = 0; f < parts.size(); ++f)
      {
        // Surfaces that are apart do not carry: to them this is an edge.
        const double closed =
          1. -
          smooth_step(parts[f].least / node.size, Tolerances::hardly_open, Tolerances::well_open);
        if (closed == 0.)
          continue;
        double                area = 0.;
        std::array<double, n> of_masters{};
        for (unsigned int j = 0; j < n; ++j)
          if (const double c = closed * dual.shape(k, j); c != 0.)
            {
              area += c * parts[f].q[j][OverlapColumns::area];
              for (unsigned int m = 0; m < n; ++m)
                of_masters[m] += c * parts[f].q[j][OverlapColumns::master + m];
            }
        covered[node.node] -= area * plane;
        for (unsigned int m = 0; m < n; ++m)
          covered[masters[f].master->nodes[m]] += of_masters[m] * plane;
      }
  }



  template void
  CoverOfNodes::add<4>(const SurfaceNode &,
                       unsigned int,
                       const Tensor<1, dim> &,
                       const DualBasis &,
                       const std::vector<FacingFace> &,
                       const std::vector<OverlapIntegrals<4, double>> &);
  template void
  CoverOfNodes::add<9>(const SurfaceNode &,
                       unsigned int,
                       const Tensor<1, dim> &,
                       const DualBasis &,
                       const std::vector<FacingFace> &,
                       const std::vector<OverlapIntegrals<9, double>> &);
} // namespace Touchstone

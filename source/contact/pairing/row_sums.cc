// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/row_sums.h>

#include <algorithm>
#include <cmath>
#include <limits>

// Sums over the slave faces around a node: D, D_kk, the integrals of gap and normal, and the
// stencil of equation (5) of doc/theory.md 3.1. Derivatives are in AveragedRowDerivative.
namespace Touchstone
{
  using namespace dealii;

  void
  RowSums::clear()
  {
    faces.clear();
    std::vector<FaceShare> list;
    list.swap(faces);
    static_cast<CoverSums &>(*this) = CoverSums();
    list.swap(faces);
    // Infinite until a point is added.
    least = own = std::numeric_limits<double>::max();
    beside      = 1.;
    lever       = Tensor<1, dim>();
    for (Stencil *entries : {&stencil, &taken, &left})
      entries->clear();
  }



  template <unsigned int n>
  void
  RowSums::add(const unsigned int                 k,
               const DualBasis                   &dual,
               const Face                        &master,
               const OverlapIntegrals<n, double> &part,
               FaceShare                         *face)
  {
    // r_k = W_k Q, see DualBasis.
    std::array<double, OverlapIntegrals<n, double>::n_columns> r{};
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int c = 0; c < r.size(); ++c)
        r[c] += dual.weight(k, j) * part.q[j][c];
    // Integrals with psi'_k of 1, gap, normal and master shapes.
    area += r[OverlapColumns::area];
    for (unsigned int d = 0; d < dim; ++d)
      {
        gap[d] += r[OverlapColumns::gap + d];
        normal[d] += r[OverlapColumns::normal + d];
        moved[d] += r[OverlapColumns::moved + d];
      }
    for (unsigned int m = 0; m < n; ++m)
      add(stencil, master.nodes[m], r[OverlapColumns::master + m]);
    least = std::min(least, part.least);
    for (unsigned int j = 0; j < n; ++j)
      {
        arch += dual.positive(k, j) * part.q[j][OverlapColumns::arch];
        inclined += dual.positive(k, j) * part.q[j][OverlapColumns::inclined];
        shape_area += dual.positive(k, j) * part.q[j][OverlapColumns::area];
      }
    if (!face)
      return;
    if (part.own[k] < own)
      {
        own = part.own[k];
        for (unsigned int d = 0; d < dim; ++d)
          own_moved[d] = part.own_moved[k][d];
      }
    beside = std::min(beside, part.beside[k]);
    length = part.length;
    // The same of this face alone; and integrals of 1 and gap with the positive function.
    face->own    = std::min(face->own, part.own[k]);
    face->beside = std::min(face->beside, part.beside[k]);
    face->least  = std::min(face->least, part.least);
    face->area += r[OverlapColumns::area];
    for (unsigned int d = 0; d < dim; ++d)
      face->gap[d] += r[OverlapColumns::gap + d];
    for (unsigned int j = 0; j < n; ++j)
      if (const double c = dual.positive(k, j); c != 0.)
        {
          face->shape_area += c * part.q[j][OverlapColumns::area];
          for (unsigned int d = 0; d < dim; ++d)
            face->shape_gap[d] += c * part.q[j][OverlapColumns::gap + d];
        }
  }



  void
  RowSums::add(Stencil &list, const Index node, const double value)
  {
    const auto found = std::find_if(list.begin(), list.end(), [node](const StencilEntry &entry) {
      return entry.node == node;
    });
    if (found != list.end())
      found->weight += value;
    else
      list.push_back({node, value});
  }



  void
  RowSums::finish()
  {
    // Of two nodes that each give area to the other on different faces, only the one that
    // receives more has the other in its stencil: constraints must not depend on each other in a
    // cycle. It is rare: both must lie at the edge of the cover, on different sides.
    for (const StencilEntry &entry : taken)
      {
        const auto back = std::find_if(left.begin(), left.end(), [&](const StencilEntry &other) {
          return other.node == entry.node;
        });
        if (back != left.end() && std::abs(entry.weight) <= std::abs(back->weight))
          // The rejected share counts as the node's own, so that D = sum D_ki and with it the sum
          // of the weights remains.
          kept += entry.weight;
        else
          // +D_ki x_i in equation (5), of opposite sign to master weights, which the stencil
          // subtracts.
          add(stencil, entry.node, -entry.weight);
      }
    // Independent of the order in which faces were added.
    std::sort(stencil.begin(), stencil.end(), [](const StencilEntry &a, const StencilEntry &b) {
      return a.node < b.node;
    });
  }



  template void
  RowSums::add<4>(unsigned int,
                  const DualBasis &,
                  const Face &,
                  const OverlapIntegrals<4, double> &,
                  FaceShare *);
  template void
  RowSums::add<9>(unsigned int,
                  const DualBasis &,
                  const Face &,
                  const OverlapIntegrals<9, double> &,
                  FaceShare *);
} // namespace Touchstone

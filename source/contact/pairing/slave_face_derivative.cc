// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/slave_face_derivative.h>

#include <algorithm>
#include <cmath>

// Integrals over a slave face that several master faces cover, with their derivatives, and from
// these the derivatives of the integrals with psi'_k (doc/theory.md 4, dr_k = dS_k Y + W_k (dQ - dM
// C Y)). Master faces share nodes, so their local variables are summed into one numbering first.
namespace Touchstone
{
  using namespace dealii;

  template <unsigned int n>
  SlaveFaceDerivative<n>::SlaveFaceDerivative(const FaceGeometry       &slave,
                                              const TraceBasis         *basis,
                                              const Parts              &parts,
                                              const CoverShares::Whole &at_once)
    : slave(slave)
    , parts(parts)
    , dual(total_mass<n>(parts),
           total_areas<n>(parts),
           basis,
           whole_areas(slave.face(), basis, /*reference=*/true),
           at_once,
           /*with_derivative=*/true)
    , basis(basis)
    , whole(whole_areas(slave.face(), basis, /*reference=*/true))
    , present(whole_areas(slave.face(), basis, /*reference=*/false))
    , d_present(whole_area_derivatives(slave.face(), basis))
  {
    const auto &nodes = basis ? basis->nodes : slave.face().nodes;
    own.assign(nodes.begin(), nodes.begin() + n);
    for (const OverlapDerivative<n> &part : parts)
      masters.insert(masters.end(), part.master->nodes.begin(), part.master->nodes.begin() + n);
    std::sort(masters.begin(), masters.end());
    // Each master node once, as several faces have it.
    masters.erase(std::unique(masters.begin(), masters.end()), masters.end());
    solution = dual.solve(assemble());
  }



  template <unsigned int n>
  unsigned int
  SlaveFaceDerivative<n>::index_of_master(const Index node) const
  {
    // Slave nodes come first in the numbering, then the sorted master nodes.
    return n + (std::lower_bound(masters.begin(), masters.end(), node) - masters.begin());
  }



  template <unsigned int n>
  FullMatrix<double>
  SlaveFaceDerivative<n>::assemble()
  {
    const unsigned int n_columns = OverlapColumns::master + masters.size();
    FullMatrix<double> q(n, n_columns);
    d_mass.reinit(dim * n_nodes(), n, n);
    d_q.reinit(dim * n_nodes(), n, n_columns);
    for (const OverlapDerivative<n> &part : parts)
      {
        // Variables and columns of the part among those of all.
        constexpr unsigned int n_local = OverlapPointDerivative<n>::n_variables;
        unsigned int           variable[n_local], column[OverlapColumns::master + n];
        // The slave variables are the same for all parts.
        for (unsigned int v = 0; v < n * dim; ++v)
          {
            variable[v]           = v;
            variable[n * dim + v] = dim * index_of_master(part.master->nodes[v / dim]) + v % dim;
          }
        for (unsigned int c = 0; c < OverlapColumns::master; ++c)
          column[c] = c;
        for (unsigned int m = 0; m < n; ++m)
          column[OverlapColumns::master + m] =
            OverlapColumns::master + index_of_master(part.master->nodes[m]) - n;

        for (unsigned int j = 0; j < n; ++j)
          {
            for (unsigned int k = 0; k <= j; ++k)
              for (unsigned int v = 0; v < n_local; ++v)
                {
                  const double d = part.mass[j][k].fastAccessDx(v);
                  // The parts store the lower triangle only.
                  d_mass(variable[v], j, k) += d;
                  if (k < j)
                    d_mass(variable[v], k, j) += d;
                }
            for (unsigned int c = 0; c < OverlapColumns::master + n; ++c)
              {
                q(j, column[c]) += part.q[j][c].val();
                for (unsigned int v = 0; v < n_local; ++v)
                  d_q(variable[v], j, column[c]) += part.q[j][c].fastAccessDx(v);
              }
          }
      }
    return q;
  }



  template <unsigned int n>
  Stencil
  SlaveFaceDerivative<n>::carriers(const unsigned int i) const
  {
    if (i >= n)
      // A master node carries itself: weights of hanging master nodes are condensed later, like any
      // other dof (doc/theory.md 11).
      return {{masters[i - n], 1.}};
    // A slave node of the face that hangs moves with the nodes that it follows.
    return basis ? basis->stencil(i) : Stencil{{own[i], 1.}};
  }



  template <unsigned int n>
  bool
  SlaveFaceDerivative<n>::covered_in_part(const unsigned int k) const
  {
    // In the present state, as the shares are: where all of a node is covered D_kk is its present
    // area, and its reference area is that of the mesh.
    return std::abs(dual.shares.share[k][k] - present[k]) > Tolerances::fully_covered * present[k];
  }



  template <unsigned int n>
  void
  SlaveFaceDerivative<n>::differentiate(const unsigned int k,
                                        const unsigned int i,
                                        const unsigned int e,
                                        Change            &change) const
  {
    const unsigned int v = dim * i + e;
    // The covered areas a~ = C^T a are column "area" of Q.
    DualBasis::Values d_areas{};
    for (unsigned int j = 0; j < n; ++j)
      d_areas[j] = d_q(v, j, OverlapColumns::area);
    if (basis)
      d_areas = basis->apply(d_areas);
    change.area = d_areas[k];
    // d S_ki; S_kk is also the kept area D_kk.
    change.share = dual.share_derivative(k, d_areas);
    // S_kk A_k / A_k(x), with A_k(x) of the whole face in the present position.
    change.reference = change.share[k];
    // A_k(x) depends on the slave nodes alone.
    if (i < n)
      change.reference -= dual.shares.share[k][k] / present[k] * d_present[i][e][k];
    change.reference *= whole[k] / present[k];
    change.shape_gap  = Tensor<1, dim>();
    change.shape_area = change.arch = change.inclined = 0.;
    for (unsigned int j = 0; j < n; ++j)
      if (const double c = dual.positive(k, j); c != 0.)
        {
          change.shape_area += c * d_q(v, j, OverlapColumns::area);
          change.arch += c * d_q(v, j, OverlapColumns::arch);
          change.inclined += c * d_q(v, j, OverlapColumns::inclined);
          for (unsigned int d = 0; d < dim; ++d)
            change.shape_gap[d] += c * d_q(v, j, OverlapColumns::gap + d);
        }
    change.integrals.resize(OverlapColumns::master + masters.size());
    dual.differentiate(k,
                       solution,
                       change.share,
                       d_mass,
                       d_q,
                       v,
                       ArrayView<double>(change.integrals.data(), change.integrals.size()));
  }



  template class SlaveFaceDerivative<4>;
  template class SlaveFaceDerivative<9>;
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/averaged_sums.h>
#include <touchstone/contact/pairing/facing_part.h>

#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <numeric>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Present positions of the nodes to which the rows of a slave face belong. */
    std::vector<Point<dim>>
    carrier_positions(const TraceBasis *const basis, const Face &slave)
    {
      const unsigned int      n = slave.n_nodes();
      std::vector<Point<dim>> x;
      for (unsigned int i = 0; i < n; ++i)
        x.push_back(slave.position(i));
      if (!basis)
        return x;
      // The nodes that those of the face follow: x_i = sum C_ip x_p.
      // A node that a hanging one follows need not belong to the face, so its position is not
      // stored with it: invert C.
      FullMatrix<double> inverse(n, n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int p = 0; p < n; ++p)
          inverse(i, p) = basis->weights[i][p];
      inverse.gauss_jordan();
      std::vector<Point<dim>> result(n);
      for (unsigned int p = 0; p < n; ++p)
        for (unsigned int i = 0; i < n; ++i)
          result[p] += inverse(p, i) * x[i];
      return result;
    }
  } // namespace



  AveragedSums::AveragedSums(const Surface     &slave,
                             const MasterNormal kind,
                             const bool         tied,
                             const bool         one_of_several)
    : slave_surface(slave)
    , kind(kind)
    , tied(tied)
    , one_of_several(one_of_several)
    , sums(slave.owned_nodes().size())
  {
  }



  void
  AveragedSums::clear()
  {
    for (RowSums &sum : sums)
      sum.clear();
    covered_nodes.clear();
    left_alone.clear();
  }



  void
  AveragedSums::add(AveragedFace                            &face,
                    const Face                              &slave,
                    const std::vector<FacingFace>           &masters,
                    const std::vector<const FaceGeometry *> &on_masters)
  {
    for (unsigned int k = 0; one_of_several && k < slave.n_nodes(); ++k)
      if (face.row[k] >= 0)
        covered_nodes.add_whole(slave_surface.owned_nodes()[face.row[k]].node,
                                k,
                                slave,
                                face.basis);
    face.cover.fill(-1.);
    if (masters.empty())
      return;
    if (slave.degree == 1)
      add_covered<4>(face, slave, masters, on_masters);
    else
      add_covered<9>(face, slave, masters, on_masters);
  }



  template <unsigned int n>
  void
  AveragedSums::add_covered(AveragedFace                            &face,
                            const Face                              &slave,
                            const std::vector<FacingFace>           &masters,
                            const std::vector<const FaceGeometry *> &on_masters)
  {
    const FaceGeometry on_slave(slave, slave_surface.exact_surface(slave), kind);
    // Points of both faces are paired along the normal of this plane.
    const Tensor<1, dim> plane = plane_normal(slave);

    // Integrals over what each master face covers: M_jk and Q_jc of doc/theory.md 4.
    std::vector<OverlapIntegrals<n, double>> parts(
      masters.size(), OverlapIntegrals<n, double>(slave_surface.largest_face()));
    OverlapSample<n, double> sample;
    for (std::size_t f = 0; f < masters.size(); ++f)
      for (const OverlapPoint &point : masters[f].points)
        if (evaluate<n>(point, on_slave, *on_masters[f], plane, sample))
          parts[f].add(sample);
    const auto areas = total_areas<n>(parts);
    // Covered only where the surfaces are too inclined to each other (doc/theory.md 3.2).
    if (std::accumulate(areas.begin(), areas.end(), 0.) <= 0.)
      return;
    // The dual basis of the whole covered part, which several master faces may share.
    const DualBasis dual(total_mass<n>(parts),
                         areas,
                         face.basis,
                         face.whole,
                         face.at_once,
                         /*with_derivative=*/false);
    face.cover         = dual.shares.cover;
    const auto present = whole_areas(slave, face.basis, /*reference=*/false);

    for (unsigned int k = 0; k < n; ++k)
      {
        // Rows of other ranks are summed there.
        if (face.row[k] < 0)
          continue;
        if (one_of_several)
          covered_nodes.add<n>(
            slave_surface.owned_nodes()[face.row[k]], k, plane, dual, masters, parts);
        add_row<n>(k, face, slave, masters, parts, dual, present[k]);
      }
    if (one_of_several)
      add_left_alone(face, slave, dual.areas, plane);
    if (dual.shares.partial)
      add_shares(face, slave, dual.shares);
  }



  template <unsigned int n>
  void
  AveragedSums::add_row(const unsigned int                              k,
                        const AveragedFace                             &face,
                        const Face                                     &slave,
                        const std::vector<FacingFace>                  &masters,
                        const std::vector<OverlapIntegrals<n, double>> &parts,
                        const DualBasis                                &dual,
                        const double                                    present_area)
  {
    RowSums &sum = sums[face.row[k]];
    sum.shared   = face.at_once.part[k];
    // Where the node hangs the row is that of another node, which is not on this face.
    FaceShare *share = nullptr;
    if (!face.basis || face.basis->nodes[k] == slave.nodes[k])
      {
        share      = &sum.faces.emplace_back();
        share->key = slave.key;
      }
    for (std::size_t f = 0; f < masters.size(); ++f)
      sum.add<n>(k, dual, *masters[f].master, parts[f], share);
    // D_kk of equation (5), the area given to other nodes, and D_kk in the reference state, for
    // tractions are nominal (doc/theory.md 2.2).
    const double kept = dual.shares.share[k][k];
    sum.kept += kept;
    sum.given += dual.areas[k] - kept;
    if (face.at_once.gives[k] && !tied)
      sum.left_to_others += dual.areas[k] - kept;
    sum.reference += kept * face.whole[k] / present_area;
  }



  void
  AveragedSums::add_left_alone(const AveragedFace      &face,
                               const Face              &slave,
                               const DualBasis::Values &areas,
                               const Tensor<1, dim>    &plane)
  {
    const auto &without_row = slave.without_row;
    if (std::none_of(without_row.begin(), without_row.end(), [](const bool given) {
          return given;
        }))
      return;
    // As if none of its nodes kept their rows.
    CoverShares::Whole could_give = face.at_once;
    could_give.gives              = without_row;
    if (CoverShares::gives_away(slave.n_nodes(), areas, face.whole, could_give))
      return;
    for (unsigned int k = 0; k < slave.n_nodes(); ++k)
      if (without_row[k] && face.row[k] >= 0)
        left_alone[slave_surface.owned_nodes()[face.row[k]].node] -= areas[k] * plane;
  }



  void
  AveragedSums::add_shares(const AveragedFace &face, const Face &slave, const CoverShares &shares)
  {
    const unsigned int            n     = slave.n_nodes();
    const auto                   &nodes = face.basis ? face.basis->nodes : slave.nodes;
    const std::vector<Point<dim>> x     = carrier_positions(face.basis, slave);
    for (unsigned int k = 0; k < n; ++k)
      if (face.row[k] >= 0)
        for (unsigned int i = 0; i < n; ++i)
          {
            if (i == k)
              continue;
            RowSums &sum = sums[face.row[k]];
            // Row k receives T_ki a_i of node i. The lever is the first moment of these areas
            // about node k: the resultant acts at their centroid.
            if (const double area = shares.share[k][i]; area != 0.)
              {
                RowSums::add(sum.taken, nodes[i], area);
                sum.lever += area * (x[i] - x[k]);
              }
            if (const double area = shares.share[i][k]; area != 0.)
              RowSums::add(sum.left, nodes[i], area);
          }
  }



  void
  AveragedSums::finish()
  {
    for (std::size_t k = 0; k < sums.size(); ++k)
      {
        sums[k].finish();
        // Beyond planes of symmetry the integrals go on.
        const MirrorImages &images = slave_surface.images(slave_surface.owned_nodes()[k].node);
        if (!images.empty())
          sums[k].images = images.all(sums[k].normal);
      }
  }



  void
  AveragedSums::set_keep_rows()
  {
    covered_nodes.keep_rows.clear();
    for (const auto &[node, area] : left_alone)
      if (area.norm() > Tolerances::keeps_if_at_once * covered_nodes.own.at(node).norm())
        covered_nodes.keep_rows.insert(node);
  }
} // namespace Touchstone

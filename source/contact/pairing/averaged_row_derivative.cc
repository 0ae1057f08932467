// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/averaged_row_derivative.h>

#include <deal.II/base/numbers.h>

#include <limits>

// The derivative of one averaged row: sums over the slave faces are differentiated first, by
// positions and by averaged nodal normals, then the formulas of AveragedRow are applied to the
// complete sums. Derivatives by normals are continued to node positions only at the end, once per
// face, since each normal depends on all nodes of the faces around (doc/theory.md 4).
namespace Touchstone
{
  using namespace dealii;

  AveragedRowDerivative::AveragedRowDerivative(const Stencil   &stencil,
                                               const CoverSums &sums,
                                               const double     size,
                                               const bool       with_area)
    : stencil(stencil)
    , row(sums, size)
    , with_area(with_area)
    , builder(stencil.size())
  {
    for (unsigned int m = 0; m < stencil.size(); ++m)
      in_stencil[stencil[m].node] = m;
  }



  std::size_t
  AveragedRowDerivative::index(const Index node)
  {
    const std::size_t result = builder.index(node);
    // Both lists grow together: entry i of the sums belongs to node i of the result.
    sums.resize(builder.result->nodes.size());
    return result;
  }



  template <unsigned int n>
  void
  AveragedRowDerivative::add_face(const unsigned int k, const SlaveFaceDerivative<n> &face)
  {
    add_positions<n>(k, face);
    add_normals<n>(k, face);
    if (const FaceShare *deciding = row.deciding_face();
        deciding && deciding->key == face.slave.face().key)
      add_deciding<n>(k, face);
  }



  template <unsigned int n>
  void
  AveragedRowDerivative::add_deciding(const unsigned int k, const SlaveFaceDerivative<n> &face)
  {
    typename SlaveFaceDerivative<n>::Change change;
    for (unsigned int i = 0; i < face.n_nodes(); ++i)
      for (unsigned int e = 0; e < dim; ++e)
        {
          face.differentiate(k, i, e, change);
          for (const auto &[node, weight] : face.carriers(i))
            {
              FaceShareDerivative &sum = sums[index(node)].face;
              sum.area[e] += weight * change.integrals[OverlapColumns::area];
              sum.shape_area[e] += weight * change.shape_area;
              for (unsigned int c = 0; c < dim; ++c)
                {
                  sum.gap[c][e] += weight * change.integrals[OverlapColumns::gap + c];
                  sum.shape_gap[c][e] += weight * change.shape_gap[c];
                }
            }
        }
    for (const OverlapDerivative<n> &part : face.parts)
      {
        for (unsigned int m = 0; m < n; ++m)
          for (unsigned int j = 0; j < n; ++j)
            {
              // As in add_normals, with the positive function besides.
              const double w = face.dual.weight(k, j), c = face.dual.positive(k, j);
              if (part.master_smooth)
                {
                  auto &by_master = face_by_master[part.master];
                  by_master[0][m] += w * part.gap_normal[j][m];
                  by_master[1][m] += c * part.gap_normal[j][m];
                }
              if (face.slave.smooth())
                {
                  face_gap_by_slave[m] += w * part.gap_slave_normal[j][m];
                  face_shape_gap_by_slave[m] += c * part.gap_slave_normal[j][m];
                }
            }
        offer<n>(face_own, part.own[k], part.own_by_normals[k], face, *part.master);
        offer<n>(face_beside, part.beside[k], {}, face, *part.master);
        offer<n>(face_least, part.least, part.least_by_normals, face, *part.master);
      }
  }



  template <unsigned int n>
  void
  AveragedRowDerivative::add_positions(const unsigned int k, const SlaveFaceDerivative<n> &face)
  {
    // Terms W_km of the stencil: integrals of master shapes (which column), and, with the opposite
    // sign, the areas that slave nodes give to this row (which node of the face).
    std::vector<std::pair<unsigned int, unsigned int>> of_masters, of_slaves;
    for (unsigned int m = 0; m < face.masters.size(); ++m)
      if (const auto found = in_stencil.find(face.masters[m]); found != in_stencil.end())
        of_masters.emplace_back(OverlapColumns::master + m, found->second);
    for (unsigned int i = 0; i < n; ++i)
      if (const auto found = in_stencil.find(face.own[i]); found != in_stencil.end())
        of_slaves.emplace_back(i, found->second);
    // The area of a row changes only where less than the whole face is covered; elsewhere it is
    // that of the reference state.
    const bool part = with_area && face.covered_in_part(k);
    area_changes    = area_changes || part;

    RowDerivative &result = *builder.result;
    // Node by node: change[e] is the derivative of everything that row k takes from this face by
    // component e of its position.
    std::array<typename SlaveFaceDerivative<n>::Change, dim> change;
    for (unsigned int i = 0; i < face.n_nodes(); ++i)
      {
        for (unsigned int e = 0; e < dim; ++e)
          face.differentiate(k, i, e, change[e]);
        // The chain rule for hanging nodes: x_i = sum C_ip x_p.
        for (const auto &[node, weight] : face.carriers(i))
          {
            const std::size_t    to  = index(node);
            CoverSumsDerivative &sum = sums[to];
            for (unsigned int e = 0; e < dim; ++e)
              {
                const auto &d = change[e];
                sum.area[e] += weight * d.integrals[OverlapColumns::area];
                sum.kept[e] += weight * d.share[k];
                // Given away is what is not kept of the area of the node.
                sum.given[e] += weight * (d.area - d.share[k]);
                sum.shape_area[e] += weight * d.shape_area;
                sum.arch[e] += weight * d.arch;
                sum.inclined[e] += weight * d.inclined;
                if (part)
                  sum.reference[e] += weight * d.reference;
                for (unsigned int c = 0; c < dim; ++c)
                  {
                    sum.gap[c][e] += weight * d.integrals[OverlapColumns::gap + c];
                    sum.normal[c][e] += weight * d.integrals[OverlapColumns::normal + c];
                    sum.moved[c][e] += weight * d.integrals[OverlapColumns::moved + c];
                  }
                for (const auto &[column, m] : of_masters)
                  result.weights[m][to][e] += weight * d.integrals[column];
                for (const auto &[l, m] : of_slaves)
                  result.weights[m][to][e] -= weight * d.share[l];
              }
          }
      }
  }



  template <unsigned int n>
  void
  AveragedRowDerivative::add_normals(const unsigned int k, const SlaveFaceDerivative<n> &face)
  {
    // Facets do not depend on the normals of their nodes, patches do.
    const bool slave_smooth = face.slave.smooth();
    for (const OverlapDerivative<n> &part : face.parts)
      {
        ByNormals &by_master = by_master_normals[part.master];
        by_master.smooth     = part.master_smooth;
        for (unsigned int m = 0; m < n; ++m)
          for (unsigned int j = 0; j < n; ++j)
            {
              // Weights W_kj make the integral with psi'_k of those with N_j.
              const double w = face.dual.weight(k, j);
              by_master.normal[m] += w * part.normal_normal[j][m];
              by_master.gap[m] += w * part.gap_normal[j][m];
              if (slave_smooth)
                {
                  const std::uint64_t key = face.slave.face().key;
                  by_slave_normals[key][m] += w * part.gap_slave_normal[j][m];
                  arch_by_slave_normals[key][m] +=
                    face.dual.positive(k, j) * part.arch_slave_normal[j][m];
                }
            }
        // Smallest gaps enter by equation (7). In most rows their derivative is zero, and the
        // search for the closest point is spared.
        if (row.needs_least())
          offer<n>(least, part.least, part.least_by_normals, face, *part.master);
        if (face.own[k] != face.slave.face().nodes[k])
          continue;
        if (row.needs_own())
          offer<n>(own,
                   part.own[k],
                   part.own_by_normals[k],
                   face,
                   *part.master,
                   row.needs_shape() ? &part.own_moved[k] : nullptr);
        // Shape functions of facets do not depend on normals.
        if (row.needs_beside())
          offer<n>(beside, part.beside[k], {}, face, *part.master);
      }
  }



  template <unsigned int n>
  void
  AveragedRowDerivative::offer(std::optional<ClosestPoint>                    &closest,
                               const PositionFad<n>                           &gap,
                               const typename OverlapDerivative<n>::ByNormals &by_normals,
                               const SlaveFaceDerivative<n>                   &face,
                               const Face                                     &master,
                               const Vector3<PositionFad<n>>                  *moved)
  {
    // A minimum has the derivative of the point where it is attained; at a change of that point the
    // derivative is one-sided.
    if (gap.val() == std::numeric_limits<double>::max() || (closest && closest->gap <= gap.val()))
      return;
    closest.emplace(ClosestPoint{gap.val(), &master, face.slave.face().key, {}, {}, {}, {}});
    std::copy(by_normals.master, by_normals.master + n, closest->by_master_normals.begin());
    std::copy(by_normals.slave, by_normals.slave + n, closest->by_slave_normals.begin());
    for (unsigned int i = 0; i < 2 * n; ++i)
      {
        // Variables are the slave nodes, then the master nodes: components 3 i to 3 i + 2.
        const Tensor<1, dim> by_node({gap.fastAccessDx(dim * i),
                                      gap.fastAccessDx(dim * i + 1),
                                      gap.fastAccessDx(dim * i + 2)});
        for (const auto &[node, weight] :
             face.carriers(i < n ? i : face.index_of_master(master.nodes[i - n])))
          {
            closest->by_nodes.emplace_back(node, weight * by_node);
            if (!moved)
              continue;
            Tensor<2, dim> &d_moved =
              closest->moved_by_nodes.emplace_back(node, Tensor<2, dim>()).second;
            for (unsigned int c = 0; c < dim; ++c)
              for (unsigned int e = 0; e < dim; ++e)
                d_moved[c][e] = weight * (*moved)[c].fastAccessDx(dim * i + e);
          }
      }
  }



  std::vector<std::uint64_t>
  AveragedRowDerivative::slave_faces() const
  {
    std::vector<std::uint64_t> result;
    for (const auto &[key, by_normals] : by_slave_normals)
      result.push_back(key);
    return result;
  }



  void
  AveragedRowDerivative::continue_closest(
    const ClosestPoint                                           &point,
    const std::function<Tensor<1, dim> &(CoverSumsDerivative &)> &of_point,
    const OfMaster                                               &of_master,
    const OfSlave                                                &of_slave)
  {
    const auto add = [&](const Index node, const Tensor<1, dim> &value) {
      const std::size_t to = index(node);
      // The member that is differentiated, CoverSumsDerivative::least or another, is a parameter.
      of_point(sums[to]) += value;
    };
    for (const auto &[node, value] : point.by_nodes)
      add(node, value);
    // Derivative by the normals times that of the normals by all nodes around the face.
    if (const auto *derivatives = of_master(point.master))
      for (const NormalDerivative &d : *derivatives)
        add(d.node, point.by_master_normals[d.m] * d.value);
    if (by_slave_normals.count(point.slave) > 0)
      for (const NormalDerivative &d : *of_slave(point.slave))
        add(d.node, point.by_slave_normals[d.m] * d.value);
  }



  void
  AveragedRowDerivative::finish_deciding(const OfMaster &of_master, const OfSlave &of_slave)
  {
    using Sums = CoverSumsDerivative;
    if (face_least)
      continue_closest(
        *face_least,
        [](Sums &of_node) -> Tensor<1, dim> & { return of_node.face.least; },
        of_master,
        of_slave);
    if (face_own)
      continue_closest(
        *face_own,
        [](Sums &of_node) -> Tensor<1, dim> & { return of_node.face.own; },
        of_master,
        of_slave);
    if (face_beside)
      continue_closest(
        *face_beside,
        [](Sums &of_node) -> Tensor<1, dim> & { return of_node.face.beside; },
        of_master,
        of_slave);
    for (const auto &[face, by_normals] : face_by_master)
      if (const auto *derivatives = of_master(face))
        for (const NormalDerivative &d : *derivatives)
          {
            FaceShareDerivative &sum = sums[index(d.node)].face;
            sum.gap += by_normals[0][d.m] * d.value;
            sum.shape_gap += by_normals[1][d.m] * d.value;
          }
    if (const FaceShare *face = row.deciding_face(); face && by_slave_normals.count(face->key) > 0)
      for (const NormalDerivative &d : *of_slave(face->key))
        {
          FaceShareDerivative &sum = sums[index(d.node)].face;
          sum.gap += face_gap_by_slave[d.m] * d.value;
          sum.shape_gap += face_shape_gap_by_slave[d.m] * d.value;
        }
  }



  std::shared_ptr<const RowDerivative>
  AveragedRowDerivative::finish(const OfMaster &of_master, const OfSlave &of_slave)
  {
    // Averaged normals of slave faces move the points of a smoothed slave face and thereby the gap.
    for (const auto &[key, by_normals] : by_slave_normals)
      for (const NormalDerivative &d : *of_slave(key))
        {
          const std::size_t to = index(d.node);
          sums[to].gap += by_normals[d.m] * d.value;
          sums[to].arch += arch_by_slave_normals[key][d.m] * d.value;
        }
    // Those of master faces change the normal, and the gap if the master is smoothed.
    for (const auto &[face, by_normals] : by_master_normals)
      if (const auto *derivatives = of_master(face))
        for (const NormalDerivative &d : *derivatives)
          {
            const std::size_t to = index(d.node);
            sums[to].normal += by_normals.normal[d.m] * d.value;
            if (by_normals.smooth)
              sums[to].gap += by_normals.gap[d.m] * d.value;
          }
    if (least)
      continue_closest(*least, std::mem_fn(&CoverSumsDerivative::least), of_master, of_slave);
    if (own)
      {
        continue_closest(*own, std::mem_fn(&CoverSumsDerivative::own), of_master, of_slave);
        for (const auto &[node, value] : own->moved_by_nodes)
          sums[index(node)].own_moved += value;
      }
    if (beside)
      continue_closest(*beside, std::mem_fn(&CoverSumsDerivative::beside), of_master, of_slave);
    finish_deciding(of_master, of_slave);

    // The sums are complete: now the row.
    RowDerivative &result = *builder.result;
    for (std::size_t a = 0; a < result.nodes.size(); ++a)
      {
        row.differentiate(sums[a], result.normal[a], result.gap_vector[a]);
        for (std::size_t m = 0; m < result.weights.size(); ++m)
          result.weights[m][a] =
            row.weight_derivative(stencil[m].weight, result.weights[m][a], sums[a]);
        if (area_changes)
          result.area.push_back(sums[a].reference);
      }
    return builder.result;
  }



  template void
  AveragedRowDerivative::add_face<4>(unsigned int, const SlaveFaceDerivative<4> &);
  template void
  AveragedRowDerivative::add_face<9>(unsigned int, const SlaveFaceDerivative<9> &);
} // namespace Touchstone

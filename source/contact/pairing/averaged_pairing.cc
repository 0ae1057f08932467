// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/averaged_derivative.h>
#include <touchstone/contact/pairing/cover_of_nodes.h>
#include <touchstone/contact/pairing/facing_part.h>
#include <touchstone/contact/pairing/pairing.h>
#include <touchstone/contact/pairing/row_sums.h>
#include <touchstone/contact/pairing/smooth_step.h>
#include <touchstone/contact/search/facing_faces.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <unordered_map>

// The pairing "averaged" (mortar with a dual basis, condensed to rows of single slave nodes):
// update() finds the covering master faces of each slave face, integrates over the common parts,
// and makes weights, normal and gap of the rows from the sums over the faces around each node
// (doc/theory.md 3, 3.1, 3.2). The rows of nodes at the border of a rank are summed on the owner of
// the node, which also knows the faces of ghost cells around it.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /**
     * Rows that pass the patch test: the weights of a stencil are averages of
     * the master shapes, weighted with the dual basis of its slave faces. With
     * int psi_s N_t = delta_st int N_s the gap of the slave side is that of the
     * node alone, so a row keeps its form.
     * A face with hanging nodes takes the basis of the continuous displacements
     * instead of its shape functions; rows belong to the nodes that the hanging ones follow.
     * Wohlmuth (2000), SIAM J. Numer. Anal. 38; on faces that are covered only in
     * part the basis is dual on the covered part: Popp, Seitz, Gee and Wall (2013),
     * Comput. Methods Appl. Mech. Engng 264. Nodes of which little is covered give
     * their part to others (CoverShares), whose stencils then contain them.
     */
    class AveragedPairing : public Pairing
    {
    public:
      explicit AveragedPairing(const PairingInput &input)
        : Pairing(input)
        , search(*input.master,
                 input.search_distance > 0.
                   ? input.search_distance
                   : std::max(input.slave->largest_face(), input.master->largest_face()),
                 input.parameters->edge_tolerance,
                 input.parameters->master_normal,
                 input.solid->communicator)
        , facing(search,
                 Tolerances::negligible_motion *
                   std::min(input.slave->shortest_edge(), input.master->shortest_edge()))
        , kind(input.parameters->master_normal)
        , tied(input.parameters->tied())
      {
        for (const SurfaceNode &node : input.slave->owned_nodes())
          row_of_node.emplace(node.node, static_cast<int>(row_of_node.size()));
        sums.resize(row_of_node.size());
        // Of owned and of ghost cells: with all faces around an owned node its sums are
        // complete here without another rank.
        for (const auto *list : {&input.slave->owned_faces(), &input.slave->neighbour_faces()})
          for (const Face &face : *list)
            {
              const TraceBasis *const basis = input.slave->trace(face);
              SlaveFace               slave{
                &face, basis, {}, whole_areas(face, basis, /*reference=*/true), {}, {}};
              slave.cover.fill(-1.);
              // Tied rows are made once and need not change smoothly.
              slave.at_once.part.fill(tied ? 1. : 0.);
              slave.at_once.gives = face.without_row;
              bool any            = false;
              for (unsigned int m = 0; m < face.n_nodes(); ++m)
                {
                  const auto found =
                    row_of_node.find(slave.basis ? slave.basis->nodes[m] : face.nodes[m]);
                  slave.row[m] = found != row_of_node.end() ? found->second : -1;
                  any          = any || found != row_of_node.end();
                }
              // Faces without a node of this rank contribute to no row here.
              if (any)
                faces.push_back(slave);
            }
        std::sort(faces.begin(), faces.end(), [](const SlaveFace &a, const SlaveFace &b) {
          return a.face->key < b.face->key;
        });
        // Copies, in which the displacement at the start of the step is kept as well.
        slave_faces.reserve(faces.size());
        for (const SlaveFace &face : faces)
          slave_faces.push_back({*face.face, {}});
        search.commit(nullptr);
        // Either both sides of the gap are smooth or none: the deviation of facets on one side
        // from their smooth surface would be taken for a gap. The normals of
        // faces of ghost cells are known to their owners only.
        if (kind == MasterNormal::smoothed)
          slave_exchange = std::make_unique<FaceExchange>(*input.slave,
                                                          input.slave->largest_face(),
                                                          kind,
                                                          input.solid->communicator);
      }

      void
      commit_positions(const Vector &u) override;

      void
      update(const Vector &u, double, std::vector<ContactRow> &rows) override;

      void
      differentiate(const Vector &, double, std::vector<ContactRow> &rows) override;

      PairingMemory
      memory() const override
      {
        return {{}, facing.last_touched()};
      }

      void
      remember(const PairingMemory &memory) override
      {
        // The memory has the faces of all ranks; this rank keeps those of its own slave faces.
        FacingFaces::Touched own;
        for (const CoveredFace &covered : slave_faces)
          if (const auto found = memory.of_faces.find(covered.slave.key);
              found != memory.of_faces.end())
            own.insert(*found);
        facing.remember(own);
        searched.clear();
        present.clear();
        step_begins = true;
      }

      const CoverOfNodes *
      cover() const override
      {
        return input.one_of_several ? &covered_nodes : nullptr;
      }

      bool
      set_cover_by_others(const Vector *part) override;

      SearchWork
      search_work() const override
      {
        SearchWork work = search.work();
        if (slave_exchange)
          work += slave_exchange->work();
        return work;
      }

    private:
      Search       search;
      FacingFaces  facing;
      MasterNormal kind;
      /** Rows of tied pairs are made once, so they need not depend smoothly on the cover. */
      const bool tied;
      /** The slave faces, only if they are smoothed. */
      std::unique_ptr<FaceExchange> slave_exchange;

      /** Of the last update: sums in the order of the owned nodes, and the slave faces
       * around them, in the order of `faces`. */
      std::vector<RowSums>     sums;
      std::vector<CoveredFace> slave_faces;

      /** A face with nodes of this rank: its continuous basis, if it has hanging nodes, and
       * the indices of the rows of its nodes; negative: of another rank. */
      struct SlaveFace
      {
        const Face                      *face;
        const TraceBasis                *basis;
        std::array<int, Face::max_nodes> row;
        /** whole_areas() in the reference state. */
        std::array<double, Face::max_nodes> whole;
        /** Of CoverShares. */
        CoverShares::Whole at_once;
        /** CoverShares::cover of the last update; negative: not covered. */
        std::array<double, Face::max_nodes> cover;
      };

      /** What is covered since the last update, if there are other pairs; and whether what these
       * cover has changed since. */
      CoverOfNodes covered_nodes;
      /** The next update is that of the committed state, which is not known since a restart. */
      bool step_begins = false;

      /** The committed state is that of the last update. */
      void
      set_before()
      {
        for (SlaveFace &face : faces)
          for (unsigned int m = 0; m < face.face->n_nodes(); ++m)
            face.at_once.before[m] =
              face.cover[m] < 0. ? -1 : static_cast<int>(CoverShares::keeps(face.cover[m], -1));
        set_keep_rows();
      }
      /** The areas of nodes that are to leave their rows to others, on faces that cannot take them:
       * of the last update. */
      CoverOfNodes::Areas left_alone;
      /** The committed state, or the first one, decides which nodes keep their rows. */
      bool first_cover = true;

      void
      set_keep_rows()
      {
        covered_nodes.keep_rows.clear();
        for (const auto &[node, area] : left_alone)
          if (area.norm() > Tolerances::least_cover * covered_nodes.whole.at(node).norm())
            covered_nodes.keep_rows.insert(node);
      }
      bool others_changed = false;

      /** Indices of the rows of the owned nodes, and the slave faces around these in the order
       * of their keys. */
      std::unordered_map<Index, int> row_of_node;
      std::vector<SlaveFace>         faces;

      /** Geometries of the faces that the search knows, made on demand. */
      std::vector<std::optional<FaceGeometry>> geometries;

      /** Displacements of the faces of this rank, slaves and then masters: of the last
       * update, if any, and when all facing faces were looked for last. */
      std::vector<Tensor<1, dim>> present, searched;

      const FaceGeometry &
      geometry(const Face &master);
      /** Discard the candidates for covering faces if any node, on any rank, has moved so far that
       * other faces may cover each other. Collective. */
      void
      watch_motion();
      /** Whether any face has moved since the last update. A step begins where the one before has
       * ended, and nothing need be integrated again. Collective. */
      bool
      has_moved();
      void
      integrate();
      /** @tparam n Nodes of the face. */
      template <unsigned int n>
      void
      add_face(SlaveFace &face, CoveredFace &covered);
      /** Note what nodes without rows have of a face whose other nodes cannot take it.
       * @param areas Of what is covered, by node. @param plane plane_normal() of the face. */
      void
      add_left_alone(const SlaveFace         &face,
                     const Face              &slave,
                     const DualBasis::Values &areas,
                     const Tensor<1, dim>    &plane);
      /** Add the parts of the face that nodes give to others. @param shares Of the face. */
      void
      add_shares(const SlaveFace &face, const Face &slave, const CoverShares &shares);
      /** Present positions of the nodes to which the rows of a slave face belong. */
      static std::vector<Point<dim>>
      carrier_positions(const SlaveFace &face, const Face &slave);
    };

    const PairingRegistry::Entry<AveragedPairing> averaged_pairing_entry(
      "averaged",
      "averages over the slave faces with a dual basis; passes the patch test");



    void
    AveragedPairing::commit_positions(const Vector &u)
    {
      // The covering faces of the converged state tell what each slave face touches when the next
      // step begins.
      facing.commit(slave_faces);
      search.commit(&u);
      set_before();
      // The motion within a step is counted from here: candidates are searched anew.
      searched.clear();
      for (CoveredFace &covered : slave_faces)
        for (unsigned int m = 0; m < covered.slave.n_nodes(); ++m)
          for (unsigned int d = 0; d < dim; ++d)
            covered.slave.committed[m][d] = u(dim * covered.slave.nodes[m] + d);
    }



    const FaceGeometry &
    AveragedPairing::geometry(const Face &master)
    {
      auto &result = geometries[search.exchange().index(master)];
      if (!result)
        result.emplace(search.geometry(master));
      return *result;
    }



    void
    AveragedPairing::watch_motion()
    {
      // All nodes of this rank's slave and master faces are compared with where they were at the
      // last search. One rank alone cannot decide: a master face that moves on one rank may come
      // near a slave face of another.
      const double square = facing.motion() * facing.motion();
      bool         close  = searched.size() == present.size();
      for (std::size_t i = 0; close && i < present.size(); ++i)
        close = (present[i] - searched[i]).norm_square() <= square;
      if (Utilities::MPI::min(close ? 1 : 0, input.solid->communicator) == 1)
        return;
      facing.invalidate();
      searched = present;
    }



    bool
    AveragedPairing::has_moved()
    {
      // Exact equality is meant: the first update of a step has the displacements of the last
      // update of the step before, and the integrals can be kept. All ranks must agree, since
      // integrate() communicates.
      std::vector<Tensor<1, dim>> now;
      for (const Surface *surface : {input.slave, input.master})
        for (const Face &face : surface->owned_faces())
          now.insert(now.end(),
                     face.displacement.begin(),
                     face.displacement.begin() + face.n_nodes());
      const bool same = now == present && !others_changed;
      others_changed  = false;
      present.swap(now);
      return Utilities::MPI::min(same ? 1 : 0, input.solid->communicator) == 0;
    }



    template <unsigned int n>
    void
    AveragedPairing::add_face(SlaveFace &face, CoveredFace &covered)
    {
      face.cover.fill(-1.);
      const Face                    &slave   = covered.slave;
      const std::vector<FacingFace> &masters = covered.masters = facing.find(slave);
      if (masters.empty())
        return;
      const FaceGeometry on_slave(slave, input.slave->exact_surface(slave), kind);
      // Points of both faces are paired along the normal of this plane.
      const Tensor<1, dim> plane = plane_normal(slave);

      // Integrals over what each master face covers: M_jk and Q_jc of doc/theory.md 4.
      std::vector<OverlapIntegrals<n, double>> parts(
        masters.size(), OverlapIntegrals<n, double>(input.slave->largest_face()));
      OverlapSample<n, double> sample;
      for (std::size_t f = 0; f < masters.size(); ++f)
        {
          const FaceGeometry &on_master = geometry(*masters[f].master);
          for (const OverlapPoint &point : masters[f].points)
            if (evaluate<n>(point, on_slave, on_master, plane, sample))
              parts[f].add(sample);
        }
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
          RowSums &sum = sums[face.row[k]];
          sum.shared   = face.at_once.part[k];
          if (input.one_of_several)
            covered_nodes.add<n>(
              input.slave->owned_nodes()[face.row[k]], k, plane, dual, masters, parts);
          // Where the node hangs the row is that of another node, which is not on this face.
          FaceShare *share = nullptr;
          if (!face.basis || face.basis->nodes[k] == slave.nodes[k])
            {
              share      = &sum.faces.emplace_back();
              share->key = slave.key;
            }
          for (std::size_t f = 0; f < masters.size(); ++f)
            sum.add<n>(k, dual, *masters[f].master, parts[f], share);
          // D_kk of equation (5), the area given to other nodes, and D_kk in the reference state,
          // for tractions are nominal (doc/theory.md 2.2).
          const double kept = dual.shares.share[k][k];
          sum.kept += kept;
          sum.given += dual.areas[k] - kept;
          if (face.at_once.gives[k] && !tied)
            sum.left_to_others += dual.areas[k] - kept;
          sum.reference += kept * face.whole[k] / present[k];
        }
      if (input.one_of_several)
        add_left_alone(face, slave, dual.areas, plane);
      if (dual.shares.partial)
        add_shares(face, slave, dual.shares);
    }



    void
    AveragedPairing::add_left_alone(const SlaveFace         &face,
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
          left_alone[input.slave->owned_nodes()[face.row[k]].node] -= areas[k] * plane;
    }



    bool
    AveragedPairing::set_cover_by_others(const Vector *const part)
    {
      if (tied)
        return false;
      bool changed = false;
      for (SlaveFace &face : faces)
        for (unsigned int m = 0; m < face.face->n_nodes(); ++m)
          {
            const Index dof = dim * (face.basis ? face.basis->nodes[m] : face.face->nodes[m]);
            // What hanging nodes follow may lie beyond what this rank sees.
            const bool known = part && part->trilinos_partitioner().MyGID(
                                         static_cast<TrilinosWrappers::types::int_type>(dof));
            const double value = known ? (*part)(dof) : 0.;
            const bool   gives = face.face->without_row[m] && !(known && (*part)(dof + 1) > 0.);
            changed = changed || value != face.at_once.part[m] || gives != face.at_once.gives[m];
            face.at_once.part[m]  = value;
            face.at_once.gives[m] = gives;
          }
      others_changed = others_changed || changed;
      return changed;
    }



    std::vector<Point<dim>>
    AveragedPairing::carrier_positions(const SlaveFace &face, const Face &slave)
    {
      const unsigned int      n = slave.n_nodes();
      std::vector<Point<dim>> x;
      for (unsigned int i = 0; i < n; ++i)
        x.push_back(slave.position(i));
      if (!face.basis)
        return x;
      // The nodes that those of the face follow: x_i = sum C_ip x_p.
      // A node that a hanging one follows need not belong to the face, so its position is not
      // stored with it: invert C.
      FullMatrix<double> inverse(n, n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int p = 0; p < n; ++p)
          inverse(i, p) = face.basis->weights[i][p];
      inverse.gauss_jordan();
      std::vector<Point<dim>> result(n);
      for (unsigned int p = 0; p < n; ++p)
        for (unsigned int i = 0; i < n; ++i)
          result[p] += inverse(p, i) * x[i];
      return result;
    }



    void
    AveragedPairing::add_shares(const SlaveFace &face, const Face &slave, const CoverShares &shares)
    {
      const unsigned int            n     = slave.n_nodes();
      const auto                   &nodes = face.basis ? face.basis->nodes : slave.nodes;
      const std::vector<Point<dim>> x     = carrier_positions(face, slave);
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
    AveragedPairing::integrate()
    {
      for (RowSums &sum : sums)
        sum.clear();
      covered_nodes.clear();
      left_alone.clear();

      // Bring the copies of the slave faces to the present state. Master faces are wanted around
      // the nodes where they are and where they were at the start of the step, for SweptSearch.
      std::vector<Point<dim>> positions;
      for (std::size_t f = 0; f < faces.size(); ++f)
        {
          const Face &now    = *faces[f].face;
          Face       &slave  = slave_faces[f].slave;
          slave.displacement = now.displacement;
          slave.normals      = now.normals;
          slave.edge_normals = now.edge_normals;
          slave.own_normals  = now.own_normals;
          // Planes of symmetry are known only after the pairing has been made.
          slave.mirrored_edges = now.mirrored_edges;
          for (unsigned int m = 0; m < slave.n_nodes(); ++m)
            {
              positions.push_back(slave.reference[m] + slave.displacement[m]);
              positions.push_back(slave.reference[m] + slave.committed[m]);
            }
        }
      search.update(positions);
      if (slave_exchange)
        {
          slave_exchange->update(positions);
          for (CoveredFace &covered : slave_faces)
            {
              const Face &complete         = *slave_exchange->face(covered.slave.key);
              covered.slave.normals        = complete.normals;
              covered.slave.edge_normals   = complete.edge_normals;
              covered.slave.own_normals    = complete.own_normals;
              covered.slave.outer_edges    = complete.outer_edges;
              covered.slave.mirrored_edges = complete.mirrored_edges;
            }
        }
      // Faces of the search have changed or moved.
      geometries.clear();
      geometries.resize(search.known_faces().size());
      watch_motion();
      for (std::size_t f = 0; f < faces.size(); ++f)
        {
          for (unsigned int k = 0; input.one_of_several && k < faces[f].face->n_nodes(); ++k)
            if (faces[f].row[k] >= 0)
              covered_nodes.add_whole(input.slave->owned_nodes()[faces[f].row[k]].node,
                                      k,
                                      slave_faces[f].slave,
                                      faces[f].basis);
          if (slave_faces[f].slave.degree == 1)
            add_face<4>(faces[f], slave_faces[f]);
          else
            add_face<9>(faces[f], slave_faces[f]);
        }
      for (std::size_t k = 0; k < sums.size(); ++k)
        {
          sums[k].finish();
          const MirrorImages &images = input.slave->images(input.slave->owned_nodes()[k].node);
          if (!images.empty())
            sums[k].images = images.all(sums[k].normal);
        }
      if (step_begins)
        set_before();
      else if (first_cover)
        set_keep_rows();
      step_begins = first_cover = false;
    }



    void
    AveragedPairing::update(const Vector &, const double, std::vector<ContactRow> &rows)
    {
      if (has_moved())
        integrate();
      const std::vector<SurfaceNode> &nodes = input.slave->owned_nodes();
      for (std::size_t k = 0; k < nodes.size(); ++k)
        {
          ContactRow    &row = rows[k];
          const RowSums &sum = sums[k];
          row.stencil.clear();
          if (!sum.suffices(nodes[k].area))
            {
              // Too little is left of the node for a row: it carries no force.
              row.has_partner = false;
              row.gap         = 0.;
              row.share       = 1.;
              row.lever       = Tensor<1, dim>();
              continue;
            }
          row.has_partner = true;
          for (const StencilEntry &entry : sum.stencil)
            // Weights are integrals over D_kk (equation (5)); zeros by round-off would only enlarge
            // the matrix pattern.
            if (std::abs(entry.weight) > Tolerances::negligible_weight * sum.area)
              row.stencil.push_back({entry.node, entry.weight / sum.kept});
          // Mean normal and gap with the corrections of equations (6) and (7).
          const AveragedRow means(sum, nodes[k].size);
          row.share      = means.share;
          row.normal     = means.normal;
          row.gap_vector = means.gap_vector;
          row.gap        = row.gap_vector * row.normal;
          row.lever      = sum.lever / sum.area;
          // Not more than the tributary area, by round-off or by the ratio of reference to present
          // areas.
          row.area = std::min(sum.reference, nodes[k].area);
        }
    }



    void
    AveragedPairing::differentiate(const Vector &, const double, std::vector<ContactRow> &rows)
    {
      // All ranks must take part: finish() is collective.
      AveragedDerivative derivative(search.exchange(),
                                    slave_exchange.get(),
                                    input.slave->largest_face());
      for (const ContactRow &row : rows)
        if (row.was_active && !row.between_nodes)
          derivative.add_row(row.slave,
                             row.stencil,
                             sums[row_of_node.at(row.slave)],
                             row.size,
                             row.friction != nullptr);
      for (std::size_t f = 0; f < faces.size(); ++f)
        if (const auto &[slave, masters] = slave_faces[f]; derivative.wants(slave, faces[f].basis))
          derivative.add_face(FaceGeometry(slave, input.slave->exact_surface(slave), kind),
                              faces[f].basis,
                              masters_of(masters),
                              faces[f].at_once);
      const auto derivatives = derivative.finish();
      for (ContactRow &row : rows)
        if (!row.between_nodes)
          row.derivative = row.was_active ? derivatives.at(row.slave) : nullptr;
    }
  } // namespace
} // namespace Touchstone

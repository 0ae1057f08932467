// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/averaged_derivative.h>
#include <touchstone/contact/pairing/averaged_sums.h>
#include <touchstone/contact/pairing/pairing.h>
#include <touchstone/contact/pairing/surface_motion.h>
#include <touchstone/contact/search/facing_faces.h>

#include <algorithm>
#include <optional>
#include <unordered_map>

// The pairing "averaged" (mortar with a dual basis, condensed to rows of single slave nodes):
// update() finds the covering master faces of each slave face, integrates over the common parts
// (AveragedSums), and makes weights, normal and gap of the rows from the sums over the faces around
// each node (doc/theory.md 3, 3.1, 3.2). The rows of nodes at the border of a rank are summed on
// the owner of the node, which also knows the faces of ghost cells around it.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The rows of the owned nodes of a surface. */
    std::unordered_map<Index, int>
    rows_of_nodes(const Surface &slave)
    {
      std::unordered_map<Index, int> rows;
      for (const SurfaceNode &node : slave.owned_nodes())
        rows.emplace(node.node, static_cast<int>(rows.size()));
      return rows;
    }



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
                 input.solid->communicator,
                 // Integrals over faces do not jump where one of these ends.
                 Arch::with_facet)
        , facing(search,
                 Tolerances::negligible_motion *
                   std::min(input.slave->shortest_edge(), input.master->shortest_edge()))
        , motion(*input.slave, *input.master, input.solid->communicator)
        , kind(input.parameters->master_normal)
        , tied(input.parameters->tied())
        , row_of_node(rows_of_nodes(*input.slave))
        , faces(averaged_faces(*input.slave, row_of_node, tied))
        , sums(*input.slave, kind, tied, input.one_of_several)
      {
        // Copies, in which the displacement at the start of the step is kept as well.
        slave_faces.reserve(faces.size());
        for (const AveragedFace &face : faces)
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
        motion.forget();
        step_begins = true;
      }

      const CoverOfNodes *
      cover() const override
      {
        return input.one_of_several ? &sums.cover() : nullptr;
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
      Search        search;
      FacingFaces   facing;
      SurfaceMotion motion;
      MasterNormal  kind;
      /** Rows of tied pairs are made once, so they need not depend smoothly on the cover. */
      const bool tied;
      /** The slave faces, only if they are smoothed. */
      std::unique_ptr<FaceExchange> slave_exchange;

      /** Indices of the rows of the owned nodes, and the slave faces around these. */
      const std::unordered_map<Index, int> row_of_node;
      std::vector<AveragedFace>            faces;

      /** Of the last update: sums over the slave faces, and these in their present position, in the
       * order of `faces`. */
      AveragedSums             sums;
      std::vector<CoveredFace> slave_faces;

      /** The next update is that of the committed state, which is not known since a restart. */
      bool step_begins = false;
      /** The first update decides, as the committed state does, which nodes keep their rows. */
      bool first_cover = true;
      /** What other pairs cover has changed since the last update. */
      bool others_changed = false;

      /** The committed state is that of the last update. */
      void
      set_before();
      /** Bring the copies of the slave faces to the present state, and get the master faces around
       * them. Collective. */
      void
      move_faces();
      /** Find what covers the slave faces and sum over them. Collective. */
      void
      integrate();
      /** @param row Of node @p k of the owned ones. */
      void
      make_row(std::size_t k, ContactRow &row) const;
    };

    const PairingRegistry::Entry<AveragedPairing> averaged_pairing_entry(
      "averaged",
      "averages over the slave faces with a dual basis; passes the patch test");



    void
    AveragedPairing::set_before()
    {
      for (AveragedFace &face : faces)
        face.commit();
      sums.set_keep_rows();
    }



    void
    AveragedPairing::commit_positions(const Vector &u)
    {
      // The covering faces of the converged state tell what each slave face touches when the next
      // step begins.
      facing.commit(slave_faces);
      search.commit(&u);
      set_before();
      // The motion within a step is counted from here: candidates are searched anew.
      motion.forget_search();
      for (CoveredFace &covered : slave_faces)
        for (unsigned int m = 0; m < covered.slave.n_nodes(); ++m)
          for (unsigned int d = 0; d < dim; ++d)
            covered.slave.committed[m][d] = u(dim * covered.slave.nodes[m] + d);
    }



    bool
    AveragedPairing::set_cover_by_others(const Vector *const part)
    {
      if (tied)
        return false;
      bool changed = false;
      for (AveragedFace &face : faces)
        changed = face.set_cover_by_others(part) || changed;
      others_changed = others_changed || changed;
      return changed;
    }



    void
    AveragedPairing::move_faces()
    {
      // Master faces are wanted around the nodes where they are and where they were at the start of
      // the step, for SweptSearch.
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
    }



    void
    AveragedPairing::integrate()
    {
      sums.clear();
      move_faces();
      if (motion.exceeds(facing.motion()))
        facing.invalidate();
      // Of the master faces, made on demand.
      std::vector<std::optional<FaceGeometry>> geometries(search.known_faces().size());
      std::vector<const FaceGeometry *>        on_masters;
      for (std::size_t f = 0; f < faces.size(); ++f)
        {
          auto &[slave, masters] = slave_faces[f];
          masters                = facing.find(slave);
          on_masters.clear();
          for (const FacingFace &covering : masters)
            {
              auto &geometry = geometries[search.exchange().index(*covering.master)];
              if (!geometry)
                geometry.emplace(search.geometry(*covering.master));
              on_masters.push_back(&*geometry);
            }
          sums.add(faces[f], slave, masters, on_masters);
        }
      sums.finish();
      if (step_begins)
        set_before();
      else if (first_cover)
        sums.set_keep_rows();
      step_begins = first_cover = false;
    }



    void
    AveragedPairing::update(const Vector &, const double, std::vector<ContactRow> &rows)
    {
      const bool moved = motion.has_moved(others_changed);
      others_changed   = false;
      if (moved)
        integrate();
      for (std::size_t k = 0; k < input.slave->owned_nodes().size(); ++k)
        make_row(k, rows[k]);
    }



    void
    AveragedPairing::make_row(const std::size_t k, ContactRow &row) const
    {
      const SurfaceNode &node = input.slave->owned_nodes()[k];
      const RowSums     &sum  = sums[k];
      row.stencil.clear();
      if (!sum.suffices(node.area))
        {
          // Too little is left of the node for a row: it carries no force.
          row.has_partner = false;
          row.gap         = 0.;
          row.share       = 1.;
          row.lever       = Tensor<1, dim>();
          return;
        }
      row.has_partner = true;
      for (const StencilEntry &entry : sum.stencil)
        // Weights are integrals over D_kk (equation (5)); zeros by round-off would only enlarge the
        // matrix pattern.
        if (std::abs(entry.weight) > Tolerances::negligible_weight * sum.area)
          row.stencil.push_back({entry.node, entry.weight / sum.kept});
      // Mean normal and gap with the corrections of equations (6) and (7).
      const AveragedRow means(sum, node.size);
      row.share      = means.share;
      row.normal     = means.normal;
      row.gap_vector = means.gap_vector;
      row.gap        = row.gap_vector * row.normal;
      row.lever      = sum.lever / sum.area;
      // Not more than the tributary area, by round-off or by the ratio of reference to present
      // areas.
      row.area = std::min(sum.reference, node.area);
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

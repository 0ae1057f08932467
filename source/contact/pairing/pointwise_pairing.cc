// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/aggregated_rows.h>
#include <touchstone/contact/pairing/edges_under_nodes.h>
#include <touchstone/contact/pairing/end_of_surface.h>
#include <touchstone/contact/pairing/pairing.h>
#include <touchstone/contact/pairing/pointwise_row.h>

// The pairing "pointwise": each slave node against the closest point of the master surface. It is
// simple, but does not pass the patch test (doc/theory.md 3). The rows themselves are in
// pointwise_row.cc.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Node-to-surface: the stencil of a slave node are the shape functions of
     * the master face at the closest point. */
    class PointwisePairing : public Pairing
    {
    public:
      explicit PointwisePairing(const PairingInput &input)
        : Pairing(input)
        , search(*input.master,
                 // A node that has penetrated by more than the size of a face must still find
                 // the surface.
                 input.search_distance > 0.
                   ? input.search_distance
                   : 4. * std::max(input.slave->largest_face(), input.master->largest_face()),
                 input.parameters->edge_tolerance,
                 input.parameters->master_normal,
                 input.solid->communicator)
        , aggregated(input)
        , edges(input)
      {
        search.commit(nullptr);
        for (const SurfaceNode &node : input.slave->owned_nodes())
          start.push_back(node.reference);
        present_faces.resize(start.size());
        indices.resize(start.size());
        if (input.parameters->of_one_body())
          {
            self.emplace(input.slave->boundaries(), input.master->boundaries());
            for (const SurfaceNode &node : input.slave->owned_nodes())
              also_master.push_back(self->is_master(*input.slave, node.node));
          }
      }

      void
      commit_positions(const Vector &u) override
      {
        search.commit(&u);
        const std::vector<SurfaceNode> &nodes = input.slave->owned_nodes();
        for (std::size_t k = 0; k < nodes.size(); ++k)
          start[k] = input.slave->position(nodes[k], u);
        edges.commit();
      }

      void
      begin_step() override
      {
        edges.begin_step();
      }

      bool
      leave_edges() override
      {
        return edges.leave();
      }

      bool
      on_edge(const std::size_t k) const override
      {
        return edges[k].has_value();
      }

      void
      rollback() override
      {
        end.rollback();
      }

      void
      update(const Vector &u, double, std::vector<ContactRow> &rows) override;

      void
      differentiate(const Vector &, double, std::vector<ContactRow> &rows) override;

      PairingMemory
      memory() const override
      {
        PairingMemory result{present_faces, {}};
        edges.save(result.of_rows);
        return result;
      }

      void
      remember(const PairingMemory &memory) override
      {
        present_faces = memory.of_rows;
        edges.load(present_faces);
      }

      SearchWork
      search_work() const override
      {
        return search.work();
      }

    private:
      Search search;
      /** Where nodes leave their rows to others. */
      AggregatedRows aggregated;
      EndOfSurface   end;
      /** Of the last update, in the order of the rows. */
      std::vector<std::optional<ContactPartner>> partners;
      /** And the edges that nodes stand on, which take the place of partners. */
      EdgesUnderNodes edges;
      /** Keys of the faces that were the partners of the nodes in the last update. */
      std::vector<std::optional<std::uint64_t>> present_faces;
      /** And their indices in the search, where they are most likely found again. */
      std::vector<std::size_t> indices;
      /** Positions of the slave nodes at the start of the step. */
      std::vector<Point<dim>> start;
      /** Where slave and master are the same body, and then whether nodes are master nodes, too. */
      std::optional<SelfContact> self;
      std::vector<bool>          also_master;

      SlavePoint
      slave_point(const std::size_t k, const Point<dim> &x, const ContactRow &row) const;
    };

    const PairingRegistry::Entry<PointwisePairing>
      pointwise_pairing_entry("pointwise", "node-to-surface by closest-point projection");



    SlavePoint
    PointwisePairing::slave_point(const std::size_t k,
                                  const Point<dim> &x,
                                  const ContactRow &row) const
    {
      SlavePoint point{
        x, start[k], input.slave->normal(row.slave), row.was_active, present_faces[k], indices[k]};
      point.stays_at_end = end.stays(k, row);
      const auto around  = input.slave->faces_around(row.slave);
      point.is_plain     = std::all_of(around.begin(), around.end(), [&](const auto &face) {
        return face.first->own_normals[face.second] * point.normal > Tolerances::sharp_node_cosine;
      });
      if (self)
        {
          point.self      = &*self;
          point.node      = row.slave;
          point.reference = row.reference;
          for (const auto &[face, m] : around)
            point.made_normals.push_back(face->made_normals[m]);
          point.also_master = also_master[k];
        }
      return point;
    }



    void
    PointwisePairing::update(const Vector &u, const double time, std::vector<ContactRow> &rows)
    {
      end.begin(time, rows);
      const std::vector<SurfaceNode> &nodes = input.slave->owned_nodes();
      std::vector<Point<dim>>         positions;
      for (const SurfaceNode &node : nodes)
        positions.push_back(input.slave->position(node, u));
      // Master faces are needed where nodes are and where they began the step, for nodes that pass
      // through faces.
      std::vector<Point<dim>> all(positions);
      all.insert(all.end(), start.begin(), start.end());
      search.update(all);
      partners.resize(nodes.size());
      for (std::size_t k = 0; k < nodes.size(); ++k)
        {
          ContactRow      &row   = rows[k];
          const SlavePoint point = slave_point(k, positions[k], row);
          row.stencil.clear();
          row.share = 1.;
          row.lever = Tensor<1, dim>();
          row.area  = nodes[k].area;
          if (edges.find(k, search, point, row.size, BeyondEdge::along_master_normal))
            {
              // Which of the faces beside the edge comes after it is not known.
              partners[k].reset();
              present_faces[k].reset();
              row.has_partner = true;
              edges[k]->set(row);
              continue;
            }
          const auto &partner = partners[k] = search.find(point);
          // The face of this update is preferred in the next one, also in the next step and after a
          // restart (memory()).
          present_faces[k] =
            partner ? std::optional<std::uint64_t>(partner->face->key) : std::nullopt;
          if (partner)
            indices[k] = search.exchange().index(*partner->face);
          if (!partner)
            {
              end.left(k, row);
              row.has_partner = false;
              row.gap         = 0.;
              // A face of the own body that is closer may come to count as it turns.
              row.away = self ? 0. : search.distance();
              continue;
            }
          row.has_partner             = true;
          const Tensor<1, dim> before = row.normal;
          set_pointwise_row(*partner, positions[k], row);
          // A node in contact that has come over a sharp edge and is in front of the face beyond it
          // has left: its row is not to close the gap there first.
          if (row.was_active && row.gap > Tolerances::touching * row.size &&
              row.normal * before < Tolerances::sharp_edge_cosine)
            {
              partners[k].reset();
              row.has_partner = false;
              row.away        = row.gap;
              row.gap         = 0.;
              row.stencil.clear();
            }
        }
      if (edges.end_update(u))
        return update(u, time, rows);
      aggregated.aggregate(rows);
    }



    void
    PointwisePairing::differentiate(const Vector &u, const double, std::vector<ContactRow> &rows)
    {
      const std::vector<SurfaceNode> &nodes = input.slave->owned_nodes();
      std::vector<const Face *>       needed;
      for (std::size_t k = 0; k < nodes.size(); ++k)
        if (rows[k].was_active && edges[k])
          edges[k]->add_faces(needed);
        else if (rows[k].was_active)
          add_faces(*partners[k], needed);
      // Collective: also without active rows on this rank.
      const auto of_normals = search.normal_derivatives(needed);
      for (std::size_t k = 0; k < nodes.size(); ++k)
        {
          rows[k].derivative.reset();
          if (rows[k].was_active && edges[k])
            edges[k]->differentiate(*input.slave, of_normals, rows[k]);
          else if (rows[k].was_active)
            differentiate_pointwise_row(
              search, of_normals, *partners[k], input.slave->position(nodes[k], u), rows[k]);
        }
      aggregated.differentiate(rows);
    }
  } // namespace
} // namespace Touchstone

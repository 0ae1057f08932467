// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/contact/geometry/deformed_cells.h>
#include <touchstone/contact/geometry/surface_cone.h>
#include <touchstone/contact/pairing/edge_search.h>
#include <touchstone/contact/pairing/nodes_on_edges.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <iterator>
#include <set>

// Rows for what touches between slave nodes: edges that cross, and vertices of the master in slave
// faces (doc/theory.md 4.2). They are added to those of another pairing, whichever that is. Where
// such a row stands for the row of a node, which would push along one of the faces beside an edge,
// the row of the node is taken away.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    class EdgePairing : public Pairing
    {
    public:
      EdgePairing(const PairingInput &input, const std::shared_ptr<Pairing> &of_nodes)
        : Pairing(input)
        , of_nodes(of_nodes)
        , search(input)
        , n(input.slave->owned_nodes().size())
        , present(n)
        , keys(n)
      {
        for (std::size_t k = 0; k < n; ++k)
          numbers[input.slave->owned_nodes()[k].node] = k;
        // Pointwise rows have the direction of edges already.
        if (input.parameters->pairing.name != "pointwise")
          on_edges.emplace(input, of_nodes->beyond_edge());
      }

      unsigned int
      rows_between_nodes() const override
      {
        return 1;
      }

      void
      commit_positions(const Vector &u) override
      {
        of_nodes->commit_positions(u);
        search.commit(&u);
        if (on_edges)
          on_edges->commit(u);
        step_begins = true;
      }

      void
      begin_step() override
      {
        of_nodes->begin_step();
        if (on_edges)
          on_edges->decisions().begin_step();
      }

      bool
      leave_edges() override
      {
        const bool first = of_nodes->leave_edges();
        return (on_edges && on_edges->decisions().leave()) || first;
      }

      void
      rollback() override
      {
        of_nodes->rollback();
      }

      void
      update(const Vector &u, double time, std::vector<ContactRow> &rows) override;

      void
      differentiate(const Vector &u, double time, std::vector<ContactRow> &rows) override;

      bool
      on_edge(const std::size_t k) const override
      {
        return on_edges ? on_edges->replaces(k) : of_nodes->on_edge(k);
      }

      PairingMemory
      memory() const override
      {
        PairingMemory result = of_nodes->memory();
        result.of_rows.resize(n);
        if (on_edges)
          on_edges->decisions().save(result.of_rows);
        result.of_rows.insert(result.of_rows.end(), keys.begin(), keys.end());
        return result;
      }

      void
      remember(const PairingMemory &memory) override
      {
        PairingMemory first = memory;
        first.of_rows.resize(n);
        if (on_edges)
          on_edges->decisions().load(first.of_rows);
        of_nodes->remember(first);
        keys.assign(memory.of_rows.begin() + n, memory.of_rows.end());
      }

      const CoverOfNodes *
      cover() const override
      {
        return of_nodes->cover();
      }

      bool
      set_cover_by_others(const Vector *const part) override
      {
        return of_nodes->set_cover_by_others(part);
      }

      SearchWork
      search_work() const override
      {
        SearchWork result = of_nodes->search_work();
        result += search.work();
        if (on_edges)
          result += on_edges->work();
        return result;
      }

    private:
      const std::shared_ptr<Pairing> of_nodes;
      EdgeSearch                     search;
      /** Rows of nodes on parallel edges, where `of_nodes` does not make them. */
      std::optional<NodesOnEdges> on_edges;
      /** Of slave nodes that this rank owns. */
      const std::size_t                      n;
      std::unordered_map<Index, std::size_t> numbers;
      /** What each row between nodes describes since the last update. */
      std::vector<std::shared_ptr<const ContactBetweenNodes>> present;
      /** The keys of the edges and vertices of the master there. */
      std::vector<std::optional<std::uint64_t>> keys;
      /** No update has come since the step began, or at all. */
      bool step_begins = true, at_start = true;
      /** Slave nodes and keys of what overlapped at the start of the run. */
      std::set<std::pair<Index, std::uint64_t>> overlaps;

      /** Call a function of the other pairing for its rows, which are the first. */
      template <class Function>
      void
      for_nodes(std::vector<ContactRow> &rows, const Function &function) const
      {
        std::vector<ContactRow> first(std::make_move_iterator(rows.begin()),
                                      std::make_move_iterator(rows.begin() + n));
        function(first);
        std::move(first.begin(), first.end(), rows.begin());
      }

      /** Whether the row of a node pushes along a direction that is not normal to the slave
       * surface. */
      bool
      oblique(const ContactRow &row) const
      {
        return SurfaceCone(*input.slave, row.slave).distance(-1. * row.normal) >
               Tolerances::oblique_sine;
      }

      void
      drop_covered(const std::vector<ContactRow> &rows, std::vector<FoundBetweenNodes> &found);
      void
      hold_overlaps(const Vector &u, std::vector<FoundBetweenNodes> &found);
      void
      choose(const std::vector<FoundBetweenNodes> &found, std::vector<ContactRow> &rows);
      void
      replace_rows_of_nodes(const std::vector<FoundBetweenNodes> &found,
                            std::vector<ContactRow>              &rows) const;
    };



    void
    EdgePairing::update(const Vector &u, const double time, std::vector<ContactRow> &rows)
    {
      for_nodes(rows, [&](std::vector<ContactRow> &first) { of_nodes->update(u, time, first); });
      if (on_edges)
        on_edges->update(u, rows);
      if (step_begins)
        {
          std::vector<std::pair<Index, std::uint64_t>> in_contact;
          for (std::size_t k = 0; k < n; ++k)
            if (keys[k] &&
                (rows[n + k].was_active || (present[k] && present[k]->gap() < 0. &&
                                            overlaps.count({rows[k].slave, *keys[k]}) > 0)))
              in_contact.emplace_back(rows[k].slave, *keys[k]);
          search.hold(in_contact);
          step_begins = false;
        }
      std::vector<FoundBetweenNodes> found = search.find(u);
      if (at_start)
        hold_overlaps(u, found);
      found.erase(std::remove_if(found.begin(),
                                 found.end(),
                                 [](const FoundBetweenNodes &one) {
                                   return one.before && !one.held;
                                 }),
                  found.end());
      std::vector<int> any = {!found.empty(), on_edges && on_edges->replaces_any()};
      Utilities::MPI::max(any, input.solid->communicator, any);
      if (any[0] == 1)
        drop_covered(rows, found);
      if (on_edges && any[1] == 0)
        on_edges->forget();
      choose(found, rows);
      replace_rows_of_nodes(found, rows);
    }



    // What overlaps at the start of the run counts as in contact; the two sides of a thin body do
    // not. Collective.
    void
    EdgePairing::hold_overlaps(const Vector &u, std::vector<FoundBetweenNodes> &found)
    {
      at_start = false;
      // An overlap that is taken out of gaps for good goes with a node. A point that slides along
      // an edge comes to other nodes, where it would count at once.
      if (input.parameters->initial_overlap == ContactPairParameters::Overlap::adjust)
        return;
      std::vector<FoundBetweenNodes> deep;
      for (const FoundBetweenNodes &one : found)
        if (one.before && !one.held)
          deep.push_back(one);
      std::vector<std::array<Point<dim>, 2>> feet;
      for (const FoundBetweenNodes &one : deep)
        feet.push_back(one.feet);
      const std::vector<bool> overlap =
        lie_within_each_other(feet, *input.solid, {{input.slave_body, input.master_body}}, u);
      // Vertices that share a node of their slave faces would compete for its row, and are left to
      // points inside these faces. Each is counted once, by the owner of its first node.
      std::vector<Index> of_vertices;
      for (std::size_t k = 0; k < deep.size(); ++k)
        if (overlap[k] && deep[k].of_vertex && numbers.count(deep[k].nodes.front().first) > 0)
          for (const auto &[node, weight] : deep[k].nodes)
            of_vertices.push_back(node);
      of_vertices = gather_all(of_vertices, input.solid->communicator);
      std::sort(of_vertices.begin(), of_vertices.end());
      const auto shared = [&](const auto &node) {
        const auto range = std::equal_range(of_vertices.begin(), of_vertices.end(), node.first);
        return range.second - range.first > 1;
      };
      std::size_t next = 0;
      for (FoundBetweenNodes &one : found)
        if (one.before && !one.held && overlap[next++] &&
            !(one.of_vertex && std::any_of(one.nodes.begin(), one.nodes.end(), shared)))
          {
            one.held         = true;
            const Index node = one.nodes.front().first;
            if (numbers.count(node) > 0)
              overlaps.emplace(node, one.contact->master_key());
          }
      search.hold({overlaps.begin(), overlaps.end()});
    }



    // A vertex in a face one of whose nodes touches the master needs no row: those of the nodes
    // hold the face already, and so do those of nodes on parallel edges the slave edge between
    // them. Rows of nodes may belong to other ranks. Collective.
    void
    EdgePairing::drop_covered(const std::vector<ContactRow>  &rows,
                              std::vector<FoundBetweenNodes> &found)
    {
      enum
      {
        touches,
        stands_on_edge
      };
      Vector flags(input.solid->zero_vector());
      for (std::size_t k = 0; k < n; ++k)
        {
          if (rows[k].has_partner && rows[k].gap < Tolerances::touching * rows[k].size &&
              !oblique(rows[k]))
            flags(dim * rows[k].slave + touches) = 1.;
          if (on_edge(k))
            flags(dim * rows[k].slave + stands_on_edge) = 1.;
        }
      flags.compress(VectorOperation::insert);
      const Vector ghosted = input.solid->ghosted(flags);
      const auto   covered = [&](const FoundBetweenNodes &one) {
        if (!one.of_vertex)
          return std::all_of(one.nodes.begin(), one.nodes.end(), [&](const auto &node) {
            return ghosted(dim * node.first + stands_on_edge) == 1.;
          });
        // The row of a node at the point is replaced.
        return !one.held && std::any_of(one.nodes.begin(), one.nodes.end(), [&](const auto &node) {
          return node.second < Tolerances::at_node && ghosted(dim * node.first + touches) == 1.;
        });
      };
      found.erase(std::remove_if(found.begin(), found.end(), covered), found.end());
    }



    // A node has one row between nodes: that of the smallest gap, but one in contact stays with
    // what it touches unless another is closer by more than a tolerance.
    void
    EdgePairing::choose(const std::vector<FoundBetweenNodes> &found, std::vector<ContactRow> &rows)
    {
      std::vector<const FoundBetweenNodes *> best(n, nullptr);
      const auto better = [&](const FoundBetweenNodes &a, const FoundBetweenNodes &b) {
        const std::size_t k   = numbers.at(a.nodes.front().first);
        const auto        gap = [&](const FoundBetweenNodes &one) {
          const bool stays = rows[n + k].was_active && keys[k] == one.contact->master_key();
          return one.contact->gap() + one.beyond -
                 (stays ? Tolerances::keeps_face * rows[k].size : 0.);
        };
        // What is equally close up to round-off: two edges that go on from the same node.
        return std::abs(gap(a) - gap(b)) > Tolerances::on_edge * rows[k].size ? gap(a) < gap(b)
                                                                              : a.order < b.order;
      };
      for (const FoundBetweenNodes &one : found)
        if (const auto k = numbers.find(one.nodes.front().first); k != numbers.end())
          if (best[k->second] == nullptr || better(one, *best[k->second]))
            best[k->second] = &one;
      for (std::size_t k = 0; k < n; ++k)
        {
          ContactRow &row = rows[n + k];
          present[k].reset();
          keys[k].reset();
          row.has_partner = false;
          row.stencil.clear();
          row.gap   = 0.;
          row.area  = 0.;
          row.share = 1.;
          row.lever = Tensor<1, dim>();
          if (best[k] == nullptr)
            continue;
          present[k] = best[k]->contact;
          keys[k]    = present[k]->master_key();
          present[k]->set(row);
          row.touches = *keys[k];
        }
    }



    void
    EdgePairing::replace_rows_of_nodes(const std::vector<FoundBetweenNodes> &found,
                                       std::vector<ContactRow>              &rows) const
    {
      for (const FoundBetweenNodes &one : found)
        for (const auto &[node, weight] : one.nodes)
          {
            const auto k = numbers.find(node);
            if (k == numbers.end())
              continue;
            ContactRow &row = rows[k->second];
            // Rows far away say nothing yet, and may come to touch something else.
            if (!row.has_partner || row.gap > row.size || one.contact->gap() > row.size ||
                on_edge(k->second) || !(weight > Tolerances::at_node || oblique(row)))
              continue;
            row.has_partner = false;
            row.stencil.clear();
            row.gap  = 0.;
            row.away = 0.;
          }
    }



    void
    EdgePairing::differentiate(const Vector &u, const double time, std::vector<ContactRow> &rows)
    {
      for_nodes(rows, [&](std::vector<ContactRow> &first) {
        // The other pairing must not differentiate rows that are not its own any more.
        std::vector<std::size_t> replaced;
        for (std::size_t k = 0; on_edges && k < n; ++k)
          if (first[k].was_active && on_edges->replaces(k))
            replaced.push_back(k);
        for (const std::size_t k : replaced)
          first[k].was_active = false;
        of_nodes->differentiate(u, time, first);
        for (const std::size_t k : replaced)
          first[k].was_active = true;
        if (on_edges)
          on_edges->differentiate(first);
      });
      std::vector<const Face *> needed;
      for (std::size_t k = 0; k < n; ++k)
        if (rows[n + k].was_active && present[k] && present[k]->face())
          needed.push_back(present[k]->face());
      const auto of_normals = search.normal_derivatives(needed);
      for (std::size_t k = 0; k < n; ++k)
        {
          ContactRow &row = rows[n + k];
          row.derivative.reset();
          if (!row.was_active || !present[k])
            continue;
          const auto found = of_normals.find(present[k]->face());
          row.derivative =
            present[k]->differentiate(found == of_normals.end() ? nullptr : &found->second);
        }
    }
  } // namespace



  std::shared_ptr<Pairing>
  make_edge_pairing(const PairingInput &input, const std::shared_ptr<Pairing> &of_nodes)
  {
    return std::make_shared<EdgePairing>(input, of_nodes);
  }
} // namespace Touchstone

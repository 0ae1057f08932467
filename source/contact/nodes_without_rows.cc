// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/archive/archive.h>
#include <touchstone/base/exchange.h>
#include <touchstone/contact/contact.h>
#include <touchstone/contact/nodes_without_rows.h>

#include <algorithm>

// Which slave nodes leave their rows to others follows from the committed configuration at the
// beginning of each step (doc/theory.md 3.1, "Edges where pairs meet"). Where they change, the
// committed state goes over to the new rows as it would to a new mesh (doc/theory.md 11,
// "History").
namespace Touchstone
{
  using namespace dealii;

  std::set<Index>
  NodesWithoutRows::of_pair(const std::size_t p) const
  {
    std::set<Index> result = junctions[p];
    result.insert(held[p].begin(), held[p].end());
    return result;
  }



  bool
  NodesWithoutRows::empty() const
  {
    const auto none = [](const std::set<Index> &nodes) { return nodes.empty(); };
    return std::all_of(junctions.begin(), junctions.end(), none) &&
           std::all_of(held.begin(), held.end(), none);
  }



  void
  NodesWithoutRows::add(const NodesWithoutRows &other)
  {
    for (std::size_t p = 0; p < junctions.size(); ++p)
      {
        junctions[p].insert(other.junctions[p].begin(), other.junctions[p].end());
        held[p].insert(other.held[p].begin(), other.held[p].end());
      }
  }



  NodesWithoutRowsFinder::NodesWithoutRowsFinder(
    const std::vector<std::unique_ptr<ContactPair>> &pairs,
    const ContactPair::Mirrors                      &supports,
    const Solid                                     &solid)
    : pairs(pairs)
    , supports(supports)
    , solid(solid)
  {
    // Pairs are the same on all ranks.
    if (pairs.size() > 1 &&
        std::any_of(pairs.begin(), pairs.end(), [](const auto &pair) { return can_stick(*pair); }))
      shared = nodes_of_several_pairs(pairs, solid);
  }



  NodesWithoutRows
  NodesWithoutRowsFinder::find(const RowsByPair &rows) const
  {
    NodesWithoutRows result;
    result.junctions = junction_nodes(pairs, rows, shared, solid);
    result.held      = held_nodes(pairs, rows, supports, solid);
    if (pairs_meet())
      {
        NodesWithoutRows over(pairs.size());
        over.junctions = nodes_over_joints(pairs, rows, solid);
        result.add(over);
      }
    return result;
  }



  RowsByPair
  Contact::rows_by_pair() const
  {
    RowsByPair result;
    for (const auto &pair : pairs)
      result.push_back(pair->rows());
    return result;
  }



  RowsByPair
  Contact::rows_of_all_nodes(const Vector &u)
  {
    // Rows that were found with other decisions, at joints, would decide about themselves; without
    // joints only normals and gaps are asked for.
    if (!without_rows_finder->pairs_meet() && without_rows.empty())
      return rows_by_pair();
    RowsByPair result;
    for (const auto &pair : pairs)
      result.push_back(pair->rows_of_all_nodes(u));
    return result;
  }



  void
  Contact::begin_step(const Vector &u, const double time)
  {
    formed.reset();
    if (pairs.empty())
      return;
    move(u);
    for (const auto &pair : pairs)
      pair->set_displacement(ghosted, time);
    if (const NodesWithoutRows found = without_rows_finder->find(rows_of_all_nodes(u));
        !(found == without_rows))
      change_rows(found, u, time);
    for (const auto &pair : pairs)
      pair->begin_step();
  }



  bool
  Contact::find_formed(const Vector &u)
  {
    if (pairs.empty())
      return false;
    const auto with = [this](const NodesWithoutRows &found) {
      NodesWithoutRows all = without_rows;
      all.add(found);
      return all;
    };
    // Rows as they are tell where to look; those of all nodes decide, as at the beginning of a
    // step.
    if (with(without_rows_finder->find(rows_by_pair())) == without_rows)
      return false;
    NodesWithoutRows all = with(without_rows_finder->find(rows_of_all_nodes(u)));
    if (all == without_rows)
      return false;
    formed = std::move(all);
    return true;
  }



  void
  Contact::change_rows(const NodesWithoutRows &nodes, const Vector &u, const double time)
  {
    const std::vector<Vector> committed_fields = fields(/*of_committed=*/true);
    const std::vector<double> work             = friction_work();
    std::vector<bool>         changed(pairs.size(), false);
    for (std::size_t p = 0; p < pairs.size(); ++p)
      if (const std::set<Index> of_pair = nodes.of_pair(p); of_pair != without_rows.of_pair(p))
        {
          changed[p]                 = true;
          const PairingMemory memory = pairs[p]->pairing().memory();
          make_rows_anew(p, of_pair);
          move(u);
          pairs[p]->set_displacement(ghosted, time);
          pairs[p]->remember(memory);
          pairs[p]->update(u, ghosted, time, [this](const ContactRow &row) {
            return state(row).active();
          });
        }
    without_rows = nodes;
    complete_cover(u);
    // The committed state of the others is theirs already.
    method->update_partners(all_rows, /*first=*/false);
    friction_rows.update(all_rows, u, time);
    for (const ContactRow &row : all_rows)
      if (changed[row.pair])
        adopt(row, committed_fields, /*history=*/true);
    for (Stateful *part : parts)
      part->commit();
    keep_friction_work(work);
  }



  void
  Contact::make_rows_anew(const std::size_t p, const std::set<Index> &nodes)
  {
    // Overlaps that are taken out of gaps, and the reach of the search, are those of the bodies as
    // they are placed.
    const Vector none(solid.zero_vector());
    move(none);
    pairs[p]->remove_rows(nodes);
    pairs[p]->update(none, ghosted, 0., [](const ContactRow &) { return false; });
  }



  void
  Contact::save_nodes_without_rows(ArchiveWriter &archive) const
  {
    for (std::size_t p = 0; p < pairs.size(); ++p)
      {
        std::vector<NodeRecord> records;
        for (const Index node : without_rows.of_pair(p))
          if (solid.owned.is_element(dim * node))
            records.push_back({node,
                               {double(without_rows.junctions[p].count(node)),
                                double(without_rows.held[p].count(node))},
                               {},
                               {}});
        archive.put_nodes("nodes without rows of " + pairs[p]->parameters().unique_name(), records);
      }
  }



  void
  Contact::load_nodes_without_rows(const ArchiveReader &archive)
  {
    struct Saved
    {
      Index node;
      bool  junction, held;
    };
    NodesWithoutRows nodes(pairs.size());
    for (std::size_t p = 0; p < pairs.size(); ++p)
      {
        const std::string name = "nodes without rows of " + pairs[p]->parameters().unique_name();
        // Checkpoints of earlier versions have none.
        if (!archive.has(name))
          return;
        std::vector<Saved> mine;
        for (const auto &[node, record] : archive.nodes(name))
          mine.push_back({node, record.values.at(0) > 0., record.values.at(1) > 0.});
        for (const Saved &saved : gather_all(mine, solid.communicator))
          {
            if (saved.junction)
              nodes.junctions[p].insert(saved.node);
            if (saved.held)
              nodes.held[p].insert(saved.node);
          }
      }
    for (std::size_t p = 0; p < pairs.size(); ++p)
      if (const std::set<Index> of_pair = nodes.of_pair(p); of_pair != without_rows.of_pair(p))
        make_rows_anew(p, of_pair);
    without_rows = nodes;
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/archive/archive.h>
#include <touchstone/base/exchange.h>
#include <touchstone/contact/contact_pair.h>
#include <touchstone/contact/row_archive.h>

#include <algorithm>
#include <tuple>

// The committed rows of a pair, and rows and pairing in checkpoints.
namespace Touchstone
{
  using namespace dealii;

  void
  ContactPair::commit_positions()
  {
    if (!small)
      // Sweeps of the next step start from these positions (doc/theory.md 4, "Passing through").
      pairing_method->commit_positions(*displacement);
  }



  void
  ContactPair::commit()
  {
    commit_positions();
    // Derivatives are made anew in each iteration and need not be copied with the history, and
    // distances are not in checkpoints.
    for (ContactRow &row : present)
      {
        row.derivative.reset();
        row.away = 0.;
      }
    committed = present;
    if (points_meet)
      points_before = points();
  }



  void
  ContactPair::rollback()
  {
    present = committed;
    pairing_method->rollback();
    if (points_meet && !(points().empty() && points_before.empty()))
      point_rows->set(points_before);
  }



  namespace
  {
    /** @brief References to the rows, the form in which save_rows() and load_rows() take them. */
    ContactRows
    references(const std::vector<ContactRow> &rows)
    {
      return ContactRows(rows.begin(), rows.end());
    }
  } // namespace



  void
  ContactPair::save(ArchiveWriter &archive) const
  {
    // The pairing remembers faces by keys that do not depend on the partition; rows find their own
    // by the number in this pair.
    const PairingMemory memory = pairing_method->memory();
    save_rows(archive, "rows", references(committed), [&](const ContactRow &row, RowPacker &pack) {
      const std::size_t k = &row - committed.data();
      pack(overlaps[k]);
      ContactRow::visit_state(row, pack);
      if (k < memory.of_rows.size() && memory.of_rows[k])
        pack.key(*memory.of_rows[k]);
    });
    // Sorted, so that the checkpoint does not depend on the order in which entries were made.
    KeyPairs faces(memory.of_faces.begin(), memory.of_faces.end());
    std::sort(faces.begin(), faces.end());
    archive.put_keys(input.parameters.unique_name(), faces);
    if (points_meet)
      save_points(archive);
  }



  namespace
  {
    /** A point with its place alone: the rest follows from the mesh. */
    struct SavedPoint
    {
      Index                 slave = invalid_index;
      std::uint64_t         face  = 0;
      std::array<double, 2> xi{};
      double                depth = 0.;
    };

    std::string
    name_of_points(const ContactPairParameters &parameters)
    {
      return "points in faces of " + parameters.unique_name();
    }
  } // namespace



  void
  ContactPair::save_points(ArchiveWriter &archive) const
  {
    std::vector<NodeRecord> records;
    for (const MaterialPoint &point : points_before)
      if (const Index node = point.nodes[point.slave]; input.solid.owned.is_element(dim * node))
        records.push_back({node, {point.xi[0], point.xi[1], point.depth}, {}, {point.face}});
    const std::string name = name_of_points(input.parameters);
    archive.put(name, points_before.size());
    archive.put_nodes(name, records);
  }



  // The ranks that know the nodes need not know the faces.
  void
  ContactPair::load_points(const ArchiveReader &archive)
  {
    const std::string name = name_of_points(input.parameters);
    // Checkpoints of earlier versions have none.
    if (!archive.has(name))
      return;
    std::vector<SavedPoint> saved;
    for (const auto &[node, record] : archive.nodes(name))
      saved.push_back({node,
                       record.keys.at(0),
                       {{record.values.at(0), record.values.at(1)}},
                       record.values.at(2)});
    std::vector<MaterialPoint> mine;
    for (const SavedPoint &one : gather_all(saved, input.solid.communicator))
      for (const Face &face : slave_surface->owned_faces())
        if (face.key == one.face)
          {
            MaterialPoint point(face, slave_surface->trace(face), one.xi);
            point.depth = one.depth;
            for (unsigned int a = 0; a < point.n; ++a)
              if (point.nodes[a] == one.slave)
                point.slave = a;
            mine.push_back(point);
          }
    points_before = gather_all(mine, input.solid.communicator);
    std::sort(points_before.begin(),
              points_before.end(),
              [](const MaterialPoint &one, const MaterialPoint &other) {
                return std::tie(one.face, one.xi) < std::tie(other.face, other.xi);
              });
    point_rows->set(points_before);
  }



  void
  ContactPair::load(const ArchiveReader &archive)
  {
    PairingMemory memory;
    load_rows(archive,
              "rows",
              references(present),
              [&](const ContactRow &row, RowUnpacker &unpack) {
                const std::size_t k = &row - present.data();
                unpack(overlaps[k]);
                ContactRow::visit_state(present[k], unpack);
                memory.of_rows.emplace_back();
                if (!unpack.keys().empty())
                  memory.of_rows.back() = unpack.keys().front();
              });
    // Only edges and vertices have keys beside those of the nodes.
    if (!edges_meet)
      memory.of_rows.resize(slave_surface->owned_nodes().size());
    const KeyPairs &faces = archive.keys(input.parameters.unique_name());
    memory.of_faces.insert(faces.begin(), faces.end());
    committed = present;
    if (points_meet)
      load_points(archive);
    remember(memory);
  }
} // namespace Touchstone

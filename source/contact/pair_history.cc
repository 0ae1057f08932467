// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/archive/archive.h>
#include <touchstone/contact/contact_pair.h>
#include <touchstone/contact/row_archive.h>

#include <algorithm>

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
  }



  void
  ContactPair::rollback()
  {
    present = committed;
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
    archive.put_keys(input.parameters.section(), faces);
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
    const KeyPairs &faces = archive.keys(input.parameters.section());
    memory.of_faces.insert(faces.begin(), faces.end());
    committed = present;
    // Small sliding: the pairing is that of the reference state, made by the update before.
    if (small)
      return;
    pairing_method->commit_positions(*displacement);
    pairing_method->remember(memory);
  }
} // namespace Touchstone

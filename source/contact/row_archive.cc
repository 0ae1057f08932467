// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/row_archive.h>

#include <map>
#include <vector>

namespace Touchstone
{
  namespace
  {
    /** The number of a pair, and whether rows are those between nodes. */
    using Kind = std::pair<unsigned int, bool>;

    /** A node can be the slave of several pairs, and of two rows of a pair. */
    std::string
    name_of_kind(const std::string &name, const Kind &kind)
    {
      return name + " of pair " + std::to_string(kind.first) +
             (kind.second ? ", between nodes" : "");
    }
  } // namespace



  // Records are stored by slave node, pair and kind, so that they can be found by any other number
  // of ranks.
  void
  save_rows(ArchiveWriter                                              &archive,
            const std::string                                          &name,
            const ContactRows                                          &rows,
            const std::function<void(const ContactRow &, RowPacker &)> &pack)
  {
    std::map<Kind, std::vector<NodeRecord>> records;
    for (const ContactRow &row : rows)
      {
        std::vector<NodeRecord> &list = records[{row.pair, row.between_nodes}];
        list.emplace_back();
        list.back().node = row.slave;
        RowPacker packer(list.back());
        pack(row, packer);
      }
    for (const auto &[kind, list] : records)
      archive.put_nodes(name_of_kind(name, kind), list);
  }



  void
  load_rows(const ArchiveReader                                          &archive,
            const std::string                                            &name,
            const ContactRows                                            &rows,
            const std::function<void(const ContactRow &, RowUnpacker &)> &unpack)
  {
    for (const ContactRow &row : rows)
      {
        const auto &records = archive.nodes(name_of_kind(name, {row.pair, row.between_nodes}));
        const auto  found   = records.find(row.slave);
        if (found == records.end())
          throw ArchiveError("a contact row is missing (" + name + ")");
        RowUnpacker unpacker(found->second);
        unpack(row, unpacker);
        // Records have no field names: a length that differs is the only sign that a checkpoint is
        // of another version.
        if (!unpacker.complete())
          throw ArchiveError("the state of a contact row is too long (" + name + ")");
      }
  }
} // namespace Touchstone

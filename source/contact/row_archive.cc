// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/row_archive.h>

#include <map>
#include <vector>

namespace Touchstone
{
  namespace
  {
    /** The number of a pair, and 0 for rows of nodes, else the number of the row among those
     * between nodes with the same slave node. */
    using Kind = std::pair<unsigned int, unsigned int>;

    /** A node can be the slave of several pairs, and of several rows of a pair. */
    std::string
    name_of_kind(const std::string &name, const Kind &kind)
    {
      return name + " of pair " + std::to_string(kind.first) +
             (kind.second > 0 ? ", between nodes" : "") +
             (kind.second > 1 ? " " + std::to_string(kind.second) : "");
    }

    /** The kinds of rows that come one after the other. */
    class KindsOfRows
    {
    public:
      Kind
      next(const ContactRow &row)
      {
        return {row.pair, row.between_nodes ? ++count[{row.pair, row.slave}] : 0};
      }

    private:
      std::map<std::pair<unsigned int, Index>, unsigned int> count;
    };
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
    KindsOfRows                             kinds;
    for (const ContactRow &row : rows)
      {
        std::vector<NodeRecord> &list = records[kinds.next(row)];
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
    KindsOfRows kinds;
    for (const ContactRow &row : rows)
      {
        const auto &records = archive.nodes(name_of_kind(name, kinds.next(row)));
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

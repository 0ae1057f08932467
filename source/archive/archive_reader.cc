// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/archive/archive.h>
#include <touchstone/archive/archive_blocks.h>

#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

// Reading the state of a run on any number of ranks: the pieces, one at a time, the refined cells
// by which the same mesh is made, and what archive_match.cc has taken for this rank.
namespace Touchstone
{
  using namespace dealii;

  ArchiveReader::ArchiveReader(const std::function<std::vector<char>(unsigned int)> &source,
                               const unsigned int                                    n_pieces)
    : source(source)
    , n_pieces(n_pieces)
  {
  }



  // One piece is kept at a time: together they may be larger than the memory of one rank, and
  // callers read them one after the other.
  const ArchiveReader::Blocks &
  ArchiveReader::piece(const unsigned int number) const
  {
    if (present != number)
      {
        blocks  = unpack<Blocks>(source(number));
        present = number;
      }
    return blocks;
  }



  const std::vector<char> &
  ArchiveReader::block(const Blocks &piece, const std::string &name)
  {
    const auto found = piece.find(name);
    if (found == piece.end())
      throw ArchiveError("it has no '" + name + "'");
    return found->second;
  }



  // The ancestors of all active cells, of @p level and finer. They determine the adaptive mesh:
  // refining just these cells makes the active cells of the archive.
  std::set<CellId::binary_type>
  ArchiveReader::refined_cells(const unsigned int level) const
  {
    std::set<CellId::binary_type> result;
    for (unsigned int i = 0; i < n_pieces; ++i)
      {
        const CellList list = unpack<CellList>(block(piece(i), cells_block));
        for (std::size_t c = 0; c < list.size(); ++c)
          {
            const CellId id(list.id(c));
            const auto   path = id.get_child_indices();
            for (std::size_t depth = path.size(); depth > level; --depth)
              if (!result
                     .insert(CellId(id.get_coarse_cell_id(), depth - 1, path.data())
                               .template to_binary<dim>())
                     .second)
                break; // its own ancestors are known, too
          }
      }
    return result;
  }



  namespace
  {
    template <class Map>
    const typename Map::mapped_type &
    find(const Map &map, const std::string &what, const std::string &name)
    {
      const auto found = map.find(name);
      if (found == map.end())
        throw ArchiveError("it has no " + what + "'" + name + "'");
      return found->second;
    }
  } // namespace



  const Vector &
  ArchiveReader::field(const std::string &name) const
  {
    return find(fields, ArchiveWriter::field_prefix, name);
  }



  const std::vector<std::vector<double>> &
  ArchiveReader::cells(const std::string &name) const
  {
    return find(cell_data, ArchiveWriter::cell_prefix, name);
  }



  const std::map<Index, NodeRecord> &
  ArchiveReader::nodes(const std::string &name) const
  {
    return find(records, ArchiveWriter::node_prefix, name);
  }



  const KeyPairs &
  ArchiveReader::keys(const std::string &name) const
  {
    return find(key_pairs, ArchiveWriter::key_prefix, name);
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/hexahedron.h>
#include <touchstone/explicit/inverted_cells.h>

// Cells that are turned inside out (doc/explicit.md, section 7).
namespace Touchstone
{
  CellPlace
  inverted_cell(const NodeMap &map, const NodeField &u)
  {
    Hexahedron shape;
    CellPlace  result;
    for (unsigned int c = 0; c < map.cells().size(); ++c)
      if (const NodeMap::Cell &cell = map.cells()[c];
          cell.owned && !(shape.reinit(corners(map, map.nodes(c), &u)) > 0.))
        {
          result.key  = cell.key;
          result.body = cell.body;
          for (const unsigned int node : map.nodes(c))
            for (unsigned int d = 0; d < dim; ++d)
              result.position[d] += map.positions()[node][d] / NodeMap::nodes_per_cell;
          break;
        }
    return result;
  }
} // namespace Touchstone

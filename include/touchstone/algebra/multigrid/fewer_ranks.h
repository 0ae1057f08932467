// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_multigrid_fewer_ranks_h
#define touchstone_algebra_multigrid_fewer_ranks_h

#include <Epetra_BlockMap.h>

namespace Touchstone
{
  /**
   * @brief The same numbers on fewer ranks, if these would have few of them each: of 2, 4, 8, ...
   * ranks that follow each other the first gets all, the others none.
   *
   * A coarse level of multigrid is too small to keep all ranks busy, and aggregates stay within
   * ranks: were it left where it is, the coarsest level would grow with the number of ranks
   * (doc/scaling.md).
   *
   * @param map Contiguous, in the order of the ranks.
   * @return @p map itself if each rank has enough. Collective.
   */
  Epetra_BlockMap
  on_fewer_ranks(const Epetra_BlockMap &map);
} // namespace Touchstone

#endif

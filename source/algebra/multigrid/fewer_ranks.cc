// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/multigrid/fewer_ranks.h>
#include <touchstone/base/exchange.h>

#include <Epetra_MpiComm.h>
#include <map>
#include <vector>

// Which ranks have the coarse levels of multigrid. Each rank finds it from the size of the level
// and its own number; only the sizes of pieces go to the rank that takes them over.
namespace Touchstone
{
  namespace
  {
    /** Unknowns for each rank: with fewer, messages take longer than products. Three ranks of this
     * size are solved directly (Multigrid), so that on few ranks little changes above that level.
     */
    constexpr int enough = 300;
  } // namespace



  Epetra_BlockMap
  on_fewer_ranks(const Epetra_BlockMap &map)
  {
    const auto &communicator = dynamic_cast<const Epetra_MpiComm &>(map.Comm());
    const int   n_ranks      = communicator.NumProc();
    // A power of two: what a rank has taken over it hands over as a whole on the next level.
    int stride = 1;
    while (stride < n_ranks && map.NumGlobalElements() / ((n_ranks + stride - 1) / stride) < enough)
      stride *= 2;
    if (stride == 1)
      return map;
    const unsigned int first = communicator.MyPID() / stride * stride;
    int                n     = 0;
    for (const auto &[rank, sizes] :
         exchange_records(std::map<unsigned int, std::vector<int>>{{first, {map.NumMyElements()}}},
                          communicator.Comm()))
      n += sizes.front();
    return Epetra_BlockMap(-1, n, 1, 0, communicator);
  }
} // namespace Touchstone

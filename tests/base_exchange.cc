// SPDX-License-Identifier: LGPL-2.1-or-later
// Records sent between ranks and gathered arrive as they were, by rank and in order.

#include <touchstone/base/exchange.h>

#include <iostream>

using namespace Touchstone;
using namespace dealii;

namespace
{
  /** Members of several types, with room between them. */
  struct Record
  {
    char         kind;
    double       value;
    unsigned int from;
  };

  bool
  is(const Record &record, const char kind, const double value, const unsigned int from)
  {
    return record.kind == kind && record.value == value && record.from == from;
  }

  void
  check(const std::string &what, const bool here)
  {
    const bool all = Utilities::MPI::min(static_cast<int>(here), MPI_COMM_WORLD) == 1;
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << what << ": " << (all ? "OK" : "FAILED") << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const unsigned int               rank = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  const unsigned int               n    = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);

  // Each rank sends rank + 1 records to the next one, the last one to the first.
  std::map<unsigned int, std::vector<Record>> messages;
  for (unsigned int k = 0; k <= rank; ++k)
    messages[(rank + 1) % n].push_back({'a', 0.1 * k, rank});
  const auto         received = exchange_records(messages, MPI_COMM_WORLD);
  const unsigned int sender   = (rank + n - 1) % n;
  bool               right    = received.size() == 1 && received.count(sender) == 1;
  if (right)
    right = received.at(sender).size() == sender + 1;
  for (unsigned int k = 0; right && k <= sender; ++k)
    right = is(received.at(sender)[k], 'a', 0.1 * k, sender);
  check("round trip", right);

  // All ranks send to the last one, itself included; nobody else receives anything.
  messages.clear();
  messages[n - 1]    = {{'b', -1., rank}};
  const auto at_last = exchange_records(messages, MPI_COMM_WORLD);
  right              = at_last.size() == (rank == n - 1 ? n : 0);
  unsigned int next  = 0;
  for (const auto &[from, records] : at_last)
    right = right && from == next++ && records.size() == 1 && is(records[0], 'b', -1., from);
  check("many to one, in the order of ranks", right);

  messages.clear();
  check("nothing to send", exchange_records(messages, MPI_COMM_WORLD).empty());

  // Lists of different lengths, the first one empty.
  const auto gathered =
    gather_records(std::vector<Record>(rank, Record{'c', 0.5, rank}), MPI_COMM_WORLD);
  right = gathered.size() == n;
  for (unsigned int r = 0; right && r < n; ++r)
    {
      right = gathered[r].size() == r;
      for (const Record &record : gathered[r])
        right = right && is(record, 'c', 0.5, r);
    }
  check("gathered", right);
  return 0;
}

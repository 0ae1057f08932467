// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/reduction.h>

#include <algorithm>
#include <cstring>

// Sums and maxima of different kinds in one reduction: an operation of our own for MPI, to which
// each number says what it is.
namespace Touchstone
{
  namespace
  {
    using Entry = Reduction::Entry;
    static_assert(sizeof(double) == sizeof(Entry::bits) && sizeof(Entry) == 2 * sizeof(double),
                  "numbers are sent bit by bit");

    double
    real(const std::uint64_t bits)
    {
      double result;
      std::memcpy(&result, &bits, sizeof(result));
      return result;
    }

    std::uint64_t
    bits(const double value)
    {
      std::uint64_t result;
      std::memcpy(&result, &value, sizeof(result));
      return result;
    }

    /** For MPI: @p to = @p from and @p to together. */
    void
    combine(void *from, void *to, int *n, MPI_Datatype *)
    {
      const auto *other = static_cast<const Entry *>(from);
      for (auto *entry = static_cast<Entry *>(to); entry != static_cast<Entry *>(to) + *n;
           ++entry, ++other)
        switch (entry->kind)
          {
            case Entry::sum_of_reals:
              entry->bits = bits(real(other->bits) + real(entry->bits));
              break;
            case Entry::sum_of_integers:
              entry->bits += other->bits;
              break;
            case Entry::largest_real:
              entry->bits = bits(std::max(real(other->bits), real(entry->bits)));
              break;
          }
    }
    /** What MPI knows of entries: told once, forgotten with all else at the end of the run. */
    struct Registered
    {
      MPI_Datatype type;
      MPI_Op       operation;

      Registered()
      {
        MPI_Type_contiguous(2, MPI_UINT64_T, &type);
        MPI_Type_commit(&type);
        MPI_Op_create(&combine, /*commute=*/1, &operation);
      }
    };
  } // namespace



  void
  Reduction::sum(double &value)
  {
    entries.push_back({Entry::sum_of_reals, bits(value)});
    values.push_back(&value);
  }



  void
  Reduction::sum(std::uint64_t &value)
  {
    entries.push_back({Entry::sum_of_integers, value});
    values.push_back(&value);
  }



  void
  Reduction::max(double &value)
  {
    entries.push_back({Entry::largest_real, bits(value)});
    values.push_back(&value);
  }



  void
  Reduction::over(const MPI_Comm communicator)
  {
    int n_ranks = 1;
    MPI_Comm_size(communicator, &n_ranks);
    if (n_ranks > 1)
      {
        static const Registered entry;
        MPI_Allreduce(MPI_IN_PLACE,
                      entries.data(),
                      static_cast<int>(entries.size()),
                      entry.type,
                      entry.operation,
                      communicator);
      }
    for (std::size_t k = 0; k < entries.size(); ++k)
      std::memcpy(values[k], &entries[k].bits, sizeof(entries[k].bits));
    entries.clear();
    values.clear();
  }
} // namespace Touchstone

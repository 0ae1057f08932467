// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_exchange_h
#define touchstone_base_exchange_h

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <cstring>
#include <limits>
#include <map>
#include <type_traits>
#include <vector>

namespace Touchstone
{
  namespace internal
  {
    /** @brief Bytes of some records. All ranks run the same program, so that records go bit by
     * bit. @throws dealii::ExceptionBase if they are more than MPI can count. */
    template <typename T>
    std::vector<char>
    bytes(const std::vector<T> &records)
    {
      static_assert(std::is_trivially_copyable<T>::value && !std::is_pointer<T>::value,
                    "Records are sent bit by bit: structs of numbers.");
      const std::size_t size = records.size() * sizeof(T);
      AssertThrow(size < static_cast<std::size_t>(std::numeric_limits<int>::max()),
                  dealii::ExcMessage("A message of more than 2^31 bytes cannot be sent."));
      std::vector<char> result(size);
      if (size > 0)
        std::memcpy(result.data(), records.data(), size);
      return result;
    }

    /** @brief The records that bytes() has made, from an array of @p size bytes. */
    template <typename T>
    std::vector<T>
    records(const char *bytes, const std::size_t size)
    {
      AssertThrow(size % sizeof(T) == 0, dealii::ExcInternalError());
      std::vector<T> result(size / sizeof(T));
      if (size > 0)
        std::memcpy(result.data(), bytes, size);
      return result;
    }
  } // namespace internal



  /**
   * @brief Send a list of records to each of some ranks, and receive those of others.
   *
   * The one way in which ranks exchange lists. A record is a struct whose members have names and
   * types, in place of numbers at agreed positions of a list of double. (Not called exchange:
   * argument-dependent look-up would find std::exchange.)
   *
   * @tparam T       Trivially copyable, without pointers.
   * @param messages Records by receiving rank, this one possibly among them. Ranks without an
   *                 entry receive nothing.
   * @return Records by sending rank; iteration is in ascending order of the ranks.
   * @throws dealii::ExceptionBase if a message is too large for MPI. Collective.
   */
  template <typename T>
  std::map<unsigned int, std::vector<T>>
  exchange_records(const std::map<unsigned int, std::vector<T>> &messages,
                   const MPI_Comm                                communicator)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
      return messages;
    std::map<unsigned int, std::vector<char>> sent;
    for (const auto &[rank, records] : messages)
      sent[rank] = internal::bytes(records);
    std::map<unsigned int, std::vector<T>> received;
    for (const auto &[rank, bytes] : dealii::Utilities::MPI::some_to_some(communicator, sent))
      received[rank] = internal::records<T>(bytes.data(), bytes.size());
    return received;
  }



  /**
   * @brief The lists of records of all ranks, on all ranks, by rank. Collective.
   * @tparam T As of exchange_records().
   * @throws dealii::ExceptionBase if a list, or all together, are too large for MPI.
   */
  template <typename T>
  std::vector<std::vector<T>>
  gather_records(const std::vector<T> &records, const MPI_Comm communicator)
  {
    const std::vector<char> mine    = internal::bytes(records);
    const unsigned int      n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
    if (n_ranks == 1)
      return {records};
    const int        size = static_cast<int>(mine.size());
    std::vector<int> sizes(n_ranks), begin(n_ranks);
    int error = MPI_Allgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, communicator);
    AssertThrowMPI(error);
    std::size_t total = 0;
    for (unsigned int rank = 0; rank < n_ranks; ++rank)
      {
        begin[rank] = static_cast<int>(total);
        total += sizes[rank];
        AssertThrow(total < static_cast<std::size_t>(std::numeric_limits<int>::max()),
                    dealii::ExcMessage("More than 2^31 bytes cannot be gathered."));
      }
    std::vector<char> all(total);
    error = MPI_Allgatherv(
      mine.data(), size, MPI_BYTE, all.data(), sizes.data(), begin.data(), MPI_BYTE, communicator);
    AssertThrowMPI(error);
    std::vector<std::vector<T>> result;
    for (unsigned int rank = 0; rank < n_ranks; ++rank)
      result.push_back(internal::records<T>(all.data() + begin[rank], sizes[rank]));
    return result;
  }



  /** @brief The same in one list, by rank. Collective. */
  template <typename T>
  std::vector<T>
  gather_all(const std::vector<T> &records, const MPI_Comm communicator)
  {
    std::vector<T> result;
    for (const std::vector<T> &of_rank : gather_records(records, communicator))
      result.insert(result.end(), of_rank.begin(), of_rank.end());
    return result;
  }
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_ask_owners_h
#define touchstone_base_ask_owners_h

#include <touchstone/base/exchange.h>

#include <deal.II/base/index_set.h>

#include <map>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Which of some records about dofs the owners of these dofs know of: each rank asks for
   * what it needs, and none has to hold what all know.
   *
   * @param records Trivially copyable; about any dofs, of this rank as well.
   * @param dof_of  Of a record: its dof. @param known Of a record about an owned dof: whether it
   *                is known here.
   * @return those of @p records that are known. Collective.
   */
  template <class Record, class DofOf, class Known>
  std::vector<Record>
  known_to_owners(const std::vector<Record> &records,
                  const dealii::IndexSet    &owned,
                  const MPI_Comm             communicator,
                  const DofOf               &dof_of,
                  const Known               &known)
  {
    std::vector<Record> result;
    dealii::IndexSet    foreign(owned.size());
    for (const Record &record : records)
      if (!owned.is_element(dof_of(record)))
        foreign.add_index(dof_of(record));
      else if (known(record))
        result.push_back(record);
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
      return result;
    foreign.compress();
    const std::vector<unsigned int> owners =
      dealii::Utilities::MPI::compute_index_owner(owned, foreign, communicator);
    std::map<unsigned int, std::vector<Record>> questions, answers;
    for (const Record &record : records)
      if (!owned.is_element(dof_of(record)))
        questions[owners[foreign.index_within_set(dof_of(record))]].push_back(record);
    for (const auto &[rank, asked] : exchange_records(questions, communicator))
      for (const Record &record : asked)
        if (known(record))
          answers[rank].push_back(record);
    for (const auto &[rank, answered] : exchange_records(answers, communicator))
      result.insert(result.end(), answered.begin(), answered.end());
    return result;
  }
} // namespace Touchstone

#endif

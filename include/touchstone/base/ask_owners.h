// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_ask_owners_h
#define touchstone_base_ask_owners_h

#include <touchstone/base/exchange.h>

#include <deal.II/base/index_set.h>

#include <map>
#include <vector>

namespace Touchstone
{
  /** @brief Records about dofs by the rank that owns the dof, this one possibly among them, each
   * list in the order of @p records. @param dof_of Of a record: its dof. Collective. */
  template <class Record, class DofOf>
  std::map<unsigned int, std::vector<Record>>
  records_by_owner(const std::vector<Record> &records,
                   const dealii::IndexSet    &owned,
                   const MPI_Comm             communicator,
                   const DofOf               &dof_of)
  {
    std::map<unsigned int, std::vector<Record>> result;
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
      {
        result[0] = records;
        return result;
      }
    dealii::IndexSet foreign(owned.size());
    for (const Record &record : records)
      if (!owned.is_element(dof_of(record)))
        foreign.add_index(dof_of(record));
    foreign.compress();
    const std::vector<unsigned int> owners =
      dealii::Utilities::MPI::compute_index_owner(owned, foreign, communicator);
    const unsigned int me = dealii::Utilities::MPI::this_mpi_process(communicator);
    for (const Record &record : records)
      result[owned.is_element(dof_of(record)) ? me
                                              : owners[foreign.index_within_set(dof_of(record))]]
        .push_back(record);
    return result;
  }



  /**
   * @brief What the owners of dofs answer to records about them: each rank asks for what it needs,
   * and none has to hold what all know.
   *
   * @tparam Answer Trivially copyable, as records are.
   * @param records About any dofs, of this rank as well. @param dof_of Of a record: its dof.
   * @param answer  Of a record about an owned dof.
   * @return the answers in the order of @p records. Collective.
   */
  template <class Answer, class Record, class DofOf, class Reply>
  std::vector<Answer>
  ask_owners(const std::vector<Record> &records,
             const dealii::IndexSet    &owned,
             const MPI_Comm             communicator,
             const DofOf               &dof_of,
             const Reply               &answer)
  {
    struct Question
    {
      Record      record;
      std::size_t number;
    };
    struct Numbered
    {
      Answer      answer;
      std::size_t number;
    };
    std::vector<Question> questions;
    for (const Record &record : records)
      questions.push_back({record, questions.size()});
    const auto by_owner = records_by_owner(questions, owned, communicator, [&](const Question &of) {
      return dof_of(of.record);
    });
    std::map<unsigned int, std::vector<Numbered>> answers;
    for (const auto &[rank, asked] : exchange_records(by_owner, communicator))
      for (const Question &question : asked)
        answers[rank].push_back({answer(question.record), question.number});
    std::vector<Answer> result(records.size());
    for (const auto &[rank, answered] : exchange_records(answers, communicator))
      for (const Numbered &one : answered)
        result[one.number] = one.answer;
    return result;
  }



  /** @brief Those of some records about dofs that the owners of these know of. @param known Of a
   * record about an owned dof: whether it is known here. Else as ask_owners(). Collective. */
  template <class Record, class DofOf, class Known>
  std::vector<Record>
  known_to_owners(const std::vector<Record> &records,
                  const dealii::IndexSet    &owned,
                  const MPI_Comm             communicator,
                  const DofOf               &dof_of,
                  const Known               &known)
  {
    const std::vector<char> is_known =
      ask_owners<char>(records, owned, communicator, dof_of, [&](const Record &record) -> char {
        return known(record);
      });
    std::vector<Record> result;
    for (std::size_t k = 0; k < records.size(); ++k)
      if (is_known[k])
        result.push_back(records[k]);
    return result;
  }
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_row_array_h
#define touchstone_contact_row_array_h

#include <touchstone/base/stateful.h>
#include <touchstone/contact/row.h>
#include <touchstone/contact/row_archive.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief Common base of all arrays that are parallel to the contact rows of a rank. */
  class RowArrayBase : public Stateful
  {
  public:
    /** @brief An entry with default values for each row. */
    virtual void
    reinit(const ContactRows &rows) = 0;

    /** @brief The row has no contact force: default values. */
    virtual void
    reset(const ContactRow &row) = 0;

    /** @name Keep the present values beside the committed ones, and return to them until they are
     * forgotten */
    /** @{ */
    virtual void
    keep() = 0;
    virtual void
    restore() = 0;
    virtual void
    forget() = 0;
    /** @} */
  };

  /**
   * @brief Values of type T for each contact row of this rank, present and committed.
   *
   * T has a static function template visit_state(T &, visit) that lists the fields which
   * checkpoints hold.
   */
  template <class T>
  class RowArray : public RowArrayBase
  {
  public:
    /** @param name In checkpoints; unique. */
    explicit RowArray(std::string name)
      : name(std::move(name))
    {
    }

    T &
    operator[](const ContactRow &row)
    {
      return present[row.index];
    }
    const T &
    operator[](const ContactRow &row) const
    {
      return present[row.index];
    }

    /** @brief Values of the last committed state. */
    const T &
    of_committed(const ContactRow &row) const
    {
      return committed[row.index];
    }

    void
    reinit(const ContactRows &all_rows) override
    {
      rows = &all_rows;
      present.assign(all_rows.size(), T());
      committed = present;
    }

    /** @brief Default values in all present entries. */
    void
    reinit_present()
    {
      std::fill(present.begin(), present.end(), T());
    }

    /** @brief Call @p change with each present entry. */
    template <class Change>
    void
    for_each(const Change &change)
    {
      std::for_each(present.begin(), present.end(), change);
    }

    void
    reset(const ContactRow &row) override
    {
      present[row.index] = T();
    }

    void
    commit() override
    {
      committed = present;
    }

    void
    rollback() override
    {
      present = committed;
    }

    void
    keep() override
    {
      kept = present;
    }

    void
    restore() override
    {
      present = kept;
    }

    void
    forget() override
    {
      std::vector<T>().swap(kept);
    }

    /** @brief The value when keep() was called. */
    const T &
    of_kept(const ContactRow &row) const
    {
      return kept[row.index];
    }

    void
    save(ArchiveWriter &archive) const override
    {
      save_rows(archive, name, *rows, [this](const ContactRow &row, RowPacker &pack) {
        T::visit_state(committed[row.index], pack);
      });
    }

    void
    load(const ArchiveReader &archive) override
    {
      load_rows(archive, name, *rows, [this](const ContactRow &row, RowUnpacker &unpack) {
        T::visit_state(present[row.index], unpack);
      });
      committed = present;
    }

  private:
    std::string        name;
    const ContactRows *rows = nullptr;
    std::vector<T>     present, committed, kept;
  };
} // namespace Touchstone

#endif

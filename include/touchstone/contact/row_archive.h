// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_row_archive_h
#define touchstone_contact_row_archive_h

#include <touchstone/archive/archive.h>
#include <touchstone/contact/row.h>

#include <array>
#include <functional>
#include <string>
#include <type_traits>

namespace Touchstone
{
  /** @brief Appends the fields of a row that it visits to a record: whole numbers, flags and
   * states fit into a double. */
  class RowPacker
  {
  public:
    explicit RowPacker(NodeRecord &record)
      : record(record)
    {
    }

    template <class Number>
    std::enable_if_t<std::is_arithmetic<Number>::value || std::is_enum<Number>::value>
    operator()(const Number &value)
    {
      record.values.push_back(static_cast<double>(value));
    }

    template <int rank>
    void
    operator()(const dealii::Tensor<rank, dim> &value)
    {
      for (unsigned int d = 0; d < dim; ++d)
        (*this)(value[d]);
    }

    template <class T, std::size_t n>
    void
    operator()(const std::array<T, n> &value)
    {
      for (const T &entry : value)
        (*this)(entry);
    }

    void
    operator()(const Stencil &stencil)
    {
      (*this)(stencil.size());
      for (const StencilEntry &entry : stencil)
        {
          record.nodes.push_back(entry.node);
          (*this)(entry.weight);
        }
    }

    /** @brief A number that means the same in any partition. */
    void
    key(const std::uint64_t key)
    {
      record.keys.push_back(key);
    }

  private:
    NodeRecord &record;
  };

  /** @brief Sets the fields of a row that it visits from a record, in the same order. */
  class RowUnpacker
  {
  public:
    explicit RowUnpacker(const NodeRecord &record)
      : record(record)
    {
    }

    template <class Number>
    std::enable_if_t<std::is_arithmetic<Number>::value || std::is_enum<Number>::value>
    operator()(Number &value)
    {
      value = static_cast<Number>(
        static_cast<std::conditional_t<std::is_floating_point<Number>::value, double, long>>(
          next()));
    }

    template <int rank>
    void
    operator()(dealii::Tensor<rank, dim> &value)
    {
      for (unsigned int d = 0; d < dim; ++d)
        (*this)(value[d]);
    }

    template <class T, std::size_t n>
    void
    operator()(std::array<T, n> &value)
    {
      for (T &entry : value)
        (*this)(entry);
    }

    void
    operator()(Stencil &stencil)
    {
      stencil.resize(static_cast<std::size_t>(next()));
      for (StencilEntry &entry : stencil)
        {
          entry.node = record.nodes.at(n_nodes++);
          (*this)(entry.weight);
        }
    }

    /** @brief The keys that were packed. */
    const std::vector<std::uint64_t> &
    keys() const
    {
      return record.keys;
    }

    /** @brief Nothing is left over. */
    bool
    complete() const
    {
      return n_values == record.values.size() && n_nodes == record.nodes.size();
    }

  private:
    const NodeRecord &record;
    std::size_t       n_values = 0, n_nodes = 0;

    double
    next()
    {
      if (n_values == record.values.size())
        throw ArchiveError("the state of a contact row is too short");
      return record.values[n_values++];
    }
  };

  /** @brief Put what @p pack writes of each of @p rows into an archive, under @p name. */
  void
  save_rows(ArchiveWriter                                              &archive,
            const std::string                                          &name,
            const ContactRows                                          &rows,
            const std::function<void(const ContactRow &, RowPacker &)> &pack);

  /** @brief Read it back, in any partition. @throws ArchiveError if a row is missing or has
   * another length. */
  void
  load_rows(const ArchiveReader                                          &archive,
            const std::string                                            &name,
            const ContactRows                                            &rows,
            const std::function<void(const ContactRow &, RowUnpacker &)> &unpack);
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_row_derivative_h
#define touchstone_contact_pairing_row_derivative_h

#include <touchstone/contact/row.h>

#include <unordered_map>

namespace Touchstone
{
  /** @brief Collects a RowDerivative node by node. */
  class RowDerivativeBuilder
  {
  public:
    /** @param n_weights Length of the stencil. */
    explicit RowDerivativeBuilder(const std::size_t n_weights)
      : result(std::make_shared<RowDerivative>())
    {
      result->weights.resize(n_weights);
    }

    /** @brief The index of a node; a new one has derivatives of zero. */
    std::size_t
    index(const Index node)
    {
      const auto [entry, is_new] = indices.try_emplace(node, result->nodes.size());
      if (is_new)
        {
          result->nodes.push_back(node);
          result->normal.emplace_back();
          result->gap_vector.emplace_back();
          for (auto &weight : result->weights)
            weight.emplace_back();
        }
      return entry->second;
    }

    std::shared_ptr<RowDerivative> result;

  private:
    std::unordered_map<Index, std::size_t> indices;
  };
} // namespace Touchstone

#endif

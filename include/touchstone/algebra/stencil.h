// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_stencil_h
#define touchstone_algebra_stencil_h

#include <touchstone/base/types.h>

#include <deal.II/base/tensor.h>

#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief One term of a stencil: weight @p weight on the node @p node (the
   * dofs of node k are 3k, 3k+1, 3k+2). */
  struct StencilEntry
  {
    Index  node;
    double weight;
  };

  using Stencil = std::vector<StencilEntry>;

  /** @brief A linear form of the displacements of some nodes: coefficients by node. */
  using NodalForm = std::vector<std::pair<Index, dealii::Tensor<1, dim>>>;

  /** @brief A vector that depends linearly on the displacements of some nodes. */
  using NodalMatrices = std::vector<std::pair<Index, dealii::Tensor<2, dim>>>;

  /** @brief The motion of @p node relative to what it faces by @p stencil, along
   * @p direction. */
  inline NodalForm
  relative_motion(const Index node, const Stencil &stencil, const dealii::Tensor<1, dim> &direction)
  {
    NodalForm form{{node, direction}};
    for (const StencilEntry &entry : stencil)
      form.emplace_back(entry.node, -entry.weight * direction);
    return form;
  }
} // namespace Touchstone

#endif

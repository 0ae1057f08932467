// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_spread_to_master_h
#define touchstone_contact_spread_to_master_h

#include <touchstone/algebra/stencil.h>
#include <touchstone/algebra/vector.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace Touchstone
{
  class Solid;
  class Surface;

  /** @brief What a row leaves at the nodes of its stencil. */
  struct RowShare
  {
    /** Must outlive this. */
    const Stencil *stencil;
    /** Sum of the weights of master nodes, no unit. */
    double sum;
    /** Three numbers, or a vector. */
    dealii::Tensor<1, dim> values;
  };

  /** @brief Sums over rows at the nodes, with the weights of the stencils; hanging nodes hand
   * theirs on to those that they follow. A vector over the dofs of @p solid. Collective. */
  Vector
  spread(const Solid &solid, const std::vector<RowShare> &shares);

  /**
   * @brief Areas at the nodes of a master surface, and what is multiplied by them.
   *
   * Weights are those of the stencils, as of forces. Shape functions of degree 2 and averages have
   * weights of either sign: at the edge of the cover what is left of the area of a node can be
   * negative, or so small that means over it are without meaning. Rows in reach of such a node
   * spread theirs with weights that are nowhere negative and have the same sum.
   */
  class PositiveSpread
  {
  public:
    /** @param areas The area of each row is the first of its values. Collective. */
    PositiveSpread(const Solid &solid, const Surface &master, const std::vector<RowShare> &areas);

    /** @brief The same as of the function, with weights of this kind. Collective. */
    Vector
    operator()(const std::vector<RowShare> &shares) const;

  private:
    const Solid       &solid;
    std::vector<Index> nodes;
  };
} // namespace Touchstone

#endif

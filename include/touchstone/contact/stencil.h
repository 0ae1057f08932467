#ifndef touchstone_contact_stencil_h
#define touchstone_contact_stencil_h

#include <touchstone/types.h>

#include <vector>

namespace Touchstone
{
  /** @brief One term of a stencil: weight @p weight on the node @p node (the
   * unknowns of node k are 3k, 3k+1, 3k+2). */
  struct StencilEntry
  {
    Index  node;
    double weight;
  };

  using Stencil = std::vector<StencilEntry>;
} // namespace Touchstone

#endif

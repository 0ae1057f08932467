#ifndef touchstone_solid_node_pattern_h
#define touchstone_solid_node_pattern_h

#include <touchstone/algebra/vector.h>
#include <touchstone/types.h>

#include <deal.II/base/index_set.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

namespace Touchstone
{
  /**
   * @brief Give @p matrix the pattern of the displacements of coupled nodes: each component of
   * a node is coupled to all components of the others. Collective.
   *
   * Rows go into the graph as they stay there, sorted and by local numbers, which takes half
   * the time of a pattern of single unknowns that Epetra has to translate.
   *
   * @param owned     Unknowns of this rank, whole nodes, without gaps.
   * @param couplings Rows of this rank's nodes.
   */
  void
  reinit_by_nodes(Matrix                               &matrix,
                  const dealii::IndexSet               &owned,
                  const dealii::DynamicSparsityPattern &couplings,
                  MPI_Comm                              communicator);
} // namespace Touchstone

#endif

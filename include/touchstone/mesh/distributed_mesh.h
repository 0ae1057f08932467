// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_distributed_mesh_h
#define touchstone_mesh_distributed_mesh_h

#include <touchstone/base/types.h>

#include <deal.II/distributed/fully_distributed_tria.h>

namespace Touchstone
{
  /** @brief A mesh whose coarse cells are on their ranks already: each refines those it has. The
   * class of deal.II takes refined cells one by one with all that is known of each. */
  class DistributedMesh : public dealii::parallel::fullydistributed::Triangulation<dim>
  {
  public:
    using dealii::parallel::fullydistributed::Triangulation<dim>::Triangulation;

    /** @brief Refine all cells of each rank, without a message. */
    void
    refine_alike(unsigned int n_times);

    bool
    prepare_coarsening_and_refinement() override
    {
      return dealii::Triangulation<dim>::prepare_coarsening_and_refinement();
    }
  };
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_patch_groups_h
#define touchstone_output_patch_groups_h

#include <deal.II/base/data_out_base.h>

#include <cstddef>

namespace Touchstone
{
  /**
   * @brief Patches of solids, in the form that deal.II's writers take, which are made some at a
   * time: all of them at once are larger than the stiffness matrix.
   */
  class PatchGroups : public dealii::DataOutInterface<3, 3>
  {
  public:
    /** @brief From now on get_patches() are those of the next cells, @p most at most; none where a
     * rank has no cells. Not collective. */
    virtual void
    make_next(std::size_t most) = 0;

    /** @brief Whether all cells have had their turn. */
    virtual bool
    finished() const = 0;

    virtual unsigned int
    n_points_per_cell() const = 0;

    /** @name What the patches have, for the writers */
    /** @{ */
    using dealii::DataOutInterface<3, 3>::get_patches;
    using dealii::DataOutInterface<3, 3>::get_dataset_names;
    using dealii::DataOutInterface<3, 3>::get_nonscalar_data_ranges;
    dealii::DataOutBase::VtkFlags flags;
    /** @} */
  };
} // namespace Touchstone

#endif

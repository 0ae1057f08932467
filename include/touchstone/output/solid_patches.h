// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_solid_patches_h
#define touchstone_output_solid_patches_h

#include <touchstone/output/node_numbers.h>
#include <touchstone/output/patch_groups.h>
#include <touchstone/solid/solid.h>

#include <deal.II/fe/fe_values.h>

#include <string>
#include <tuple>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Fields of the bodies as patches, one for each owned cell.
   *
   * Fields are kept once for each node or cell, in single precision as patches have them; cells
   * have copies of the values at their nodes only while they are written.
   */
  class SolidPatches : public PatchGroups
  {
  public:
    /** @param solid, nodes Must outlive this object. */
    SolidPatches(const Solid &solid, const NodeNumbers &nodes);

    /** @brief Add a field of one component.
     * @param values Of the owned nodes in the order of their numbers, or of the active cells.
     * Collective. */
    void
    add(const std::string &name, bool at_nodes, const std::vector<double> &values);

    /** @brief The last so many components that were added are a vector (3) or a tensor (9). */
    void
    join(const std::string &name, unsigned int n_components);

    void
    make_next(std::size_t most) override;

    bool
    finished() const override
    {
      return next == solid.dof_handler.end();
    }

    unsigned int
    n_points_per_cell() const override
    {
      return places.n_quadrature_points;
    }

    const std::vector<dealii::DataOutBase::Patch<3, 3>> &
    get_patches() const override
    {
      return patches;
    }

    std::vector<std::string>
    get_dataset_names() const override;

    std::vector<std::tuple<unsigned int,
                           unsigned int,
                           std::string,
                           dealii::DataComponentInterpretation::DataComponentInterpretation>>
    get_nonscalar_data_ranges() const override
    {
      return ranges;
    }

  private:
    using Patch = dealii::DataOutBase::Patch<3, 3>;

    /** A component: of the nodes of this rank, ghosts last, or of the active cells. */
    struct Row
    {
      std::string        name;
      bool               at_nodes;
      std::vector<float> values;
    };

    const Solid       &solid;
    const NodeNumbers &nodes;
    std::vector<Row>   rows;
    std::vector<std::tuple<unsigned int,
                           unsigned int,
                           std::string,
                           dealii::DataComponentInterpretation::DataComponentInterpretation>>
                       ranges;
    std::vector<Patch> patches;
    /** The first owned cell that has not had its turn. */
    dealii::DoFHandler<dim>::active_cell_iterator next;
    /** Places of the nodes of cells of degree 2, whose edges may be curved. */
    dealii::FEValues<dim>     places;
    std::vector<unsigned int> of_cell;

    void
    to_next_owned();

    void
    fill(Patch &patch);
  };
} // namespace Touchstone

#endif

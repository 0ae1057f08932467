// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_volume_field_h
#define touchstone_output_volume_field_h

#include <touchstone/algebra/vector.h>
#include <touchstone/base/registry.h>
#include <touchstone/base/types.h>

#include <deal.II/base/symmetric_tensor.h>

#include <vector>

namespace Touchstone
{
  class Solid;

  /** @brief What fields are made of, on this rank. */
  struct VolumeState
  {
    const Solid &solid;
    /** With ghosts, length: component d of node k is displacement(3 * k + d). */
    const Vector &displacement;
    /** With ghosts, length per time; null where there is no inertia. */
    const Vector *velocity;
    /** Forces of the supports at the nodes, with ghosts; null where nobody provides them. */
    const Vector *reaction;
    double        time;
    /** Cauchy stress at the owned nodes in the order of their numbers, averaged over the
     * cells around with their volumes as weights; force per area. */
    const std::vector<dealii::SymmetricTensor<2, dim>> &node_stress;
    /** Mean Cauchy stress of the active cells, of which those of owned cells count; force per
     * area. */
    const std::vector<dealii::SymmetricTensor<2, dim>> &cell_stress;
    /** Whether fields of stresses that are not averaged at nodes are asked for. */
    bool cell_values;
  };

  /**
   * @brief A field in the VTU files of the bodies (solution.pvd). It has the name under
   * which it is registered; the documentation there states its unit.
   */
  class VolumeField
  {
  public:
    virtual ~VolumeField() = default;

    enum class Location
    {
      nodes,
      cells
    };

    virtual Location
    location() const
    {
      return Location::nodes;
    }

    /** @brief 1, or 9 for a tensor (its rows one after the other), or 3 for a vector, which only
     * nodes can have. */
    virtual unsigned int
    n_components() const
    {
      return 1;
    }

    /** @brief Whether the run has this field; the same on all ranks. */
    virtual bool
    available(const VolumeState & /*state*/) const
    {
      return true;
    }

    /**
     * @brief Evaluate the field. Called on all ranks.
     * @param values Zeros of the right size. Nodes: n_components() numbers of each owned
     *               node, in the order of node numbers. Cells: those of each active
     *               cell of the triangulation, of which those of owned cells count.
     */
    virtual void
    evaluate(const VolumeState &state, std::vector<double> &values) const = 0;

    /** @brief Fields are sorted by this number, then by their names. */
    virtual unsigned int
    order() const
    {
      return 1000;
    }
  };

  using VolumeFieldRegistry = Registry<VolumeField>;
} // namespace Touchstone

#endif

#ifndef touchstone_output_volume_output_h
#define touchstone_output_volume_output_h

#include <touchstone/output/picture_series.h>
#include <touchstone/solid/solid.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <array>

namespace Touchstone
{
  /**
   * @brief Pictures of the bodies: solution.pvd.
   *
   * The geometry is the undeformed one; the displacement is there to warp it by.
   * Stresses are those of the cells averaged to the nodes with the volumes as
   * weights. Bodies share no nodes, so that nothing is smeared over a contact.
   */
  class VolumeOutput
  {
  public:
    /** @param solid, folder Must outlive this object. */
    VolumeOutput(const Solid &solid, const OutputFolder &folder);

    /** @brief The mesh has changed. */
    void
    reinit()
    {
      node_dofs.clear();
    }

    /** @brief Write the picture of one step.
     * @param displacement With ghosts.
     * @param velocity     With ghosts; null if there is none.
     * @throws OutputError on all ranks. Collective. */
    void
    write(const Vector &displacement, const Vector *velocity, unsigned int step, double time);

    /** @brief The pictures so far, which a run that goes on adds to. */
    PictureSeries &
    series()
    {
      return pictures;
    }

  private:
    using NodeField = dealii::LinearAlgebra::distributed::Vector<double>;

    const Solid            &solid;
    dealii::FE_Q<dim>       node_fe;
    dealii::DoFHandler<dim> node_dofs;
    /** Sum of the volumes of the cells around each node. */
    NodeField     node_volume;
    PictureSeries pictures;

    /** @brief Number the nodes; not before there is a picture to write, for many runs
     * write none. */
    void
    number_nodes();

    NodeField
    make_node_field() const;

    /** @brief The components xx, yy, zz, xy, yz, xz at the nodes, von Mises
     * stress and hydrostatic pressure; force per area, with ghosts. */
    std::array<NodeField, 8>
    node_stress(const Vector &displacement) const;
  };
} // namespace Touchstone

#endif

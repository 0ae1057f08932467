// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_plane_cut_h
#define touchstone_contact_plane_cut_h

#include <touchstone/contact/geometry/surface.h>

#include <deal.II/base/mpi.h>

#include <vector>

namespace Touchstone
{
  /**
   * @brief A plane cut through a bolt whose sides are drawn together along its normal
   * (doc/theory.md 4.3).
   *
   * The sides differ by a shift that is the same everywhere, so that the slave side alone tells how
   * the cut has turned: the normal is that of its area vector int n da in the present state, which
   * turns with the body. In bodies at small strain it is the normal of the reference state.
   */
  class PlaneCut
  {
  public:
    /** @param slave Kept by reference. @param turns The body is at finite strain. Collective. */
    PlaneCut(const Surface &slave, bool turns, MPI_Comm communicator);

    /** @brief How far the cut is from a plane, and how large it is: lengths. The first is infinite
     * for faces that look to different sides. Collective. */
    std::pair<double, double>
    height_and_size() const;

    /** @brief The cut goes on beyond these planes of symmetry, unit normals on any rank: what its
     * normal leans to them the other half makes up for. Collective. */
    void
    set_planes_of_symmetry(const std::vector<dealii::Tensor<1, dim>> &planes);

    /** @brief Draw the sides together by this length. */
    void
    set_shortening(const double length)
    {
      shortening = length;
    }

    /** @brief Unit normal in the displacement @p u with the ghosts of the surface, from the master
     * to the slave side. Collective. */
    dealii::Tensor<1, dim>
    normal(const Vector &u) const;

    /** @brief What the slave side is drawn by, length. Collective. */
    dealii::Tensor<1, dim>
    drawn(const Vector &u) const
    {
      return -shortening * normal(u);
    }

    /** @brief The layer that the shortening has taken out of the bolt. */
    struct Layer
    {
      /** Mean place of the slave side, which is the lower one along the normal. */
      dealii::Point<dim>     place;
      dealii::Tensor<1, dim> normal;
      /** Length; nothing is taken out if it is not positive. */
      double thickness = 0.;

      /** @brief Whether the point lies in it, or no farther beside it than half its thickness, for
       * the sides may have bent. */
      bool
      contains(const dealii::Point<dim> &x) const;
    };

    /** @brief Where the sides of the bolt lie in each other, in the displacement @p u with the
     * ghosts of the surface. Collective. */
    Layer
    taken_out(const Vector &u) const;

  private:
    const Surface &slave;
    const bool     turns;
    const MPI_Comm communicator;
    double         shortening = 0.;
    /** Of the whole cut in the reference state, outward, and the area. */
    dealii::Tensor<1, dim> reference;
    double                 area = 0.;
    /** Orthonormal directions across the planes of symmetry. */
    std::vector<dealii::Tensor<1, dim>> across;

    /** int n da of the slave side, in a displacement or the reference state, null; area. */
    dealii::Tensor<1, dim>
    area_vector(const Vector *u) const;
  };
} // namespace Touchstone

#endif

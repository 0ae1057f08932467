// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_averaged_row_h
#define touchstone_contact_pairing_averaged_row_h

#include <touchstone/base/types.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace Touchstone
{
  /** @brief What a row takes of one slave face, from which the shape of the gap there follows. */
  struct FaceShare
  {
    /** Face::key. */
    std::uint64_t key = 0;
    /** Integrals of psi'_k and of the gap with it, the same with DualBasis::positive(); area,
     * area times length. */
    double                 area = 0., shape_area = 0.;
    dealii::Tensor<1, dim> gap, shape_gap;
    /** As in CoverSums, of this face; length, no unit, length. */
    double own = std::numeric_limits<double>::max(), beside = 1.,
           least = std::numeric_limits<double>::max();
  };

  /** @brief Derivatives of a FaceShare with respect to the position of one node. */
  struct FaceShareDerivative
  {
    dealii::Tensor<1, dim> area, shape_area, own, beside, least;
    /** [i][e]: of component i with respect to component e of the position. */
    dealii::Tensor<2, dim> gap, shape_gap;
  };

  /** @brief Sums over the slave faces around a node, from which its row is made. */
  struct CoverSums
  {
    /** The faces to which the node itself belongs. */
    std::vector<FaceShare> faces;
    /** The integral of psi'_k, and the parts of it and of the area a_k of its own node
     * that are kept and given away; area. */
    double area = 0., kept = 0., given = 0.;
    /** That which is given away since the node leaves its row to others (Face::without_row), area.
     */
    double left_to_others = 0.;
    /** The kept area in the reference state. */
    double reference = 0.;
    /** How far other pairs cover the rest of the node, from 0 to 1, or 1 if its parts of faces are
     * kept or given as a whole in any case, as those of tied rows are. */
    double shared = 0.;
    /** Integrals of gap and normal with psi'_k. */
    dealii::Tensor<1, dim> gap, normal;
    /** MirrorImages::all() of the normal, where the node lies on planes of symmetry: beyond these
     * the integral goes on. */
    dealii::Tensor<2, dim> images = dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>());
    /** The integral of the displacement of the slave relative to the master with psi'_k, area times
     * length, and this displacement at the node, length. */
    dealii::Tensor<1, dim> moved, own_moved;
    /** Integrals with DualBasis::positive() of the distance of the slave surface from its facets,
     * of OverlapSample::inclined, and of 1; area times length, area, area. */
    double arch = 0., inclined = 0., shape_area = 0.;
    /** The smallest gap at any quadrature point or corner of what is covered, along the normal
     * there, length. */
    double least = 0.;
    /** OverlapIntegrals::own, ::beside and ::length: with them the gap at the node is own - length
     * * beside; length, no unit, length. */
    double own = 0., beside = 1., length = 0.;

    /** @brief r of equation (6): how much the node has lost, given away and because the surfaces
     * are inclined to each other, over what is left. */
    double
    loss() const;

    /** @brief Whether enough of the node is covered for a row.
     * @param whole Tributary area. */
    bool
    suffices(double whole) const;
  };

  /** @brief Derivatives of CoverSums with respect to the position of one node. */
  struct CoverSumsDerivative
  {
    dealii::Tensor<1, dim> area, kept, given, reference, least, own, beside, arch, inclined,
      shape_area;
    /** [i][e]: of component i with respect to component e of the position. */
    dealii::Tensor<2, dim> gap, normal, moved, own_moved;
    /** Of GapCorrection::face. */
    FaceShareDerivative face;
  };

  /**
   * @brief What is added to the mean gap of a row, with its derivatives (doc/theory.md
   * 3.1, equations (6) and (7)).
   *
   * A weight function that changes its sign can give a mean below the gap at every point:
   * on a curved face by a part of its sagitta, on a part of a face by extrapolation. Where the
   * surfaces part from each other towards all sides of the node, as undeformed ones do, the gap of
   * a row is that of its node if it is higher; where they are pressed flat on any face it is the
   * mean. Means with a weight that is positive tell them apart. A node that is not covered has the
   * mean. Besides, a row is not less open than surfaces that are clearly apart, and the gap of a
   * node that loses area grows with the part lost (CoverSums::loss()), so that its row opens before
   * its area vanishes and forces change smoothly.
   */
  struct GapCorrection
  {
    double value, by_mean, by_least, by_own, by_beside, by_kept, by_given, by_area;
    /** By how far displacements have moved the node along the normal from the mean, and by the
     * means of the distance of the slave surface from its facets and of OverlapSample::inclined. */
    double by_moved, by_arch, by_inclined;
    /** The face that decides, or null if none does, and derivatives by what it contributes: its
     * mean gaps along the normal with both weights, and own, beside, least and area of its
     * FaceShare. */
    const FaceShare *face = nullptr;
    double by_face_mean, by_face_positive, by_face_own, by_face_beside, by_face_least, by_face_area;

    /** @param sums   Must live as long.
     * @param normal Mean normal.
     * @param mean   Mean gap along the normal.
     * @param size   Size of the faces. */
    GapCorrection(const CoverSums              &sums,
                  const dealii::Tensor<1, dim> &normal,
                  double                        mean,
                  double                        size);
  };

  /**
   * @brief Normal and gap of an averaged row, from the sums over its slave faces, and their
   * derivatives (doc/theory.md 3.1).
   *
   * With the integrals D of psi'_k, G of the gap and N of the normal, that with its images beyond
   * planes of symmetry, and the kept area D_kk:
   *
   *   n = N / |N| ,   gap vector = D/D_kk (G/D + c n) ,
   *
   * c the GapCorrection. The weights of the stencil are integrals over D_kk, too.
   */
  class AveragedRow
  {
  public:
    /** @param sums Must suffice for a row, and live as long. @param size Size of the faces, length.
     */
    AveragedRow(const CoverSums &sums, double size);

    /** Area on all slave nodes of the row by that on its own one, D / D_kk. */
    double                 share;
    dealii::Tensor<1, dim> normal, gap_vector;

    /** @brief Whether the smallest gaps matter, of all points and at the node: otherwise their
     * derivatives are not used. */
    bool
    needs_least() const
    {
      return correction.by_least != 0.;
    }
    bool
    needs_own() const
    {
      return correction.by_own != 0.;
    }
    bool
    needs_beside() const
    {
      return correction.by_beside != 0.;
    }
    /** @brief Whether derivatives of these are used: CoverSums::moved, ::own_moved and ::arch. */
    bool
    needs_shape() const
    {
      return correction.by_moved != 0. || correction.by_arch != 0.;
    }
    /** @brief The face whose derivative is used as well, or null. */
    const FaceShare *
    deciding_face() const
    {
      return correction.face;
    }

    /** @brief d normal, d gap_vector for the derivatives of the sums. */
    void
    differentiate(const CoverSumsDerivative &d,
                  dealii::Tensor<2, dim>    &d_normal,
                  dealii::Tensor<2, dim>    &d_gap_vector) const;

    /** @brief The derivative of a weight of the stencil, w = W / D_kk.
     * @param d_integral Of W. */
    dealii::Tensor<1, dim>
    weight_derivative(double                        weight,
                      const dealii::Tensor<1, dim> &d_integral,
                      const CoverSumsDerivative    &d) const;

  private:
    double                 area, kept, shape_area;
    dealii::Tensor<1, dim> mean, normal_sum;
    dealii::Tensor<2, dim> images;
    /** Displacement at the node, the same less the mean, and the mean arch; length. */
    dealii::Tensor<1, dim> own_moved, moved;
    double                 arch;
    /** The mean of OverlapSample::inclined, no unit. */
    double        inclined;
    GapCorrection correction;
  };
} // namespace Touchstone

#endif

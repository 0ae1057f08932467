#ifndef touchstone_contact_pairing_partial_cover_h
#define touchstone_contact_pairing_partial_cover_h

#include <touchstone/contact/geometry/face.h>
#include <touchstone/contact/geometry/trace_basis.h>

#include <deal.II/lac/full_matrix.h>

#include <array>

namespace Touchstone
{
  /** @brief The integrals of the shape functions of a face over its facet, area.
   * @param basis     Of a face with hanging nodes, or null.
   * @param reference In the reference state, not in the present position. */
  std::array<double, Face::max_nodes>
  whole_areas(const Face &face, const TraceBasis *basis, bool reference);

  /** @brief The derivatives of whole_areas() in the present position: [m][e][k] is that of the
   * integral of shape function k with respect to component e of the position of node m, length. */
  std::array<std::array<std::array<double, Face::max_nodes>, dim>, Face::max_nodes>
  whole_area_derivatives(const Face &face, const TraceBasis *basis);

  /**
   * @brief How the rows of averaged pairing share a slave face that is covered in part.
   *
   * With the dual basis of the covered part each node has its own row, however little of its
   * shape function is covered: the row then holds the node to where the gap extrapolates to,
   * with a force that does not vanish with the area, so the pressure grows without bound.
   * Here nodes with a small share leave the covered part to the others of the face,
   *
   *   psi'_k = sum_i T_ki psi_i,   T_ki = beta_i delta_ki + (1 - beta_i) w_k,
   *
   * with columns that sum to one, so that the psi'_k still add up to one: a uniform pressure, the
   * resultant and the moment stay exact. With areas a_i = int N_i over the covered part and
   * A_i over the whole face, theta_i = a_i / A_i and their mean weighted by a_i, beta_i is a
   * smooth function of theta_i over that mean, one where the face is covered evenly. The
   * receivers w_k are among nodes with beta = 1. Aggregation of weakly cut functions with
   * well cut neighbours: Hoellig, Reif and Wipper (2001), SIAM J. Numer. Anal. 39; Badia,
   * Verdugo and Martin (2018), Comput. Methods Appl. Mech. Engrg. 336.
   */
  struct CoverShares
  {
    /** Whether any beta_i is not one. */
    bool partial = false;
    /** T_ki a_i: [k][i], area. */
    std::array<std::array<double, Face::max_nodes>, Face::max_nodes> share;
    /** Its derivative with respect to a_l: [k][i][l], no unit. */
    std::array<std::array<std::array<double, Face::max_nodes>, Face::max_nodes>, Face::max_nodes>
      derivative;

    /**
     * @param covered         a_i of the n basis functions.
     * @param whole           A_i in the reference state.
     * @param gradual         beta changes smoothly, and not at once.
     * @param with_derivative Compute `derivative`, too.
     */
    CoverShares(unsigned int                               n,
                const std::array<double, Face::max_nodes> &covered,
                const std::array<double, Face::max_nodes> &whole,
                bool                                       gradual,
                bool                                       with_derivative);

    /** @brief The weight functions, psi'_k = sum_j w_kj N_j.
     * @param mass The integrals of the products of the N_j over the covered part; replaced
     *             by its inverse. */
    dealii::FullMatrix<double>
    weights(dealii::FullMatrix<double> &mass) const;
  };

  /** @brief Outward unit normal of the tangent plane at the centre of a face. */
  dealii::Tensor<1, dim>
  plane_normal(const Face &face);

  /** @brief Its derivatives with respect to the positions of the nodes, per length. */
  std::array<dealii::Tensor<2, dim>, Face::max_nodes>
  plane_normal_derivatives(const Face &face);

  /**
   * @brief By which part the area of a slave face counts where the master surface is inclined to
   * it, doc/theory.md 3.
   *
   * Points face each other along the normal of the slave face. Where the other surface is steep,
   * as towards the equator of a ball over a coarse plane, their distance and its normal change
   * within a face by more than a row can represent, and its averages, of weights of both signs,
   * are no gap and no normal that there is: the force of the row would not act against its gap.
   */
  struct FacingPart
  {
    double value, by_cosine;

    /** @param cosine Of the angle between the slave face and the master surface. */
    explicit FacingPart(double cosine);
  };

  /** @brief Cosine of the angle between the plane of a slave face and a master surface with
   * averaged @p normal; found from the averaged normal alone where that is well below the angle
   * at which less than all of the area counts.
   * @param plane plane_normal() of the slave face. @param exact Or null: facets. */
  double
  facing_cosine(const dealii::Tensor<1, dim> &plane,
                const dealii::Tensor<1, dim> &normal,
                const Face                   &master,
                const AnalyticSurface        *exact,
                const std::array<double, 2>  &xi);

  /** @brief Whether a point of a face is one of its nodes. @param shape Value of its shape
   * function there. */
  inline bool
  is_node(const double shape)
  {
    return shape > 1. - 1e-9;
  }

  /** @brief Sums over the slave faces around a node, from which its row is made. */
  struct CoverSums
  {
    /** The integral of psi'_k, and the parts of it and of the area a_k of its own node
     * that are kept and given away; area. */
    double area = 0., kept = 0., given = 0.;
    /** Integrals of gap and normal. */
    dealii::Tensor<1, dim> gap, normal;
    /** The smallest gap at any quadrature point or corner of what is covered, along the normal
     * there, and that at the node itself, infinite if the node is not covered; length. */
    double least = 0., own = 0.;

    /** @brief Whether enough of the node is covered for a row.
     * @param whole Tributary area. */
    bool
    suffices(double whole) const;
  };

  /**
   * @brief What is added to the mean gap of a row, with its derivatives.
   *
   * A weight function that changes its sign can give a mean below all gaps that there are:
   * on a curved face by a part of its sagitta, on a part of a face by extrapolation. While
   * surfaces are apart a row is no closer than the closest of its points: at once if that is
   * the node, with which the gap moves, otherwise where it is well open, as the force of the row
   * hardly moves other points. As the node goes in the mean takes over. And the gap of a node that
   * gives away its area grows with the part given, so that its row opens before it vanishes and
   * forces change smoothly.
   */
  struct GapCorrection
  {
    double value, by_mean, by_least, by_own, by_kept, by_given;

    /** @param mean Mean gap along the mean normal. @param size Size of the faces. */
    GapCorrection(const CoverSums &sums, double mean, double size);
  };
} // namespace Touchstone

#endif

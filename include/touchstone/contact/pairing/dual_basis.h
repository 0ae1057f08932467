// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_dual_basis_h
#define touchstone_contact_pairing_dual_basis_h

#include <touchstone/contact/geometry/face_area.h>
#include <touchstone/contact/pairing/partial_cover.h>

#include <deal.II/base/table.h>

namespace Touchstone
{
  /**
   * @brief The weight functions psi'_k of the rows of a slave face, and how integrals with
   * them change (doc/theory.md 3 and 4).
   *
   * Of the covered part of the face, with the shape functions N_j, let M_jk = int N_j N_k and
   * a_j = int N_j. Where nodes of the face hang, the continuous displacements have the basis
   * N~ = C^T N (TraceBasis; otherwise C = 1), so M~ = C^T M C and a~ = C^T a. The dual basis of the
   * covered part, psi = diag(a~) M~^-1 N~, and its shares psi' = T psi (CoverShares) give
   *
   *   psi'_k = sum_j W_kj N_j ,   W = S M~^-1 C^T ,   S_ki = T_ki a~_i .
   *
   * With Q_jc = int N_j q_c of any q_c, the integral of q_c with psi'_k and its derivative are
   *
   *   r_kc = sum_j W_kj Q_jc ,
   *   dr_k = dS_k Y + W_k (dQ - dM C Y) ,   Y = M~^-1 C^T Q ,
   *
   * from d M~^-1 = -M~^-1 dM~ M~^-1.
   */
  class DualBasis
  {
  public:
    using Values = std::array<double, Face::max_nodes>;

    /**
     * @param mass      M, area.
     * @param areas     a, area.
     * @param basis     Of a face with hanging nodes, or null.
     * @param whole     The integrals of the N~ over the whole face in the reference state, area.
     * @param at_once   Of CoverShares.
     * @param with_derivative share_derivative() will be called.
     */
    DualBasis(const dealii::FullMatrix<double> &mass,
              const Values                     &areas,
              const TraceBasis                 *basis,
              const Values                     &whole,
              const CoverShares::Whole         &at_once,
              bool                              with_derivative);

    /** @brief a~, area. */
    const Values areas;

    /** @brief S and T. */
    const CoverShares shares;

    /** @brief W_kj, no unit. */
    double
    weight(const unsigned int k, const unsigned int j) const
    {
      return weights(k, j);
    }

    /** @brief Y, and C Y. */
    struct Solution
    {
      dealii::FullMatrix<double> of_basis, of_shapes;
    };

    /** @brief The part of N_j in N~_k: C_jk, no unit. */
    double
    shape(const unsigned int k, const unsigned int j) const
    {
      return basis ? basis->weights[j][k] : (j == k ? 1. : 0.);
    }

    /** @brief The part of N_j in P_k, a function that is 1 at node k and nowhere negative, for
     * means over what is near the node, no unit: N~_k for degree 1. For degree 2, where N_k is
     * negative on half of the face or more, the product of straight lines to nodes at ends and of
     * parabolas to nodes in the middle. */
    double
    positive(const unsigned int k, const unsigned int j) const
    {
      return positive_parts.empty() ? shape(k, j) : positive_parts(k, j);
    }

    /** @brief The Y of some integrals Q. */
    Solution
    solve(const dealii::FullMatrix<double> &q) const;

    /** @brief dS_ki for all i. @param d_areas d a~. */
    Values
    share_derivative(unsigned int k, const Values &d_areas) const;

    /** @brief dr_kc for all c. @param v First index of @p d_mass (dM, the whole matrix) and of
     * @p d_q (dQ) that is used: the variable by which they are derivatives.
     * @param d_share share_derivative(). @param result As many as Q has columns. */
    void
    differentiate(unsigned int                    k,
                  const Solution                 &solution,
                  const Values                   &d_share,
                  const dealii::Table<3, double> &d_mass,
                  const dealii::Table<3, double> &d_q,
                  unsigned int                    v,
                  dealii::ArrayView<double>       result) const;

  private:
    const TraceBasis *basis;
    /** M~^-1 of the regularised matrix, and W. */
    dealii::FullMatrix<double> inverse, weights;
    /** positive(), empty for degree 1. */
    dealii::FullMatrix<double> positive_parts;

    void
    set_positive_parts();

    /** The matrix C^T; the unit matrix if no node hangs. */
    dealii::FullMatrix<double>
    to_basis(unsigned int n) const;
  };
} // namespace Touchstone

#endif

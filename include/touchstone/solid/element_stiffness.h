// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_element_stiffness_h
#define touchstone_solid_element_stiffness_h

#include <touchstone/base/types.h>
#include <touchstone/solid/body_parameters.h>

#include <vector>

namespace Touchstone
{
  /**
   * @brief Stiffness of an element of isotropic linear elasticity from the gradients of its
   * shape functions, with its incompatible modes condensed.
   *
   * With G_ab = sum_q w_q grad N_a (x) grad N_b the stiffness between two nodes is lambda
   * G_ab + mu (G_ab^T + tr G_ab I). With B-bar the volumetric part is that of the mean
   * gradients, with the bulk modulus, and the rest is deviatoric.
   *
   * @tparam n_cells 1, or 8 for as many cells at once.
   */
  template <unsigned int n_cells>
  class ElementStiffness
  {
  public:
    ElementStiffness(ElementType               type,
                     const MaterialParameters &material,
                     unsigned int              n_nodes,
                     unsigned int              n_modes,
                     unsigned int              n_points);

    /** @brief Component of the gradient of shape @p a, nodes before modes, at quadrature
     * point @p q of cell @p k, times the root of the point's weight; per length, times the root
     * of a volume. To be set before compute(). */
    double &
    gradient(const unsigned int q,
             const unsigned int a,
             const unsigned int i,
             const unsigned int k = 0)
    {
      return weighted[(n * q + dim * a + i) * n_cells + k];
    }

    /** @brief The same of the mean over the cell and its volume; of B-bar only. */
    double &
    mean_gradient(const unsigned int a, const unsigned int i, const unsigned int k = 0)
    {
      return mean[(dim * a + i) * n_cells + k];
    }

    /** @brief Make the stiffness. */
    void
    compute();

    /** @brief Make of the stiffness of a single cell only what recover_modes() reads: half of the
     * work. */
    void
    compute_modes();

    /** @brief Entry of the stiffness of cell @p k over the unknowns of the nodes, force per
     * length. */
    double
    operator()(const unsigned int i, const unsigned int j, const unsigned int k = 0) const
    {
      return matrix[(n * i + j) * n_cells + k];
    }

    /** @brief Append to the displacements of the nodes of a single cell those of the modes
     * that belong to them. After compute() or compute_modes(). */
    void
    recover_modes(std::vector<double> &displacement) const;

  private:
    const bool         b_bar;
    const double       bulk, mu;
    const unsigned int n_points;
    /** Unknowns of the nodes, and of all. */
    const unsigned int n_kept, n;
    /** Values of all cells are contiguous: the index of the cell runs fastest. */
    std::vector<double> weighted, mean;
    /** The row of a mode is that after elimination of the modes after it. */
    std::vector<double> matrix;

    /** @name To be called from functions with versions for several processors */
    /** @{ */
    /** What is on and above the diagonal, of the columns of all unknowns or of the modes, with the
     * modes eliminated. */
    template <bool modes_only>
    void
    compute_here();

    /** Fill what is below the diagonal, over the unknowns of the nodes. */
    void
    mirror();
    /** @} */
  };

  // Both numbers of cells have versions for several processors, which are no templates.
  template <>
  void
  ElementStiffness<1>::compute();
  template <>
  void
  ElementStiffness<8>::compute();
  template <>
  void
  ElementStiffness<1>::compute_modes();
  template <>
  void
  ElementStiffness<1>::recover_modes(std::vector<double> &displacement) const;
} // namespace Touchstone

#endif

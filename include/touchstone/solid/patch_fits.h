// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_patch_fits_h
#define touchstone_solid_patch_fits_h

#include <touchstone/solid/patch_polynomials.h>
#include <touchstone/solid/vertex_values.h>

#include <deal.II/base/symmetric_tensor.h>

#include <vector>

namespace Touchstone
{
  /**
   * @brief Polynomials fitted to the stresses of the cells around each vertex.
   *
   * The highest power of a direction is fitted where cells lie on both sides of the vertex; a
   * vertex whose neighbours have more of such directions, as at boundaries, takes the fits of
   * these. Zienkiewicz and Zhu (1992), Int. J. Numer. Meth. Engng 33; doc/theory.md 11, "Contact
   * forces".
   */
  class PatchFits
  {
  public:
    using Cell = dealii::DoFHandler<dim>::active_cell_iterator;

    /** @brief Of degree 1 or 2. @param vertices One number for each vertex; @p relevant those that
     * this rank knows. */
    PatchFits(unsigned int                   degree,
              const dealii::DoFHandler<dim> &vertices,
              const dealii::IndexSet        &relevant);

    /** @brief Add the stresses of an owned cell of @p vertices at points @p x. */
    void
    add_cell(const Cell                                         &cell,
             const std::vector<dealii::Point<dim>>              &x,
             const std::vector<dealii::SymmetricTensor<2, dim>> &stress);

    /** @brief Fit at all vertices. Collective. */
    void
    fit();

    /** @brief Component @p c of the stress by the polynomial of a vertex, at @p d from it. */
    double
    value(Index vertex, unsigned int c, const dealii::Tensor<1, dim> &d) const;

  private:
    const PatchPolynomials         polynomials;
    const dealii::DoFHandler<dim> &vertices;
    const dealii::IndexSet        &relevant;
    /** Number of monomials, and the place of the number of directions with cells on both sides, -1
     * while there is no polynomial, after the coefficients of all components. */
    const unsigned int n, directions;
    VertexValues       sums, fields;

    /** The fit at one vertex. */
    void
    fit(Index vertex, VertexValues &to) const;

    /** Give vertices without a polynomial the mean of those of the others of their cells. */
    void
    extend();
  };
} // namespace Touchstone

#endif

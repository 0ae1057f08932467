// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_stress_recovery_h
#define touchstone_solid_stress_recovery_h

#include <touchstone/solid/solid.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <array>
#include <vector>

namespace Touchstone
{
  /** @brief Stresses, places and volumes of quadrature points of the owned cells, cell by cell, in
   * the order of Solid::for_each_stress(). */
  struct PointStresses
  {
    std::vector<dealii::SymmetricTensor<2, dim>> stress;
    std::vector<dealii::Point<dim>>              x;
    std::vector<double>                          volume;
  };

  /** @brief A continuous stress by its nodal values, one vector for each component in the order of
   * SymmetricTensor::access_raw_entry(), with ghosts; force per area. */
  using StressField = std::array<dealii::LinearAlgebra::distributed::Vector<double>,
                                 dealii::SymmetricTensor<2, dim>::n_independent_components>;

  /**
   * @brief Continuous stresses made from the discontinuous ones of the cells, over the nodes of the
   * displacement. Bodies share no nodes, so that they are continuous within each body only.
   * All functions are collective.
   */
  class StressRecovery
  {
  public:
    /** @brief Of a stress. */
    static constexpr unsigned int n_components =
      dealii::SymmetricTensor<2, dim>::n_independent_components;

    explicit StressRecovery(const Solid &solid);

    /** @brief The stresses of the cells in displacement @p u, with ghosts. */
    PointStresses
    of_cells(const Vector &u) const;

    /** @brief Averages at the nodes, int N sigma / int N, a projection with lumped mass.
     * Zienkiewicz and Zhu (1987), Int. J. Numer. Meth. Engng 24. One-sided at boundaries. */
    StressField
    averages(const PointStresses &points);

    /** @brief Values at the nodes of the polynomials of the element's degree that fit the stresses
     * of the cells around the vertices best where these are most accurate, and at boundaries those
     * of the fits of the next vertices inward. Zienkiewicz and Zhu (1992), Int. J. Numer. Meth.
     * Engng 33. */
    StressField
    patches(const PointStresses &points) const;

    /** @brief Fits by patches(), whose own recovered errors have been taken away. */
    StressField
    corrected(PointStresses points);

    /** @brief Take the field away from the stresses of the points. */
    void
    subtract(const StressField &field, PointStresses &points);

    /** @brief Nodes, one unknown each, and their shapes. */
    const dealii::DoFHandler<dim> &
    nodes() const
    {
      return numbers;
    }

  private:
    const Solid            &solid;
    const dealii::FE_Q<dim> fe;
    dealii::DoFHandler<dim> numbers;
    /** Of the cells, one number each; for degree 1 the nodes. */
    dealii::DoFHandler<dim> vertices;
    dealii::IndexSet        relevant, relevant_vertices;
    dealii::FEValues<dim>   values;
    /** Hanging nodes. */
    dealii::AffineConstraints<double> hanging;
  };
} // namespace Touchstone

#endif

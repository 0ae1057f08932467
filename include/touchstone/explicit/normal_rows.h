// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_normal_rows_h
#define touchstone_explicit_normal_rows_h

#include <touchstone/base/types.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <cstdint>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Contact rows whose impulses act along their normals, one behind the other, and the loops
   * of a sweep over them (doc/explicit.md, section 9.2).
   *
   * Vectors have four numbers, which processors load, multiply and store at once. Sums at nodes run
   * in the order of the rows, and products are rounded before they are added: another rank that
   * sends them adds the same numbers.
   */
  struct NormalRows
  {
    /** @brief A row, with what comes before its first entry: the next row has its end. */
    struct Row
    {
      std::size_t row, first;
      /** Velocity that it leaves free, and that of the obstacle taken from it. */
      double allowed, drive;
      /** Bound of the mobility that it shares; zero: supports decide. */
      double mobility;
      double impulse, extrapolated, present;
    };
    struct Vector
    {
      double c[4];
    };
    /** One more than there are rows. */
    std::vector<Row> rows;
    /** By entry: what an impulse of one does to a node, and the size of that; the node; and where
     * other ranks have rows, the slot. */
    std::vector<Vector>       entries;
    std::vector<unsigned int> nodes, slots;
    /** By node: velocity without impulses, inverse mass in its axes and beyond them (23, 13, 12),
     * and its norm; the sum of what rows do, or in the last place of the sizes of that; velocity.
     */
    std::vector<Vector> free, mobility, oblique, sums, velocity;
    std::vector<double> mobility_norms;
    /** A node has an inverse mass beyond the axes. */
    bool any_oblique = false;

    unsigned int
    size() const
    {
      return rows.size() - 1;
    }

    void
    clear();

    /** @brief Add an entry to the last row that was added. */
    void
    add(const dealii::Tensor<1, dim> &c, const double norm, const unsigned int node)
    {
      entries.push_back({{c[0], c[1], c[2], norm}});
      nodes.push_back(node);
    }

    void
    set_nodes(const std::vector<dealii::Tensor<1, dim>>          &free_velocity,
              const std::vector<dealii::SymmetricTensor<2, dim>> &mobilities);

    /** @brief Sum at the nodes what impulses of the rows do, and in the last place the sizes of
     * their entries. */
    void
    sum(double Row::*impulse);
    void
    sum_sizes();

    /** @brief Set the bounds of mobility of the rows from the sums of the sizes at their nodes.
     * @param immobile Part of the whole mobility that is round-off. */
    void
    set_bounds(double immobile, double relaxation);

    /** @brief Velocities of the first @p n nodes from the sums. */
    void
    move(unsigned int n);

    /** @brief The same without those that are there without impulses. */
    void
    respond(unsigned int n);

    /** @brief Relative velocities of the rows, without the drive. */
    void
    along_normals(std::vector<double> &result) const;

    /** @brief Relative velocity of a row, without the drive. */
    double
    relative_velocity(unsigned int i) const;

    /** @brief The minimum of the bound in each impulse, from the extrapolated ones.
     * @param largest Change of a velocity, and of an impulse since the last sweep. */
    void
    improve(double (&largest)[2]);

    /** @brief Go on with this part of the change of the impulses. */
    void
    extrapolate(double part);

    /** @brief Sum of the products of each row's step with the change of its impulse since the last
     * sweep, negative where the step goes on, in units of 2^-32 of @p unit, which none is above: a
     * sum of whole numbers does not depend on their order. */
    std::int64_t
    turn(double unit) const;

  private:
    void
    add_oblique(unsigned int n);
  };
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_overlap_integrals_h
#define touchstone_contact_pairing_overlap_integrals_h

#include <touchstone/contact/geometry/value_of.h>
#include <touchstone/contact/pairing/overlap_sample.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/lac/full_matrix.h>

#include <array>
#include <limits>
#include <vector>

namespace Touchstone
{
  /** @brief The columns of OverlapIntegrals::q; those of the master nodes come last. */
  namespace OverlapColumns
  {
    constexpr unsigned int area = 0, gap = 1, normal = gap + dim, master = normal + dim;
  }

  /**
   * @brief The integrals over the overlap of a slave face with one master face from which the rows
   * of the slave nodes are made (doc/theory.md 3 and 4, "Derivatives of rows"):
   *
   *   M_jk = int N_j N_k ,   Q_jc = int N_j q_c ,   q = (1, x_s - x_m, n, N_1, ..., N_n) ,
   *
   * N_j the slave shapes and N_1, ... those of the master face.
   * @tparam n Nodes of a face, 4 or 9.
   * @tparam Number double, or PositionFad<n>: the derivatives of the integrals come with them.
   */
  template <unsigned int n, typename Number>
  struct OverlapIntegrals
  {
    static constexpr unsigned int n_columns = OverlapColumns::master + n;

    /** M, area; only k <= j is set. */
    std::array<std::array<Number, n>, n> mass{};
    /** Q: area, area times length for the gap. */
    std::array<std::array<Number, n_columns>, n> q{};
    /** The smallest gap along the normal at any point or corner of the overlap, and that at each
     * slave node; length. Where a node is not covered, the closest corner stands for it, with a gap
     * that is larger by the distance h (1 - N_j) from the node: a node that comes to lie on the
     * other side of the edge of the cover, as it does by round-off beside a plane of symmetry, must
     * not change its gap by a jump (doc/theory.md 3.1, equation (7)). */
    Number                least = std::numeric_limits<double>::max();
    std::array<Number, n> own;

    /** @param length Size h of the slave face, reference state. */
    explicit OverlapIntegrals(const double length)
      : length(length)
    {
      own.fill(Number(std::numeric_limits<double>::max()));
    }

    /** @brief Add a quadrature point; one without weight counts only for the smallest gaps. */
    void
    add(const OverlapSample<n, Number> &sample)
    {
      const Number distance = dot(sample.gap, sample.normal);
      if (distance < least)
        least = distance;
      if (value_of(sample.weight) == 0.)
        {
          for (unsigned int j = 0; j < n; ++j)
            {
              const Number from_node = distance + length * (1. - sample.slave_shape[j]);
              if (from_node < own[j])
                own[j] = from_node;
            }
          return;
        }
      for (unsigned int j = 0; j < n; ++j)
        {
          const Number weight = sample.weight * sample.slave_shape[j];
          for (unsigned int k = 0; k <= j; ++k)
            mass[j][k] += weight * sample.slave_shape[k];
          q[j][OverlapColumns::area] += weight;
          for (unsigned int d = 0; d < dim; ++d)
            {
              q[j][OverlapColumns::gap + d] += weight * sample.gap[d];
              q[j][OverlapColumns::normal + d] += weight * sample.normal[d];
            }
          for (unsigned int m = 0; m < n; ++m)
            q[j][OverlapColumns::master + m] += weight * sample.master_shape[m];
        }
    }

  private:
    double length;
  };

  /** @brief The length h by which distances on a slave face are measured: the mean of its
   * diagonals, which does not depend on the order of its nodes. */
  inline double
  face_length(const Face &slave)
  {
    return 0.5 * (slave.reference[0].distance(slave.reference[3]) +
                  slave.reference[1].distance(slave.reference[2]));
  }

  /** @brief The mass matrix of what several master faces cover of a slave face.
   * @param parts Their OverlapIntegrals. */
  template <unsigned int n, class Parts>
  dealii::FullMatrix<double>
  total_mass(const Parts &parts)
  {
    dealii::FullMatrix<double> mass(n, n);
    for (const auto &part : parts)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int k = 0; k <= j; ++k)
          mass(j, k) += value_of(part.mass[j][k]);
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int k = 0; k < j; ++k)
        mass(k, j) = mass(j, k);
    return mass;
  }

  /** @brief The areas int N_j of what several master faces cover of a slave face. */
  template <unsigned int n, class Parts>
  std::array<double, Face::max_nodes>
  total_areas(const Parts &parts)
  {
    std::array<double, Face::max_nodes> areas{};
    for (const auto &part : parts)
      for (unsigned int j = 0; j < n; ++j)
        areas[j] += value_of(part.q[j][OverlapColumns::area]);
    return areas;
  }
} // namespace Touchstone

#endif

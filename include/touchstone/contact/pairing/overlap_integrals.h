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
    constexpr unsigned int area = 0, gap = 1, normal = gap + dim, moved = normal + dim,
                           arch = moved + dim, inclined = arch + 1, master = inclined + 1;
  }

  /**
   * @brief The integrals over the overlap of a slave face with one master face from which the rows
   * of the slave nodes are made (doc/theory.md 3 and 4, "Derivatives of rows"):
   *
   *   M_jk = int N_j N_k ,   Q_jc = int N_j q_c ,   q = (1, x_s - x_m, n, u_s - u_m, b, 1 - S,
   * N_1, ..., N_n) ,
   *
   * N_j the slave shapes, N_1, ... those of the master face, b
   * OverlapSample::arch and 1 - S OverlapSample::inclined.
   * @tparam n Nodes of a face, 4 or 9.
   * @tparam Number double, or PositionFad<n>: the derivatives of the integrals come with them.
   */
  template <unsigned int n, typename Number>
  struct OverlapIntegrals
  {
    static constexpr unsigned int n_columns = OverlapColumns::master + n;

    /** M, area; only k <= j is set. */
    std::array<std::array<Number, n>, n> mass{};
    /** Q: area; area times length for gap, displacement and arch. */
    std::array<std::array<Number, n_columns>, n> q{};
    /** The smallest gap along the normal at any point or corner of the overlap; length. */
    Number least = std::numeric_limits<double>::max();
    /** For each slave node the smallest of g + l (1 - N_j) and of 1 - N_j over the corners, from
     * which the gap at the node follows (doc/theory.md 3.1, equation (7)). Where the node is not
     * covered, the closest corner stands for it: a node that comes to lie on the other side of the
     * edge of the cover, as it does by round-off beside a plane of symmetry, must not change its
     * gap by a jump. */
    std::array<Number, n> own, beside;
    /** OverlapSample::moved where own is smallest, length. */
    std::array<Vector3<Number>, n> own_moved{};
    /** The length l, the same for all faces of the surface: otherwise the closest corner could
     * change by a jump where faces of different sizes meet. */
    double length;

    /** @param length Longest diagonal of the faces of the slave surface. */
    explicit OverlapIntegrals(const double length)
      : length(length)
    {
      own.fill(Number(std::numeric_limits<double>::max()));
      beside.fill(Number(1.));
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
              const Number away = 1. - sample.slave_shape[j];
              if (away < beside[j])
                beside[j] = away;
              const Number from_node = distance + length * away;
              if (from_node < own[j])
                {
                  own[j]       = from_node;
                  own_moved[j] = sample.moved;
                }
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
              q[j][OverlapColumns::moved + d] += weight * sample.moved[d];
            }
          q[j][OverlapColumns::arch] += weight * sample.arch;
          if (value_of(sample.inclined) > 0.)
            q[j][OverlapColumns::inclined] += weight * sample.inclined;
          for (unsigned int m = 0; m < n; ++m)
            q[j][OverlapColumns::master + m] += weight * sample.master_shape[m];
        }
    }
  };

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

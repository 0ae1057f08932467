// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_general_surface_row_h
#define touchstone_explicit_general_surface_row_h

#include <touchstone/explicit/general/moving_surface.h>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

namespace Touchstone
{
  /** @brief A row of general contact: a node and a face, or two edges, that must not come nearer to
   * each other than they may (doc/general_contact.md, section 3). */
  struct SurfaceRow
  {
    /** First numbers of the keys of rows, above all numbers of pairs. */
    static constexpr std::uint64_t on_faces = std::uint64_t(1) << 32, on_edges = on_faces + 1;

    /** @brief A point as a sum of nodes by slots, at most a face. */
    struct Side
    {
      unsigned int               n = 0;
      std::array<std::size_t, 4> slots{};
      std::array<double, 4>      weights{};

      void
      add(const SurfacePoint &point, double weight);
    };

    RowKey key;
    /** Slave and master side, and the outward normal of the latter. */
    std::array<Side, 2>    sides;
    dealii::Tensor<1, dim> normal;
    /** Size of the faces, length, and the gap at the start of the cycle. */
    double size = 0., gap = 0.;
    /** By how much the gap must open in this cycle beyond what it may end with, length: it was
     * to be kept open before, and surfaces that are moved inwards crossed all the same. */
    double more = 0.;
    /** It is open as far as that takes no work. */
    bool fully_open = false;
    /** Takes part in this cycle. */
    bool used = false;
    /** The pair of edges that it is of, if any. */
    std::size_t edges = std::numeric_limits<std::size_t>::max();

    /** @brief Whether @p holds(slot) for any slot of the sides; the others are not asked. */
    template <class Holds>
    bool
    any_slot(const Holds &holds) const
    {
      for (const Side &side : sides)
        for (unsigned int i = 0; i < side.n; ++i)
          if (holds(side.slots[i]))
            return true;
      return false;
    }
  };

  /** @brief Hash and equality of keys of rows. */
  struct OfRowKey
  {
    std::size_t
    operator()(const RowKey &key) const
    {
      std::uint64_t h = key.pair;
      for (const std::uint64_t next : {key.slave, key.others[0], key.others[1], key.others[2]})
        h = (h ^ (h >> 29)) * 0x9E3779B97F4A7C15ull + next;
      return h ^ (h >> 32);
    }
    bool
    operator()(const RowKey &a, const RowKey &b) const
    {
      return a.slave == b.slave && a.others == b.others && a.pair == b.pair;
    }
  };

  /** @brief The row of a node and the triangle between two corners of a face and its middle. */
  SurfaceRow
  node_row(const MovingSurface          &surface,
           const SurfacePoint           &node,
           unsigned int                  face,
           unsigned int                  triangle,
           const std::array<double, 3>  &weights,
           const dealii::Tensor<1, dim> &normal);

  /** @brief The row of points on two edges. @param at_edges Where they are, from 0 to 1. */
  SurfaceRow
  edge_row(const MovingSurface           &surface,
           const MovingSurface::TwoEdges &ends,
           const std::array<double, 2>   &at_edges,
           const dealii::Tensor<1, dim>  &normal);

  /** @brief The row of two edges where they are nearest to each other at the start of the cycle;
   * nothing if that is beyond their ends or if they are parallel. */
  std::optional<SurfaceRow>
  nearest_edges(const MovingSurface &surface, const MovingSurface::TwoEdges &ends);

  /** @brief The gap of a row on the surface that is moved inwards, at the end of the cycle; length.
   */
  double
  inner_gap_at_end(const MovingSurface &surface, const SurfaceRow &row);
} // namespace Touchstone

#endif

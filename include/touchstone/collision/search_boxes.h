// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_collision_search_boxes_h
#define touchstone_collision_search_boxes_h

#include <touchstone/base/types.h>

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief Numbers of two boxes that intersect. */
  using BoxPairs = std::vector<std::pair<unsigned int, unsigned int>>;

  /** @brief A closed box with sides along the axes, without the checks that
   * dealii::BoundingBox makes on each access. */
  struct FlatBox
  {
    double lower[dim], upper[dim];

    /** @brief Whether both have a point in common; faces that touch do. */
    bool
    meets(const FlatBox &other) const
    {
      // Without branches: which of the six decides cannot be predicted.
      return (lower[0] <= other.upper[0]) & (other.lower[0] <= upper[0]) &
             (lower[1] <= other.upper[1]) & (other.lower[1] <= upper[1]) &
             (lower[2] <= other.upper[2]) & (other.lower[2] <= upper[2]);
    }

    /** @brief Whether @p other lies within, boundary included. */
    bool
    contains(const FlatBox &other) const
    {
      return (lower[0] <= other.lower[0]) & (other.upper[0] <= upper[0]) &
             (lower[1] <= other.lower[1]) & (other.upper[1] <= upper[1]) &
             (lower[2] <= other.lower[2]) & (other.upper[2] <= upper[2]);
    }

    /** @brief Grow until @p other lies within. */
    void
    merge(const FlatBox &other)
    {
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = std::min(lower[d], other.lower[d]);
          upper[d] = std::max(upper[d], other.upper[d]);
        }
    }

    /** @brief Move each face outwards by @p distance. */
    FlatBox
    grown(const double distance) const
    {
      FlatBox result;
      for (unsigned int d = 0; d < dim; ++d)
        {
          result.lower[d] = lower[d] - distance;
          result.upper[d] = upper[d] + distance;
        }
      return result;
    }

    /** @brief Square of the distance of @p x; 0 within. */
    double
    distance_square(const dealii::Point<dim> &x) const
    {
      double result = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double away = std::max({lower[d] - x[d], x[d] - upper[d], 0.});
          result += away * away;
        }
      return result;
    }

    /** @brief The longest side. */
    double
    size() const
    {
      return std::max({upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]});
    }

    /** @brief Sum of the sides in the three directions. */
    double
    sum_of_sides() const
    {
      return (upper[0] - lower[0]) + (upper[1] - lower[1]) + (upper[2] - lower[2]);
    }
  };

  /**
   * @brief The boxes of a search: of one set, or of two that follow one another, so that each
   * box has one number, and methods do not distinguish slave and master. All values are finite
   * and no box is inverted.
   */
  struct SearchBoxes
  {
    std::vector<FlatBox> boxes;
    /** @brief Size of the first set; that of the only one. */
    unsigned int n_first = 0;
    bool         one_set = true;
    /** @brief The smallest box around all; not set if there is none. */
    FlatBox whole;

    /** @brief Forget what was there. */
    void
    clear();

    /**
     * @brief Append the boxes of a set.
     * @param name What to call it in the message.
     * @throws ExplicitFailure for a box that is not finite, not below 1e150, or inverted.
     */
    void
    append(const std::vector<dealii::BoundingBox<dim>> &set, const std::string &name);

    unsigned int
    n() const
    {
      return boxes.size();
    }

    /** @brief Whether a pair of these is asked for: between two sets, and not within them. */
    bool
    sought(const unsigned int i, const unsigned int j) const
    {
      return one_set || (i < n_first) != (j < n_first);
    }

    /** @brief Note the pair if it is asked for and its boxes intersect. */
    void
    test(const unsigned int i, const unsigned int j, BoxPairs &pairs) const
    {
      if (sought(i, j) && boxes[i].meets(boxes[j]))
        pairs.emplace_back(i, j);
    }

    /** @brief The median of the longest sides; 0 if there are no boxes. */
    double
    median_size() const;
  };
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_normal_search_h
#define touchstone_contact_pairing_normal_search_h

#include <touchstone/contact/pairing/line_and_face.h>
#include <touchstone/contact/pairing/pairing.h>

#include <limits>
#include <optional>
#include <vector>

namespace Touchstone
{
  /** @brief A point of the slave surface that looks for the master along its own normal. */
  struct LookingPoint
  {
    dealii::Point<dim> x;
    /** Unit outward normal of the slave surface. */
    dealii::Tensor<1, dim> n;
    /** See SlavePoint. */
    bool stays_at_end = false;
    /** Index of the face at which the search begins, in Search::known_faces(); any other only
     * costs time. */
    std::size_t guess = std::numeric_limits<std::size_t>::max();
    /** Where the point was when the step began, if steps are committed. */
    dealii::Point<dim> start{};
  };

  /** @brief What it sees. */
  struct FacingPoint
  {
    /** Valid until the next update. */
    const Face *face = nullptr;
    LineOnFace  at;
  };

  /**
   * @brief Finds the point of the master surface that a line along a slave normal meets first, on
   * whatever rank the face lives (doc/theory.md 3.4).
   *
   * "First" is closest to the slave point on either side of it, so that one that has penetrated
   * finds the surface that it came through. Faces on the far side of a body are not seen.
   */
  class NormalSearch
  {
  public:
    explicit NormalSearch(const PairingInput &input);

    /** @brief A step ends with the displacement @p u (with ghosts), null for the reference state.
     * Without any call far sides of thin bodies are not known as such. */
    void
    commit(const Vector *u)
    {
      search.commit(u);
    }

    /** @brief Exchange the master faces in their present position. Collective.
     * @param positions Of this rank's slave points, also those at the start of the step if steps
     * are committed. */
    void
    update(const std::vector<dealii::Point<dim>> &positions)
    {
      search.update(positions);
    }

    /** @brief The face that is met, and where; nothing beyond the edge of the master surface and
     * the reach. Does not depend on the guess. */
    std::optional<FacingPoint>
    look(const LookingPoint &point) const;

    /** @brief Farthest distance at which anything is met, length. */
    double
    reach() const
    {
      return farthest;
    }

    /** @brief No master face is closer to a point than this, length; at most the reach. */
    double
    least_distance(const dealii::Point<dim> &x) const;

    const Search &
    faces() const
    {
      return search;
    }

  private:
    const double farthest, edge_tolerance;
    Search       search;

    /** Keep the face of index @p i as @p best if it is met, and is the first. */
    void
    offer(std::size_t i, const LookingPoint &point, std::optional<FacingPoint> &best) const;
  };
} // namespace Touchstone

#endif

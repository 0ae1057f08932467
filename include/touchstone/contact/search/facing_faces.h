// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_search_facing_faces_h
#define touchstone_contact_search_facing_faces_h

#include <touchstone/contact/geometry/overlap.h>
#include <touchstone/contact/search/search.h>

#include <unordered_map>
#include <vector>

namespace Touchstone
{
  /** @brief A master face with the quadrature of what it covers of a slave face. */
  struct FacingFace
  {
    const Face               *master;
    std::vector<OverlapPoint> points;
  };

  /** @brief The master faces alone. */
  std::vector<const Face *>
  masters_of(const std::vector<FacingFace> &facing);

  /** @brief A slave face and the master faces that cover it. */
  struct CoveredFace
  {
    Face                    slave;
    std::vector<FacingFace> masters;
  };

  /**
   * @brief Which master faces cover a slave face in averaged rows (doc/theory.md 4, "Passing
   * through").
   *
   * All master faces within reach whose normals oppose that of the slave face, if they are one
   * connected component over common nodes. Of several components, or where the slave face has
   * passed through a body since the start of the step, one takes precedence: that which the
   * face touched, or that its nodes and its centre have entered first; otherwise the closest.
   * Faces of other components that lie behind it are left out.
   */
  class FacingFaces
  {
  public:
    /** @param search Must live as long.
     *  @param motion How far nodes may move until invalidate() must be called; length. */
    FacingFaces(const Search &search, const double motion)
      : search(search)
      , limit(motion)
    {
    }

    /** @brief The faces that cover @p slave now. Those that may are determined only the
     * first time after invalidate(), except for slave faces that have several components to
     * choose from.
     * @param slave In its present position, with `committed` of the start of the
     * step. */
    std::vector<FacingFace>
    find(const Face &slave);

    /** @brief Nodes have moved by more than motion(), or a step begins or ends: the next find()
     * searches. */
    void
    invalidate()
    {
      candidates.clear();
    }

    /** @brief How far nodes may move. */
    double
    motion() const
    {
      return limit;
    }

    /** @brief A step ends in the present positions: remember what each face touches.
     * @param faces All slave faces of this rank, with what find() has found. */
    void
    commit(const std::vector<CoveredFace> &faces);

    /** By the keys of slave faces, those of the master faces that they touched. */
    using Touched = std::unordered_map<std::uint64_t, std::uint64_t>;

    /** @brief What commit() has found. */
    const Touched &
    last_touched() const
    {
      return touched;
    }

    /** @brief Restore last_touched() of an earlier run. */
    void
    remember(const Touched &found)
    {
      touched = found;
    }

  private:
    const Search &search;
    const double  limit;
    Touched       touched;

    /** Keys of master faces and their indices in the search. */
    using Candidates = std::vector<std::pair<std::uint64_t, std::size_t>>;
    /** By the keys of slave faces those that cover them or may soon. */
    std::unordered_map<std::uint64_t, Candidates> candidates;

    /** Master faces that @p slave has entered since the start of the step; the last
     * one, if @p last_touched, is that which it touched then. */
    struct Entries
    {
      std::vector<const Face *> faces;
      bool                      last_touched = false;
    };

    Entries
    entries(const Face &slave, const dealii::Tensor<1, dim> &normal) const;

    /** Whether more than one component may cover @p slave, now or since the start of the step.
     * @param covering Those that do. @param near All that are within reach. */
    bool
    is_ambiguous(const Face                    &slave,
                 const dealii::Tensor<1, dim>  &normal,
                 const std::vector<FacingFace> &covering,
                 const bool                     connected) const;

    /** Whether what a master face covers of @p slave is behind it on the far side of a thin body.
     * @param normal Of the slave face. */
    bool
    lies_far(const Face                   &slave,
             const dealii::Tensor<1, dim> &normal,
             const FacingFace             &facing) const;

    /** Of @p masters those that cover @p slave, but not from the far side of their body.
     * @param normal Of the slave face. */
    std::vector<FacingFace>
    cover(const Face                      &slave,
          const dealii::Tensor<1, dim>    &normal,
          const std::vector<const Face *> &masters) const;

    /** What covers @p slave if there are several components, by their precedence. */
    std::vector<FacingFace>
    resolve(const Face &slave, const dealii::Tensor<1, dim> &normal, const Entries &entries) const;
  };
} // namespace Touchstone

#endif

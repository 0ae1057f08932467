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
   * @brief Which master faces cover a slave face in averaged rows.
   *
   * All that look at it within reach do, if they hang together over common nodes: a
   * layer. Of several layers, or where the slave face has passed through a body since the
   * start of the step, one comes first: that which the face touched, or that its nodes
   * and its centre went in through first; otherwise the closest. Faces of other
   * layers that lie behind it are left out.
   */
  class FacingFaces
  {
  public:
    /** @param search Must live as long.
     *  @param motion How far nodes may move until look_anew() must be called; length. */
    FacingFaces(const Search &search, const double motion)
      : search(search)
      , limit(motion)
    {
    }

    /** @brief The faces that cover @p slave now. Those that can are looked for only the
     * first time after look_anew(), but for faces in doubt between several layers.
     * @param slave In its present position, with `committed` of the start of the
     * step. */
    std::vector<FacingFace>
    find(const Face &slave);

    /** @brief Nodes have moved by more than motion(), or a step begins or ends. */
    void
    look_anew()
    {
      candidates.clear();
    }

    /** @brief How far nodes may move. */
    double
    motion() const
    {
      return limit;
    }

    /** @brief A step ends in the present positions: each face remembers what it
     * touches. @param faces All slave faces of this rank, with what find() has found. */
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

    /** @brief Let this be what commit() has found. */
    void
    remember(const Touched &found)
    {
      touched = found;
    }

  private:
    const Search &search;
    const double  limit;
    Touched       touched;

    /** Keys of master faces and their places in the search. */
    using Candidates = std::vector<std::pair<std::uint64_t, std::size_t>>;
    /** By the keys of slave faces those that cover them or may soon. */
    std::unordered_map<std::uint64_t, Candidates> candidates;

    /** Master faces where @p slave has gone in since the start of the step; the last
     * one, if @p last_touched, is that which it touched then. */
    struct Entries
    {
      std::vector<const Face *> faces;
      bool                      last_touched = false;
    };

    Entries
    entries(const Face &slave, const dealii::Tensor<1, dim> &normal) const;

    std::vector<FacingFace>
    resolve(const Face &slave, const dealii::Tensor<1, dim> &normal, const Entries &entries) const;
  };
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_search_swept_search_h
#define touchstone_contact_search_swept_search_h

#include <touchstone/contact/search/face_tree.h>
#include <touchstone/contact/search/slave_point.h>

#include <optional>

namespace Touchstone
{
  /**
   * @brief Finds where nodes have passed through faces since the start of the step (doc/theory.md
   * 4, "Passing through").
   *
   * Nodes and faces move on straight lines from their committed to their present positions.
   */
  class SweptSearch
  {
  public:
    /** @param tree Must live as long.
     * @param reach Of the search, length: a scale for distances that are equal. */
    SweptSearch(const FaceTree &tree, const double reach)
      : tree(tree)
      , reach(reach)
    {
    }

    /** @brief Where a node has passed into a body since the start of the step, unless it
     * came out again: the point closest to its present position around the face that it passed
     * first. Nothing if steps are not committed.
     * @param penetrates The closest face already shows that the node is within one body, which is
     * then not counted. */
    std::optional<FaceProjection>
    passed(const SlavePoint &point, bool penetrates) const;

    /** @brief The face of passed(), for a point that is not known to be in a body; or null. */
    const Face *
    entry(const SlavePoint &point) const;

    /** @brief The point closest to a node that is reached from a face over its neighbours. */
    FaceProjection
    follow(const SlavePoint &point, const Face &from) const;

  private:
    const FaceTree &tree;
    const double    reach;

    /** Whether the node may meet the face on its path, both moving. */
    bool
    may_cross(const SlavePoint &point, const Face &face) const;
  };
} // namespace Touchstone

#endif

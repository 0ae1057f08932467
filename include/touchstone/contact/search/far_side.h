// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_search_far_side_h
#define touchstone_contact_search_far_side_h

#include <touchstone/contact/search/face_tree.h>

#include <optional>

namespace Touchstone
{
  /** @brief The point of a face that was closest to @p start when the step began, and the normal of
   * the face there. */
  FacePoint
  foot_at_start(const dealii::Point<dim> &start, const Face &face, const AnalyticSurface *exact);

  /** @brief Whether a face is deeper behind a slave point than bodies in balance fit within, as all
   * on_far_side() are. False if steps are not committed. @param depth Length. */
  bool
  is_deep(const FaceTree &tree, const Face &face, double depth);

  /**
   * @brief Whether a face that is behind a slave point is on the far side of a thin body, which
   * the point has neither entered nor overlaps (doc/theory.md 4, "Far sides").
   *
   * When the step began the point was as deep behind the face, and in front of those faces that
   * were closest to it, whatever their normals; and these look away from the face, or the slave
   * surface looks away from them. What was far outside of the body, beside an edge, need be in
   * front of none: these may look anywhere. The middle of an area that lay close to them covers but
   * a strip.
   *
   * @param start          Of the point, when the step began; of an area its middle.
   * @param slave_normal   Unit outward normal of the slave surface there.
   * @param depth          Behind the face at present, length.
   * @param depth_at_start The same when the step began, where it is not that of the point. */
  bool
  on_far_side(const FaceTree               &tree,
              const dealii::Point<dim>     &start,
              const dealii::Tensor<1, dim> &slave_normal,
              const Face                   &face,
              double                        depth,
              std::optional<double>         depth_at_start = {});

  /** @brief Whether a point was far from a face when the step began, and outside of the body: then
   * it is in no inner edge of that face, whatever plane it is behind. False if steps are not
   * committed. */
  bool
  was_outside(const FaceTree &tree, const dealii::Point<dim> &start, const Face &face);
} // namespace Touchstone

#endif

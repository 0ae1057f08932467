// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_exact_surface_h
#define touchstone_mesh_exact_surface_h

#include <touchstone/mesh/analytic_surface.h>

#include <deal.II/grid/manifold.h>

#include <map>
#include <memory>
#include <string>

namespace Touchstone
{
  /** @brief The exact shape of a boundary of an imported mesh. */
  struct ExactSurface
  {
    /** For contact. */
    std::shared_ptr<const AnalyticSurface> surface;
    /** For refinement and quadratic mappings. */
    std::shared_ptr<dealii::Manifold<3>> manifold;
  };

  /** @brief How exact surfaces are described, for the parameter's help text. */
  extern const char *const exact_surface_documentation;

  /**
   * @brief Read descriptions like "bore: cylinder axis z radius 1 inside; tip:
   * sphere point 0 0 1 radius 2".
   * @return Surfaces by the name before the colon.
   * @throws std::runtime_error with a sentence that says what is wrong.
   */
  std::map<std::string, ExactSurface>
  parse_exact_surfaces(const std::string &text);
} // namespace Touchstone

#endif

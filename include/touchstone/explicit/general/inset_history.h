// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_general_inset_history_h
#define touchstone_explicit_general_inset_history_h

#include <touchstone/explicit/general/impact_surface.h>

#include <cstdint>
#include <vector>

namespace Touchstone
{
  /**
   * @brief How the nodes of surfaces are moved inwards for the check of crossings, at the start of
   * the present cycle and of the one before (doc/general_contact.md, section 3).
   *
   * The surfaces of the check go on from where the cycle before has left them, with its normals, so
   * that nothing passes through them as normals turn from one cycle to the next. An interval knows
   * of the cycle before it what a checkpoint knows: where it began.
   */
  class InsetHistory
  {
  public:
    /** @param surface, nodes Must live as long. */
    InsetHistory(const ImpactSurface &surface, const NodeMap &nodes);

    /** @brief Nothing is known of the cycle before the next one. */
    void
    forget()
    {
      begun = false;
    }

    /** @brief A cycle begins at the displacement @p u; one that is halved, where it has begun.
     * Collective. @param v_before,step_before Velocities and length of the cycle before; length 0:
     * there was none. */
    void
    begin_cycle(const NodeField &u, const NodeField &v_before, double step_before);

    /** @brief Where the present cycle began; null before the first one of an interval. */
    const NodeField *
    start() const
    {
      return begun ? &begun_at : nullptr;
    }

    /** @brief Of a node at the start of the present cycle and of the one before. */
    struct Insets
    {
      ImpactSurface::Inset now, before;
    };
    /** @brief Those of an owned node of the surface. @param node Its local number. */
    const Insets &
    at(unsigned int node);

  private:
    const ImpactSurface &surface;
    const NodeMap       &nodes;
    /** Displacements at the start of this cycle and of the one before; none in an interval that has
     * not #begun. */
    NodeField begun_at, begun_before;
    bool      begun = false;
    /** By local node, and the number of the cycle that they are of. */
    std::vector<Insets>        insets;
    std::vector<std::uint64_t> insets_of;
    ImpactSurface::FaceAreas   face_areas;
    std::uint64_t              present = 2;
  };
} // namespace Touchstone

#endif

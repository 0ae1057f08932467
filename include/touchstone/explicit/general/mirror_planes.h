// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_general_mirror_planes_h
#define touchstone_explicit_general_mirror_planes_h

#include <touchstone/explicit/general/impact_surface.h>

#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Planes of symmetry of bodies that may touch themselves: what passes through such a plane
   * passes through its own mirror image, which general contact does not know
   * (doc/general_contact.md, section 6.1).
   *
   * 'Symmetry' can also mean rollers, beyond the end of which a body may go on. So only planes
   * count that have the whole surface of their body on one side as it is placed, and it is for
   * somebody else to judge what has passed.
   */
  class MirrorPlanes
  {
  public:
    /** Collective. @param surface, nodes Must live as long. */
    MirrorPlanes(const ImpactSurfaceInput &input,
                 const Solid              &solid,
                 const ImpactSurface      &surface,
                 const NodeMap            &nodes);

    /** @brief What has passed through the plane of its body with the displacement @p u, by more
     * than @p part of the size of its faces: how many nodes, of which body, the farthest by how
     * much, and where; empty if none. Collective. @param bodies Names. */
    std::string
    passed(const NodeField &u, double part, const std::vector<std::string> &bodies) const;

  private:
    struct Plane
    {
      unsigned int           body;
      dealii::Point<dim>     point;
      dealii::Tensor<1, dim> outward;
    };
    const ImpactSurface &surface;
    const NodeMap       &nodes;
    std::vector<Plane>   planes;

    /** @brief The plane of faces, or nothing if they are not in one plane that has the surface of
     * the body on one side. Collective. @param faces Of this rank. */
    void
    add(unsigned int body, const std::vector<Plane> &faces);
  };
} // namespace Touchstone

#endif

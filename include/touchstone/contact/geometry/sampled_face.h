// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_sampled_face_h
#define touchstone_contact_geometry_sampled_face_h

#include <touchstone/contact/geometry/measured_face.h>

#include <vector>

namespace Touchstone
{
  /** @brief A face with the points of it that are looked for in other faces. */
  class SampledFace : public MeasuredFace
  {
  public:
    struct Sample
    {
      Xi                     xi;
      dealii::Point<dim>     x;
      dealii::Tensor<1, dim> normal;
    };

    /** @param exact The exact surface, or null. */
    SampledFace(const Face &face, const AnalyticSurface *exact);

    /** @brief At MeasuredFace::samples in both directions, corners and edges among them. */
    const std::vector<Sample> &
    points() const
    {
      return sampled;
    }

    /** @brief Whether it is plain that a point lies above or below other faces, if it is no deeper
     * than @p most: a closest-point projection need not be made. */
    bool
    beside(const dealii::Point<dim> &x, double most) const;

  private:
    std::vector<Sample> sampled;
    /** Distance of the samples from the line through the centre along the normal there, and the
     * sine of the largest angle between their normals and that; the largest. */
    double radius = 0., tilt = 0.;
  };
} // namespace Touchstone

#endif

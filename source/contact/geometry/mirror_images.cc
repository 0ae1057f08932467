// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/mirror_images.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Planes between which a body is a sixteenth of the whole or more have that many images. */
    constexpr std::size_t most_images = 48;
    /** Of normals of planes and of products of reflections, which have no unit. */
    constexpr double same_plane = 1e-3, same_image = 1e-3;
    /** By the area of the faces: what is left of the sum of all images. */
    constexpr double nothing = 1e-6;

    const Tensor<2, dim> identity = Tensor<2, dim>(unit_symmetric_tensor<dim>());

    /** The products of reflections at planes, the identity first, as long as they are not too
     * many. */
    std::vector<Tensor<2, dim>>
    products(const std::vector<Tensor<1, dim>> &planes)
    {
      std::vector<Tensor<2, dim>> result{identity};
      for (std::size_t k = 0; k < result.size() && result.size() <= most_images; ++k)
        for (const Tensor<1, dim> &plane : planes)
          {
            const Tensor<2, dim> image = (identity - 2. * outer_product(plane, plane)) * result[k];
            if (std::none_of(result.begin(), result.end(), [&](const Tensor<2, dim> &other) {
                  return (image - other).norm() < same_image;
                }))
              result.push_back(image);
          }
      return result;
    }

    std::vector<Tensor<1, dim>>
    orthogonal(const std::vector<Tensor<1, dim>> &planes)
    {
      std::vector<Tensor<1, dim>> result;
      for (Tensor<1, dim> plane : planes)
        {
          for (const Tensor<1, dim> &other : result)
            plane -= (plane * other) * other;
          if (const double length = plane.norm(); length > same_plane)
            result.push_back(plane / length);
        }
      return result;
    }
  } // namespace



  MirrorImages::MirrorImages(const std::vector<Tensor<1, dim>> &planes)
  {
    std::vector<Tensor<2, dim>> all = products(planes);
    // Planes at any angle, as of a sector of 7 degrees of a body of revolution: their mean over
    // all images is that over those of orthogonal planes.
    if (all.size() > most_images)
      all = products(orthogonal(planes));
    reflections.assign(all.begin() + 1, all.end());
  }



  bool
  MirrorImages::smooth(const Tensor<1, dim> &one, const Tensor<1, dim> &other) const
  {
    return one * other > Tolerances::sharp_edge_cosine &&
           std::all_of(reflections.begin(), reflections.end(), [&](const Tensor<2, dim> &image) {
             return one * (image * other) > Tolerances::sharp_edge_cosine;
           });
  }



  Tensor<2, dim>
  MirrorImages::averaged_with(const NormalsAtNode &other, const NormalsAtNode &own) const
  {
    const auto meets_smoothly = [&](const Tensor<2, dim> &image) {
      return own.present * (image * other.present) > Tolerances::sharp_edge_cosine ||
             own.turned * (image * other.turned) > Tolerances::sharp_edge_cosine;
    };
    Tensor<2, dim> result;
    if (meets_smoothly(identity))
      result = identity;
    for (const Tensor<2, dim> &image : reflections)
      if (meets_smoothly(image))
        result += image;
    return result;
  }



  Tensor<2, dim>
  MirrorImages::all(const Tensor<1, dim> &sum) const
  {
    Tensor<2, dim> result = identity;
    for (const Tensor<2, dim> &image : reflections)
      result += image;
    return (result * sum).norm() > nothing * sum.norm() ? result : identity;
  }
} // namespace Touchstone

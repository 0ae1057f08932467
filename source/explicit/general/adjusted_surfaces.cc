// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/general/adjusted_surfaces.h>

#include <algorithm>
#include <utility>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** What is not open after so many motions is refused at the start of the run. */
    constexpr unsigned int most_motions = 300;

    /** Without the parts along normals, which need not be orthogonal. */
    Tensor<1, dim>
    within_planes(Tensor<1, dim> motion, std::vector<Tensor<1, dim>> normals)
    {
      for (std::size_t i = 0; i < normals.size(); ++i)
        {
          if (normals[i].norm() < 1e-6)
            continue; // the plane of another face
          normals[i] /= normals[i].norm();
          motion -= (motion * normals[i]) * normals[i];
          for (std::size_t k = i + 1; k < normals.size(); ++k)
            normals[k] -= (normals[k] * normals[i]) * normals[i];
        }
      return motion;
    }
  } // namespace



  AdjustedSurfaces::AdjustedSurfaces(GeneralContact &contact,
                                     const NodeMap  &nodes,
                                     const Planes   &planes)
  {
    NodeField u(nodes.n_local());
    for (unsigned int k = 0; k < most_motions; ++k)
      {
        const auto overlaps = contact.overlaps(u);
        if (overlaps.empty())
          break;
        move(overlaps, planes);
        for (const auto &[dof, motion] : by_dof)
          if (const unsigned int node = nodes.local(dof); node != numbers::invalid_unsigned_int)
            u[node] = motion;
      }
  }



  void
  AdjustedSurfaces::move(const std::vector<GeneralContact::Overlap> &overlaps, const Planes &planes)
  {
    std::map<Index, std::pair<Tensor<1, dim>, unsigned int>> sums;
    for (const GeneralContact::Overlap &overlap : overlaps)
      {
        double square = 0.;
        for (unsigned int i = 0; i < overlap.n; ++i)
          square += overlap.weights[i] * overlap.weights[i];
        for (unsigned int i = 0; i < overlap.n; ++i)
          {
            auto &[sum, count] = sums[overlap.dofs[i]];
            sum += overlap.weights[i] * overlap.depth / square * overlap.normal;
            ++count;
          }
      }
    for (const auto &[dof, of] : sums)
      {
        std::vector<Tensor<1, dim>> normals;
        for (auto [plane, end] = planes.equal_range(dof); plane != end; ++plane)
          normals.push_back(plane->second);
        by_dof[dof] += within_planes(of.first / double(of.second), normals);
      }
  }



  double
  AdjustedSurfaces::largest() const
  {
    double result = 0.;
    for (const auto &[dof, motion] : by_dof)
      result = std::max(result, motion.norm());
    return result;
  }
} // namespace Touchstone

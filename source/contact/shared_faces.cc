// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/nodal_value.h>
#include <touchstone/contact/pairing/cover_of_nodes.h>
#include <touchstone/contact/pairing/smooth_step.h>
#include <touchstone/contact/shared_faces.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

// Where a slave face lies over the joint of two masters, neither pair covers all of it, and yet
// there is no edge of the contact (doc/theory.md 3.1, "Faces that several pairs cover"). Pairs know
// their own cover only; here it is added up.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The part of a whole that a vector area is, no unit. */
    double
    part_of(const Tensor<1, dim> &area, const Tensor<1, dim> &whole)
    {
      return area * whole / whole.norm_square();
    }

    /** Whether the pair covers a part of a node, neither nothing nor all. */
    bool
    is_partial(const CoverOfNodes &cover, const Index node, const Tensor<1, dim> &whole)
    {
      const auto found = cover.own.find(node);
      return found != cover.own.end() && part_of(found->second, whole) < Tolerances::nearly_covered;
    }

    bool
    any_partial(const CoverOfNodes *const cover)
    {
      return cover &&
             std::any_of(cover->whole.begin(), cover->whole.end(), [cover](const auto &entry) {
               return is_partial(*cover, entry.first, entry.second);
             });
    }

    /** What a pair covers, at the nodes of all ranks. Collective. */
    Vector
    covered(const CoverOfNodes *const cover, const Solid &solid)
    {
      Vector result(solid.zero_vector());
      if (cover)
        for (const auto &[node, area] : cover->covered)
          for (unsigned int d = 0; d < dim; ++d)
            result(dim * node + d) += area[d];
      result.compress(VectorOperation::add);
      solid.condense(result); // master nodes can hang
      return result;
    }
  } // namespace



  std::vector<Vector>
  cover_by_other_pairs(const std::vector<std::unique_ptr<ContactPair>> &pairs, const Solid &solid)
  {
    std::vector<Vector> result;
    const auto knows_cover = [](const auto &pair) { return pair->pairing().cover() != nullptr; };
    // The same on all ranks.
    if (std::count_if(pairs.begin(), pairs.end(), knows_cover) < 2)
      return result;
    // The common case: pairs that cover all of their slave nodes, or have none in common.
    const bool any = std::any_of(pairs.begin(), pairs.end(), [](const auto &pair) {
      return any_partial(pair->pairing().cover());
    });
    if (Utilities::MPI::max(static_cast<int>(any), solid.communicator) == 0)
      return result;
    std::vector<Vector> of_pairs;
    Vector              sum(solid.zero_vector());
    for (const auto &pair : pairs)
      sum += of_pairs.emplace_back(covered(pair->pairing().cover(), solid));
    int found = 0;
    for (std::size_t p = 0; p < pairs.size(); ++p)
      {
        Vector &field = result.emplace_back(solid.zero_vector());
        if (const CoverOfNodes *const cover = pairs[p]->pairing().cover())
          for (const auto &[node, whole] : cover->whole)
            if (is_partial(*cover, node, whole))
              {
                const double all    = part_of(nodal_value(sum, node), whole),
                             others = all - part_of(nodal_value(of_pairs[p], node), whole);
                const double part =
                  smooth_step(all, Tolerances::shared_from, Tolerances::shared_to) *
                  smooth_step(others, 0., 1. - Tolerances::shared_to);
                found |= (part > 0.);
                field(dim * node) = part;
              }
        if (const CoverOfNodes *const cover = pairs[p]->pairing().cover())
          for (const Index node : cover->keep_rows)
            {
              found                 = 1;
              field(dim * node + 1) = 1.;
            }
        field.compress(VectorOperation::insert);
      }
    if (Utilities::MPI::max(found, solid.communicator) == 0)
      result.clear();
    return result;
  }
} // namespace Touchstone

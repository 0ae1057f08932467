// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_general_general_results_h
#define touchstone_explicit_general_general_results_h

#include <touchstone/base/exact_sum.h>
#include <touchstone/contact/results.h>
#include <touchstone/explicit/general/impact_surface.h>

#include <map>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Results at the nodes of surfaces in general contact, for output: forces as means over an
   * output interval (doc/general_contact.md, section 4).
   *
   * Sums over the rows of a node are exact, so that they have the same bits whichever rank has the
   * rows.
   */
  class GeneralResults
  {
  public:
    /** @param owned Dofs of this rank. @param surface, nodes Must live as long. */
    GeneralResults(const ImpactSurface    &surface,
                   const NodeMap          &nodes,
                   const dealii::IndexSet &owned);

    /** @brief What came of a row in some cycles: impulses on its nodes, in their order, force times
     * time; the gap at the start of the last cycle with an impulse, length. */
    struct RowTotal
    {
      std::array<dealii::Tensor<1, dim>, 8> impulses;
      double                                gap     = 0.;
      bool                                  pressed = false, slides = false;
    };

    /** @brief Sum up from here. */
    void
    begin_interval();

    /** @brief Add a row. @param dofs First dofs of its nodes; other entries do not count. */
    void
    add(const std::array<Index, 8> &dofs, unsigned int n, const RowTotal &total);

    /** @brief Take the sums to the owners of the nodes. Collective. @param length Of the interval,
     * time. */
    void
    end_interval(double length);

    /** @brief At the nodes of this rank, with the displacement @p u. @param pair Their number of a
     * pair. */
    std::vector<ContactPoint>
    points(const NodeField &u, unsigned int pair) const;

    /** @brief Faces of this rank. */
    std::vector<ContactFace>
    faces(unsigned int pair) const;

  private:
    struct NodeTotal
    {
      Index                     dof;
      std::array<ExactSum, dim> impulse;
      double                    gap;
      bool                      slides;

      void
      add(const NodeTotal &other);
    };
    struct NodeResult
    {
      dealii::Tensor<1, dim> force;
      double                 gap;
      bool                   slides;
    };

    const ImpactSurface       &surface;
    const NodeMap             &nodes;
    const dealii::IndexSet     owned;
    std::map<Index, NodeTotal> totals;
    /** By local node: the interval that has ended last. */
    std::map<unsigned int, NodeResult> results;
  };
} // namespace Touchstone

#endif

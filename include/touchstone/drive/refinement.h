// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_refinement_h
#define touchstone_drive_refinement_h

#include <touchstone/base/formula.h>
#include <touchstone/contact/results.h>
#include <touchstone/drive/refinement_parameters.h>
#include <touchstone/drive/step.h>
#include <touchstone/mesh/forest.h>

#include <deal.II/lac/vector.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Decides where the mesh becomes finer or coarser, changes it, and carries
   * nodal fields over.
   *
   * Refined are the cells with the largest estimated errors (bulk criterion, Doerfler
   * (1996), SIAM J. Numer. Anal. 33), and by the same rule the slave faces over which
   * the contact pressure varies most, which are those at the edge of the contact; with
   * them the master faces that they meet, if these are not smaller already.
   */
  class Refinement
  {
  public:
    Refinement(const RefinementParameters &parameters, Forest &forest, Solid &solid);

    /**
     * @brief Estimate the errors of the present state of @p problem.
     * @return that of the stress, relative in the energy norm, or the largest of a contact force
     * (ForceEstimate); no unit; NaN if there is no estimate. Collective.
     */
    double
    estimate(Step &problem);

    /** @brief Of the last estimate(): the relative errors of the contact forces by pairs; empty if
     * it was not about these. */
    const std::vector<double> &
    force_errors() const
    {
      return forces;
    }

    /** @brief Of the last estimate(): why pairs whose force it was about have none, by numbers of
     * pairs. */
    const std::map<unsigned int, std::string> &
    missing() const
    {
      return without;
    }

    /** @brief Whether the last mark() refined no cell because "Maximum cells" would be exceeded;
     * the same on all ranks. */
    bool
    limited() const
    {
      return no_more_cells;
    }

    /**
     * @brief Mark cells by what estimate() found in the same state.
     * @return whether the mesh is going to change. Collective.
     */
    bool
    mark(const Step &problem, double time);

    /**
     * @brief Change the mesh as marked, distribute it over the ranks, and reinitialise the solid:
     * objects that refer to its dofs are invalid afterwards.
     * @param fields Over the dofs before. @return The same fields over the dofs after. Collective.
     */
    std::vector<Vector>
    execute(const std::vector<Vector> &fields);

  private:
    using Values = dealii::Vector<double>;

    const RefinementParameters    &parameters;
    Forest                        &forest;
    Solid                         &solid;
    Formulas                       formulas;
    bool                           no_more_cells = false;
    std::shared_ptr<const Formula> region;
    /** Of the last estimate(), by cells: squared error, and the squared variation of
     * the pressure over their slave faces. */
    Values              errors, variation;
    std::vector<double> forces;
    /** Why pairs have no estimate. */
    std::map<unsigned int, std::string> without;

    /** Change the mesh, and take fields along. */
    std::vector<Vector>
    carry_over(const std::vector<Vector> &fields, const std::function<void()> &change);
    /** @param fields Of Contact::fields(). */
    Values
    pressure_variation(const std::vector<Vector>         &fields,
                       const std::vector<PairBoundaries> &pairs) const;
    int
    finest_level() const;
    /** Of the slave faces of a pair whose rows refer to a master node, as they will be: the
     * sum of (length / size)^sharpness, on the first component of the node. */
    Vector
    faces_at_masters(const Step           &problem,
                     unsigned int          pair,
                     const PairBoundaries &boundaries,
                     double                length,
                     bool                  refined_only) const;
    /** Mark the master faces that would be coarser than the refined slave faces that they
     * meet, and keep those that would become so. @return whether any. Collective. */
    bool
    follow_slaves(const Step &problem);
    /** Learn the marks of ghost cells. @return whether any is new. Collective. */
    bool
    share_marks();
    /** Complete the marks so that neighbours stay alike, those of other ranks as well: else
     * less would be joined where ranks meet. Collective. */
    void
    settle_marks();
    /** The value down to which the largest @p values make up a share of their sum. */
    double
    bulk_threshold(const Values &values, double fraction) const;
  };
} // namespace Touchstone

#endif

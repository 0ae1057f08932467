// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_force_estimate_h
#define touchstone_drive_force_estimate_h

#include <touchstone/drive/step.h>

#include <deal.II/lac/vector.h>

#include <map>
#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Estimate of the errors that the mesh makes in the contact forces, by dual weighted
   * residuals.
   *
   * The force F on the slave body along its direction e differs from the exact one by -a(e_u, e_z),
   * where z is the response to a unit motion of the supports on one side of the pair (MovedSide)
   * along e with contact as it is, and the errors of both are estimated by recovered stress
   * (doc/theory.md 11). Becker and Rannacher (2001), Acta Numerica 10. A force that loads alone
   * determine has no such error.
   */
  class ForceEstimate
  {
  public:
    /** @brief Solves one linear system for each pair that is in contact. Collective. */
    explicit ForceEstimate(Step &problem);

    /** @brief Computed less exact force over the computed one, by pairs; no unit. NaN without
     * a force, and where there is no estimate. */
    std::vector<double> relative;

    /** @brief By numbers of pairs that have a force but no estimate, why there is none. */
    std::map<unsigned int, std::string> missing;

    /** @brief Contributions of the cells, without sign and over all pairs; no unit. */
    dealii::Vector<double> cells;

    /** @brief The largest of all pairs in magnitude; NaN if one is missing, or none has a force. */
    double
    largest() const;
  };
} // namespace Touchstone

#endif

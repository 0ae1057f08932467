// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact_residuals.h>
#include <touchstone/contact/results.h>
#include <touchstone/drive/force_estimate.h>
#include <touchstone/drive/moved_side.h>
#include <touchstone/solid/error_estimator.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace Touchstone
{
  using namespace dealii;

  ForceEstimate::ForceEstimate(Step &problem)
  {
    const StepState   state = problem.state();
    const Solid      &solid = state.solid;
    const Vector      u     = state.ghosted_displacement();
    const auto        pairs = pair_results(state.contact, u);
    const auto        sides = pair_boundaries(state.contact);
    const std::size_t size  = solid.dof_handler.get_triangulation().n_active_cells();
    cells.reinit(size);
    relative.assign(pairs.size(), std::nan(""));
    std::vector<bool> touching;
    for (const PairResult &pair : pairs)
      touching.push_back(pair.active > 0);
    StressRecovery                 recovery(solid);
    std::optional<RecoveredStress> of_u;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      {
        const double force = pairs[p].force.norm();
        if (!touching[p] || force == 0.)
          continue;
        const auto side = moved_side(sides, touching, p, solid.bodies.size());
        if (!side)
          {
            missing[p] = "other contact holds both of its sides, so that no motion of supports "
                         "changes its force alone";
            continue;
          }
        const auto direction = (side->of_slave ? 1. : -1.) * pairs[p].force / force;
        const auto response  = problem.support_response(side->bodies, direction);
        if (!response)
          {
            missing[p] = "there is one in static runs of linear bodies only, without forces that "
                         "draw bolts which are not locked yet";
            continue;
          }
        Vector z(*response);
        solid.hanging.distribute(z);
        if (!of_u)
          of_u.emplace(recovery, u);
        const dealii::Vector<double> errors =
          form_errors(solid, recovery, *of_u, RecoveredStress(recovery, solid.ghosted(z)));
        double sum = 0.;
        for (const double error : errors)
          sum -= error;
        sum = Utilities::MPI::sum(sum, solid.communicator) -
              contact_residuals(state.contact, state.displacement, z);
        if (!std::isfinite(sum))
          {
            missing[p] = "it is no finite number";
            continue;
          }
        relative[p] = sum / force;
        for (std::size_t k = 0; k < size; ++k)
          cells(k) += std::abs(errors(k)) / force;
      }
  }



  double
  ForceEstimate::largest() const
  {
    double result = std::nan("");
    for (const double error : relative)
      if (!std::isnan(error))
        result = std::isnan(result) ? std::abs(error) : std::max(result, std::abs(error));
    return missing.empty() ? result : std::nan("");
  }
} // namespace Touchstone

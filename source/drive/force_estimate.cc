// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact_residuals.h>
#include <touchstone/contact/results.h>
#include <touchstone/drive/force_estimate.h>
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
    StressRecovery                 recovery(solid);
    std::optional<RecoveredStress> of_u;
    for (std::size_t p = 0; p < pairs.size(); ++p)
      {
        relative.push_back(std::nan(""));
        const double force = pairs[p].force.norm();
        if (pairs[p].active == 0 || force == 0. || state.time_integration.dynamic())
          continue;
        const auto response = problem.support_response(sides[p].slave_body, pairs[p].force / force);
        if (!response)
          continue;
        Vector z(*response);
        solid.hanging.distribute(z);
        if (!of_u)
          of_u.emplace(recovery, u);
        const dealii::Vector<double> errors =
          form_errors(solid, recovery, *of_u, RecoveredStress(recovery, solid.ghosted(z)));
        double sum = 0.;
        for (std::size_t k = 0; k < size; ++k)
          {
            sum -= errors(k);
            cells(k) += std::abs(errors(k)) / force;
          }
        sum = Utilities::MPI::sum(sum, solid.communicator) -
              contact_residuals(state.contact, state.displacement, z);
        relative[p] = sum / force;
      }
  }



  double
  ForceEstimate::largest() const
  {
    double result = 0.;
    for (const double error : relative)
      if (!std::isnan(error))
        result = std::max(result, std::abs(error));
    return result;
  }
} // namespace Touchstone

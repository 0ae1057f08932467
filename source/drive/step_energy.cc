// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/non_convergence.h>
#include <touchstone/drive/step_problem.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

// Whether the loads can have supplied the energy of a static step. Newton's method that has strayed
// may come upon a balance that no path of loading leads to, as an arch that has folded into itself:
// nothing is out of balance there, and nothing but its energy tells.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Whether a pair does work on bodies that the forces at the end of a step do not tell of: by
     * an obstacle that moves, as forces move tools, too, or by pretension. */
    bool
    does_work(const Contact &contact, const ContactPair &pair)
    {
      return pair.parameters().has_pretension() ||
             std::any_of(pair.rows().begin(), pair.rows().end(), [&](const ContactRow &row) {
               return row.has_partner &&
                      row.motion.since(contact.committed(row).motion, row.position).norm() > 0.;
             });
    }
  } // namespace



  bool
  StepProblem::loads_alone_act() const
  {
    int other = new_mesh;
    for (const BodyParameters &body : scene.bodies)
      other |= body.material.thermal();
    for (const auto &prescribed : boundary_conditions.displacements(time))
      other |= prescribed.value != 0.;
    for (unsigned int p = 0; p < contact.n_pairs() && !other; ++p)
      other |= does_work(contact, contact.pair(p));
    return Utilities::MPI::max(other, solid.communicator) == 0;
  }



  void
  StepProblem::check_strain_energy(const Energies &end) const
  {
    // Dead loads supply f (u - u_0), and loads that grow less. By so many times more, which covers
    // loads that turn and bodies that swing out and back, and where energy has doubled in the step:
    // rows that exchange what they touch may bring in a little.
    constexpr double impossible = 10., noticed = 0.5;
    const Energies  &before = integration->committed_energies();
    const double     stored = end.strain + end.plastic,
                 gained     = stored - before.strain - before.plastic;
    if (gained <= noticed * stored || !loads_alone_act())
      return;
    double supplied = 0.;
    for (const Index i : solid.owned)
      supplied += std::abs(external(i) * (u(i) - committed_u(i)));
    supplied = Utilities::MPI::sum(supplied, solid.communicator) +
               std::abs(contact.work_of_overlaps(1., committed_time));
    if (gained <= impossible * supplied)
      return;
    char text[240];
    std::snprintf(
      text,
      sizeof(text),
      "energy that no load explains: the bodies have stored %.3g in this step, in which "
      "the loads have done work of %.3g at most, so that this is a balance to which no "
      "loading leads",
      gained,
      supplied);
    throw EnergyGain(text);
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/step_problem.h>
#include <touchstone/mesh/obstacle_shape.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <set>
#include <vector>

/**
 * @file
 * Parts of StepProblem that say what may have kept a step from converging: what is known of the
 * contact where Newton's method has ended. All of them are collective and their answers do not
 * depend on the partition.
 */

namespace Touchstone
{
  using namespace dealii;

  std::string
  StepProblem::pairs_without_partner() const
  {
    std::vector<unsigned int> found(contact.n_pairs(), 0);
    for (const ContactRow &row : contact.rows())
      found[row.pair] += row.has_partner;
    Utilities::MPI::sum(found, solid.communicator, found);
    std::string text;
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      if (found[p] == 0)
        text += "; no master face within reach of any slave node of contact pair '" +
                scene.pairs[p].name +
                "' (see its 'Slave boundaries', 'Master boundaries' and 'Search distance')";
    return text;
  }



  std::string
  StepProblem::far_from_origin() const
  {
    // Gaps and slips are differences of positions.
    constexpr double noticed = 1e-2;
    double           most    = 0.;
    for (const ContactRow &row : contact.rows())
      if (contact.state(row).active())
        most = std::max(most, row.position.norm() / row.size);
    most                 = Utilities::MPI::max(most, solid.communicator);
    const double unknown = std::numeric_limits<double>::epsilon() * most;
    if (unknown < noticed * scene.newton.gap_tolerance)
      return "";
    char text[160];
    std::snprintf(
      text,
      sizeof(text),
      "; contact lies %.1g times the size of its faces from the origin, so that gaps are "
      "known to %.1g of these only: move the bodies to the origin",
      most,
      unknown);
    return text;
  }



  std::string
  StepProblem::inner_corners() const
  {
    std::vector<unsigned int> active(contact.n_pairs(), 0);
    for (const ContactRow &row : contact.rows())
      active[row.pair] += contact.state(row).active();
    Utilities::MPI::sum(active, solid.communicator, active);
    std::set<std::string> found;
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      if (const ObstacleParameters *const obstacle = contact.pair(p).obstacle();
          obstacle != nullptr && active[p] > 0 && obstacle->shape.make()->has_inner_edges())
        found.insert(obstacle->name);
    std::string text;
    for (const std::string &name : found)
      text += "; obstacle '" + name +
              "' has sharp edges that look inwards, and a node in such a corner meets one of its "
              "walls only: set its 'Walls' to 'separate'";
    return text;
  }



  std::string
  StepProblem::friction_without_pressure() const
  {
    // A row that opens as it is dragged by its friction, and closes as soon as that ceases, has no
    // solution unless the friction vanishes with the pressure.
    int found = 0;
    for (const auto &changed : changed_rows)
      for (const ContactRow &row : contact.rows())
        if (row.friction && row.pair == changed[dim] && row.friction->cone(0., false).force > 0.)
          found = 1;
    if (Utilities::MPI::max(found, solid.communicator) == 0)
      return "";
    return "; friction that does not vanish with the pressure may leave a row no solution: it opens "
           "with its friction and closes without ('Friction/Largest coefficient' of 'tresca' bounds it "
           "by the pressure)";
  }



  std::string
  StepProblem::stick_of_held_nodes() const
  {
    // Springs make the master follow (doc/theory.md 6, "Stick where the slave node is not free"), a
    // hundredth of the slip being left by each iteration unless it has fewer nodes than the slave.
    std::vector<int> found(contact.n_pairs(), 0);
    for (const ContactRow &row : contact.rows())
      if (row.friction && contact.state(row).status == ContactStatus::stick)
        for (const Tensor<1, dim> &tangent : contact.state(row).friction->unconstrained)
          if (std::abs(row.friction->kinematics.slip * tangent) >
              scene.newton.gap_tolerance * row.size)
            found[row.pair] = 1;
    // The same of tied nodes, whose conditions contradict each other then.
    std::map<Index, std::vector<Tensor<1, dim>>> prescribed;
    for (const auto &one : boundary_conditions.displacements(time))
      prescribed[one.node].push_back(one.direction);
    for (const ContactRow &row : contact.rows())
      if (const auto held = prescribed.find(row.slave); row.tied && contact.state(row).active() &&
                                                        !contact.state(row).dropped() &&
                                                        held != prescribed.end())
        for (const Tensor<1, dim> &direction : held->second)
          if (std::abs(row.gap_vector * direction) > scene.newton.gap_tolerance * row.size)
            found[row.pair] = 1;
    Utilities::MPI::max(found, solid.communicator, found);
    std::string names;
    for (unsigned int p = 0; p < found.size(); ++p)
      if (found[p] == 1)
        names += (names.empty() ? "'" : ", '") + contact.pair(p).parameters().name + "'";
    return names.empty() ? names
                         : "; supports hold slave nodes of " + names +
                             " that stick or are tied, and the master may have too few nodes to "
                             "follow all of them: exchange slave and master, or refine the master "
                             "surface";
  }
} // namespace Touchstone

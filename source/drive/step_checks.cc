// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/first_of_ranks.h>
#include <touchstone/base/non_convergence.h>
#include <touchstone/contact/contact_checks.h>
#include <touchstone/contact/narrow_contact.h>
#include <touchstone/contact/passed_obstacle.h>
#include <touchstone/contact/pulling_obstacle.h>
#include <touchstone/drive/step_problem.h>
#include <touchstone/solid/bodies.h>

#include <deal.II/base/mpi.h>
#include <deal.II/numerics/vector_tools_interpolate.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

/**
 * @file
 * Parts of StepProblem that judge a state which Newton's method has found or failed to find:
 * whether it can be a solution at all (excessive increments, bodies thrown off, contact that rows
 * cannot describe), and at which position of the model it is farthest from one. All of them are
 * collective and their answers do not depend on the partition.
 */

namespace Touchstone
{
  using namespace dealii;

  std::string
  StepProblem::readable(const Point<dim> &x)
  {
    char text[80];
    std::snprintf(text, sizeof(text), "(%.4g, %.4g, %.4g)", x[0] + 0., x[1] + 0., x[2] + 0.);
    return text;
  }



  void
  StepProblem::check_increment() const
  {
    // An increment of 1e6 times the size of the model comes from a nearly singular system.
    // Positions that far away have lost six digits, and gaps computed from them are meaningless.
    // Prescribed displacements that are still to be met may be large, too.
    constexpr double far     = 1e6;
    const double     largest = solved_increment.linfty_norm();
    if (largest <= far * (diameter + missed))
      return;
    char text[160];
    std::snprintf(text,
                  sizeof(text),
                  "a Newton increment moves a node by %.3g, where all bodies together measure %.3g",
                  largest,
                  diameter);
    throw ExcessiveIncrement(text);
  }



  void
  StepProblem::check_contact() const
  {
    if (const std::string text = unresolved_contact(contact); !text.empty())
      throw UnresolvedContactFailure(text);
    if (const std::string text = pulling_obstacle(contact); !text.empty())
      throw PullingObstacle(text, time - committed_time);
    if (const std::string text = passed_obstacle(contact, committed_u); !text.empty())
      throw PassedObstacle(text, time - committed_time);
    // Where a body is that contact holds may be wrong long before the end of the run.
    if (!integration->dynamic() &&
        (!scene.refinement.active() || scene.refinement.cycles_per_step == 0))
      if (const std::string text = sunk_in(contact, system->unsupported_bodies()); !text.empty())
        throw UnresolvedContactFailure(text);
  }



  std::string
  StepProblem::place_of_first(const RowPlaces &rows, const std::string &how) const
  {
    // Of all such rows the one with the smallest position in lexicographic order is named: row
    // numbers depend on the partition, positions do not. RepeatedFailure compares this text between
    // attempts.
    std::vector<double> first;
    for (const auto &row : rows)
      if (first.empty() ||
          std::lexicographical_compare(row.begin(), row.end(), first.begin(), first.end()))
        first.assign(row.begin(), row.end());
    first = first_of_ranks(first, dim + 1, solid.communicator);
    if (first.empty())
      return "";
    const auto &pair = scene.pairs[static_cast<unsigned int>(first[dim])];
    return "rows of pair '" + pair.name + "' that " + how + ", one of them at " +
           readable({first[0], first[1], first[2]}) + " of body '" + pair.slave_body + "'";
  }



  namespace
  {
    /** The node with the largest force on it: position, number of its body and its own; none where
     * there are no forces. Collective. */
    std::vector<double>
    most_loaded_node(const Solid &solid, const Vector &forces)
    {
      Vector positions(solid.zero_vector());
      VectorTools::get_position_vector(solid.mapping, solid.dof_handler, positions);
      const std::vector<unsigned int> body = bodies_of_unknowns(solid);

      const auto force = [&forces](const std::size_t k) {
        double square = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          square += forces.begin()[dim * k + d] * forces.begin()[dim * k + d];
        return std::sqrt(square);
      };
      double largest = 0.;
      for (std::size_t k = 0; k < body.size() / dim; ++k)
        largest = std::max(largest, force(k));
      largest = Utilities::MPI::max(largest, solid.communicator);
      if (!(largest > 0.))
        return {};

      // Position, number of the body and of the node. Of forces that are equal, as those of nodes
      // on both sides of a plane of symmetry, round-off must not choose: the first by position.
      constexpr double    as_large = 0.99;
      std::vector<double> worst;
      for (std::size_t k = 0; k < body.size() / dim; ++k)
        if (force(k) >= as_large * largest)
          {
            const double             *x = positions.begin() + dim * k;
            const std::vector<double> node{x[0],
                                           x[1],
                                           x[2],
                                           static_cast<double>(body[dim * k]),
                                           static_cast<double>(
                                             solid.owned.nth_index_in_set(dim * k) / dim)};
            if (worst.empty() || node < worst)
              worst = node;
          }
      return first_of_ranks(worst, 5, solid.communicator);
    }
  } // namespace



  std::string
  StepProblem::worst_place() const
  {
    const std::string changing = place_of_first(changed_rows, "change"),
                      exchanging =
                        place_of_first(exchanged_rows, "touch now one thing and then another");
    if (!changing.empty() || !exchanging.empty())
      return changing + (changing.empty() || exchanging.empty() ? "" : ", and ") + exchanging;
    // In balance the worst node is that of the largest round-off.
    if (relative_residual <= scene.newton.residual_tolerance)
      return "";
    // What supports carry is not out of balance.
    Vector free(unbalanced);
    system->remove_supported(free);
    const std::vector<double> worst = most_loaded_node(solid, free);
    if (worst.empty())
      return "";

    // Pair of the node: a role as slave is more telling than that as a master node.
    const auto node     = static_cast<Index>(worst[4]);
    int        pairs[2] = {-1, -1};
    for (const ContactRow &row : contact.rows())
      if (row.slave == node && row.has_partner)
        pairs[0] = row.pair;
      else if (contact.state(row).active() &&
               std::any_of(row.stencil.begin(), row.stencil.end(), [&](const StencilEntry &e) {
                 return e.node == node;
               }))
        pairs[1] = row.pair;
    std::string text = "body '" + scene.bodies[static_cast<unsigned int>(worst[3])].name + "' at " +
                       readable({worst[0], worst[1], worst[2]});
    for (unsigned int role = 0; role < 2; ++role)
      if (const int p = Utilities::MPI::max(pairs[role], solid.communicator); p >= 0)
        return text + (role == 0 ? ", a slave node of pair '" : ", a master node of pair '") +
               scene.pairs[p].name + "'";
    return text;
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/nodal_value.h>
#include <touchstone/base/exchange.h>
#include <touchstone/contact/contact.h>
#include <touchstone/contact/contact_checks.h>
#include <touchstone/contact/geometry/surface_cone.h>
#include <touchstone/contact/pulling_obstacle.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/mpi.h>

#include <array>
#include <cstdio>

// Obstacles have no path: a row takes the nearest point of the surface, whatever side the obstacle
// has come from. Masters that slave nodes pass through are found by UnresolvedContact.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Round-off of the sine of a right angle. */
    constexpr double right_angle = 1e-6;

    /** A node with a force against all normals of the slave surface: its position, the last of the
     * four what its neighbours and it carry together. */
    using Pulled = std::array<double, dim + 1>;

    /** The largest of a pair, zero without one. Collective. */
    Pulled
    pulled_most(const Contact &contact, const ContactPair &pair)
    {
      const Solid &solid  = contact.solid_model();
      const Vector forces = normal_forces(contact, pair);
      double       sum    = 0.;
      for (const SurfaceNode &node : pair.slave().owned_nodes())
        sum += nodal_value(forces, node.node).norm();
      sum = Utilities::MPI::sum(sum, solid.communicator);
      std::vector<Pulled> found;
      for (const SurfaceNode &node : pair.slave().owned_nodes())
        {
          if (nodal_value(forces, node.node).norm() == 0.)
            continue;
          const SurfaceCone cone(pair.slave(), node.node);
          Tensor<1, dim>    around;
          for (const Index other : cone.nodes())
            around += nodal_value(forces, other);
          // No normal is within a right angle of the direction in which the surface presses.
          if (around.norm() >= Tolerances::small_force * sum && around.norm() > 0. &&
              cone.distance(-1. * around / around.norm()) > 1. - right_angle)
            {
              const Point<dim> x = pair.slave().position(node, contact.ghosted_displacement());
              found.push_back({{x[0], x[1], x[2], around.norm()}});
            }
        }
      // Of equal forces the one with the largest coordinates: the same on any partition.
      Pulled worst{};
      for (const Pulled &one : gather_all(found, solid.communicator))
        if (one[dim] > worst[dim] || (one[dim] == worst[dim] && one > worst))
          worst = one;
      return worst;
    }
  } // namespace



  std::string
  pulling_obstacle(const Contact &contact)
  {
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      {
        const ContactPair &pair = contact.pair(p);
        // Ties carry tension.
        if (pair.master() || pair.tied())
          continue;
        const Pulled worst = pulled_most(contact, pair);
        if (worst[dim] == 0.)
          continue;
        char text[80];
        std::snprintf(
          text, sizeof(text), "(%.3g, %.3g, %.3g)", worst[0] + 0., worst[1] + 0., worst[2] + 0.);
        return "contact pair '" + pair.parameters().name + "': the obstacle pulls at '" +
               pair.parameters().slave_body + "' at " + text +
               ", as it has come so far in, within one step or before the first, that the surface on "
               "its other side is the nearest one: make smaller steps, place it outside, or refine the "
               "slave surface if it is smaller than its faces";
      }
    return "";
  }
} // namespace Touchstone

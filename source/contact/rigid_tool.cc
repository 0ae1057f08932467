// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/rigid_tool.h>
#include <touchstone/mesh/rotation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>

// Obstacles that are moved by forces: their loads, where they are, and what acts on them. How they
// move is the matter of drive/rigid_tools.cc, and of explicit/tool_nodes.cc in explicit dynamics.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    constexpr double degrees = 180. / numbers::PI;
  } // namespace



  RigidTool::RigidTool(const ObstacleParameters &obstacle, const Contact &contact)
    : obstacle(&obstacle)
    , contact(&contact)
  {
    for (unsigned int c = 0; c < n_components; ++c)
      loads[c] = formulas.add(section(), FreeMotionParameters::load_key(c), obstacle.free.loads[c]);
    smallest_face = softest = std::numeric_limits<double>::max();
    double largest_face     = 0.;
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      if (contact.pair(p).obstacle() == &obstacle)
        {
          own_pairs.push_back(p);
          softest = std::min(softest, contact.pair(p).modulus());
          for (const ContactRow &row : contact.pair(p).rows())
            {
              smallest_face = std::min(smallest_face, row.size);
              largest_face  = std::max(largest_face, row.size);
              arm = std::max(arm, (row.reference - Point<dim>(free().reference_point)).norm());
            }
        }
    const MPI_Comm communicator = contact.communicator();
    smallest_face               = Utilities::MPI::min(smallest_face, communicator);
    arm                         = Utilities::MPI::max(std::max(arm, largest_face), communicator);
    present.load = committed.load = load(0.);
  }



  RigidTool::Components
  RigidTool::load(const double time) const
  {
    Components result{};
    for (unsigned int c = 0; c < n_components; ++c)
      if (loads[c])
        result[c] = loads[c]->value(Point<dim>(), time);
    formulas.check(MPI_COMM_SELF); // the time is the same on all ranks
    return result;
  }



  Point<dim>
  RigidTool::centre(const double time) const
  {
    return contact->pair(own_pairs.front())
      .pairing()
      .motion(time)
      .place(Point<dim>(free().reference_point));
  }



  RigidTool::Components
  RigidTool::force_of_bodies(const std::vector<PairResult> &results, const double time) const
  {
    Tensor<1, dim> force, moment;
    for (const unsigned int p : own_pairs)
      {
        force -= results[p].force;
        moment -= results[p].moment;
      }
    moment -= cross_product_3d(Tensor<1, dim>(centre(time)), force);
    Components all;
    for (unsigned int d = 0; d < dim; ++d)
      {
        all[d]       = force[d];
        all[dim + d] = moment[d];
      }
    return all;
  }



  void
  RigidTool::move(State &state, const State &from, const Components &by)
  {
    Tensor<1, dim> turn;
    for (unsigned int d = 0; d < dim; ++d)
      {
        state.shift[d] = from.shift[d] + by[d];
        turn[d]        = by[dim + d];
      }
    state.angle        = from.angle + turn;
    const double angle = turn.norm();
    state.turn = angle > 0. ? rotation(turn / angle, degrees * angle) * from.turn : from.turn;
  }



  void
  RigidTool::place(const State &state) const
  {
    const ToolMotion motion{Point<dim>(free().reference_point),
                            state.shift,
                            state.turn,
                            free().turns()};
    for (const unsigned int p : own_pairs)
      contact->pair(p).pairing().set_free_motion(motion);
  }



  RigidToolResult
  RigidTool::result(const State &state, const double time, const bool dynamic) const
  {
    RigidToolResult result;
    result.dynamic      = dynamic;
    result.displacement = centre(time) - Point<dim>(free().reference_point);
    // About one axis turns add up; more than half a turn is seen.
    const bool all  = free().is_free(3) && free().is_free(4);
    result.rotation = degrees * (all ? rotation_vector(state.turn) : state.angle);
    Tensor<1, dim> omega;
    for (unsigned int d = 0; d < dim; ++d)
      {
        result.force[d]    = state.contact[d];
        result.moment[d]   = state.contact[dim + d];
        result.velocity[d] = state.velocity[d];
        omega[d]           = state.velocity[dim + d];
      }
    result.angular_velocity = state.turn * omega;
    return result;
  }



  std::vector<RigidTool>
  rigid_tools(const std::vector<ObstacleParameters> &obstacles, const Contact &contact)
  {
    std::vector<RigidTool> result;
    for (const ObstacleParameters &obstacle : obstacles)
      if (obstacle.free.any())
        if (RigidTool tool(obstacle, contact); !tool.pairs().empty())
          result.push_back(std::move(tool));
    return result;
  }
} // namespace Touchstone

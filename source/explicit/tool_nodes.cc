// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/archive/archive.h>
#include <touchstone/explicit/tool_nodes.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

// Obstacles that forces move in explicit dynamics: central differences as for the nodes of bodies,
// velocities in the middle of cycles. Turns keep the angular momentum to round-off.
namespace Touchstone
{
  using namespace dealii;

  ToolNodes::ToolNodes(const std::vector<ObstacleParameters> &obstacles, const Contact &contact)
    : contact(contact)
    , tools(rigid_tools(obstacles, contact))
    , of_pairs(contact.n_pairs(), none)
    , first_dof(contact.solid_model().owned.size())
    , all_owned(first_dof + 2 * dim * tools.size())
    , before(tools.size())
  {
    const IndexSet &of_bodies = contact.solid_model().owned;
    all_owned.add_indices(of_bodies);
    if (Utilities::MPI::this_mpi_process(contact.communicator()) == 0)
      all_owned.add_range(first_dof, all_owned.size());
    all_owned.compress();
    for (unsigned int t = 0; t < tools.size(); ++t)
      {
        for (const unsigned int p : tools[t].pairs())
          of_pairs[p] = t;
        for (unsigned int c = 0; c < RigidTool::n_components; ++c)
          if (tools[t].free().is_free(c))
            tools[t].committed.velocity[c] = tools[t].free().start(c);
        tools[t].present = tools[t].committed;
      }
  }



  SymmetricTensor<2, dim>
  ToolNodes::mobility(const Index dof) const
  {
    const RigidTool        &tool = tools[(dof - first_dof) / (2 * dim)];
    const bool              turn = (dof - first_dof) % (2 * dim) > 0;
    SymmetricTensor<2, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      if (const unsigned int c = turn ? dim + d : d; tool.free().is_free(c))
        result[d][d] = 1. / tool.free().resistance(c);
    if (!turn)
      return result;
    const Tensor<2, dim> &R = tool.present.turn;
    return symmetrize(R * Tensor<2, dim>(result) * transpose(R));
  }



  Tensor<1, dim>
  ToolNodes::spatial(const RigidTool::State      &state,
                     const RigidTool::Components &velocity,
                     const bool                   turn)
  {
    Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = velocity[turn ? dim + d : d];
    return turn ? state.turn * result : result;
  }



  Tensor<1, dim>
  ToolNodes::velocity(const Index dof, const bool earlier) const
  {
    const unsigned int      t     = (dof - first_dof) / (2 * dim);
    const RigidTool::State &state = tools[t].present;
    return spatial(state, earlier ? before[t] : state.velocity, (dof - first_dof) % (2 * dim) > 0);
  }



  Tensor<1, dim>
  ToolNodes::velocity(const Index dof) const
  {
    return velocity(dof, false);
  }



  Tensor<1, dim>
  ToolNodes::velocity_before(const Index dof) const
  {
    return velocity(dof, true);
  }



  // The velocity of the obstacle at r from its reference point is v + omega x r, of which rows take
  // the negative; the impulse on the obstacle is that on the body with the other sign.
  Tensor<2, dim>
  ToolNodes::lever(const unsigned int pair, const Point<dim> &x, const double time) const
  {
    const Tensor<1, dim> r = x - tools[of_pairs[pair]].centre(time);
    Tensor<2, dim>       result; // -r x
    for (unsigned int d = 0; d < dim; ++d)
      {
        const unsigned int e = (d + 1) % dim, f = (d + 2) % dim;
        result[d][e] = r[f];
        result[d][f] = -r[e];
      }
    return result;
  }



  double
  ToolNodes::speed(const unsigned int pair) const
  {
    if (of_pairs[pair] == none)
      return 0.;
    const RigidTool::State &state = tools[of_pairs[pair]].present;
    const RigidTool        &tool  = tools[of_pairs[pair]];
    // Bodies and obstacle may have moved since the length was taken.
    return spatial(state, state.velocity, false).norm() +
           2. * tool.length() * spatial(state, state.velocity, true).norm();
  }



  Tensor<1, dim>
  ToolNodes::spin(const RigidTool &tool)
  {
    Tensor<1, dim> momentum;
    for (unsigned int d = 0; d < dim; ++d)
      momentum[d] = tool.free().inertia[d] * tool.present.velocity[dim + d];
    return tool.present.turn * momentum;
  }



  void
  ToolNodes::set_spin(RigidTool &tool, const Tensor<1, dim> &momentum)
  {
    const Tensor<1, dim> own = momentum * tool.present.turn; // transposed
    for (unsigned int d = 0; d < dim; ++d)
      if (tool.free().is_free(dim + d))
        tool.present.velocity[dim + d] = own[d] / tool.free().inertia[d];
  }



  void
  ToolNodes::kick(const double time, const double between)
  {
    present_time = time;
    for (unsigned int t = 0; t < tools.size(); ++t)
      {
        RigidTool &tool                      = tools[t];
        before[t]                            = tool.present.velocity;
        const RigidTool::Components load     = tool.load(time);
        Tensor<1, dim>              momentum = spin(tool);
        for (unsigned int d = 0; d < dim; ++d)
          {
            if (tool.free().is_free(d))
              tool.present.velocity[d] += between * load[d] / tool.free().mass;
            momentum[d] += between * load[dim + d];
          }
        set_spin(tool, momentum);
      }
  }



  void
  ToolNodes::restore()
  {
    for (unsigned int t = 0; t < tools.size(); ++t)
      tools[t].present.velocity = before[t];
  }



  void
  ToolNodes::take(const Index dof, const Tensor<1, dim> &velocity)
  {
    RigidTool           &tool = tools[(dof - first_dof) / (2 * dim)];
    const bool           turn = (dof - first_dof) % (2 * dim) > 0;
    const Tensor<1, dim> own  = turn ? velocity * tool.present.turn : velocity;
    for (unsigned int d = 0; d < dim; ++d)
      if (const unsigned int c = turn ? dim + d : d; tool.free().is_free(c))
        tool.present.velocity[c] = own[d];
  }



  void
  ToolNodes::spread()
  {
    for (RigidTool &tool : tools)
      MPI_Bcast(tool.present.velocity.data(),
                RigidTool::n_components,
                MPI_DOUBLE,
                0,
                contact.communicator());
  }



  void
  ToolNodes::advance(const double length)
  {
    present_time += length;
    for (RigidTool &tool : tools)
      {
        // The angular velocity that belongs to the momentum changes as the obstacle turns: that in
        // the middle of the cycle makes the turn exact to second order.
        const RigidTool::State from     = tool.present;
        const Tensor<1, dim>   momentum = spin(tool);
        for (const double part : {0.5, 1.})
          {
            const Tensor<1, dim> shift = spatial(from, from.velocity, false),
                                 turn  = spatial(tool.present, tool.present.velocity, true);
            RigidTool::Components way{};
            for (unsigned int d = 0; d < dim; ++d)
              {
                way[d]       = part * length * shift[d];
                way[dim + d] = part * length * turn[d];
              }
            RigidTool::move(tool.present, from, way);
            set_spin(tool, momentum);
          }
        tool.place(tool.present);
      }
  }



  void
  ToolNodes::end_interval(const double time)
  {
    if (tools.empty())
      return;
    present_time       = time;
    const auto results = pair_results(contact, contact.ghosted_displacement());
    for (RigidTool &tool : tools)
      tool.present.contact = tool.force_of_bodies(results, time);
  }



  std::map<std::string, RigidToolResult>
  ToolNodes::results() const
  {
    std::map<std::string, RigidToolResult> all;
    for (const RigidTool &tool : tools)
      all[tool.name()] = tool.result(tool.committed, present_time, /*dynamic=*/true);
    return all;
  }



  void
  ToolNodes::commit()
  {
    for (RigidTool &tool : tools)
      tool.committed = tool.present;
  }



  void
  ToolNodes::rollback()
  {
    for (RigidTool &tool : tools)
      {
        tool.present = tool.committed;
        tool.place(tool.present);
      }
  }



  void
  ToolNodes::save(ArchiveWriter &archive) const
  {
    if (tools.empty())
      return;
    std::vector<RigidTool::State> states;
    for (const RigidTool &tool : tools)
      states.push_back(tool.committed);
    archive.put("rigid tools", states);
  }



  void
  ToolNodes::load(const ArchiveReader &archive)
  {
    if (tools.empty())
      return;
    const auto states = archive.get<std::vector<RigidTool::State>>("rigid tools");
    for (unsigned int t = 0; t < tools.size(); ++t)
      tools[t].committed = states[t];
    rollback();
  }
} // namespace Touchstone

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/contact_stiffness.h>
#include <touchstone/explicit/impulse_contact.h>
#include <touchstone/explicit/row_geometry.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

// The rows that explicit dynamics keeps (doc/explicit.md, section 9.5): taken from Contact when
// motion demands it, with what a cycle needs of their nodes.
namespace Touchstone
{
  using namespace dealii;

  // The moment of a force that does not act along the gap vector is taken up around the slave node:
  // these faces are known here whole, and never degenerate. That of a force between nodes is taken
  // up by the nodes that it acts on.
  void
  ImpulseContact::find_patches()
  {
    patches.resize(contact.rows().size());
    for (const ContactRow &row : contact.rows())
      if (const ContactPair &pair = contact.pair(row); pair.master() && !row.between_nodes)
        {
          auto faces = pair.slave().faces_around(row.slave);
          std::sort(faces.begin(), faces.end(), [](const auto &a, const auto &b) {
            return a.first->key < b.first->key;
          });
          std::vector<Index> &patch = patches[row.index];
          for (const auto &[face, m] : faces)
            for (unsigned int i = 0; i < face->n_nodes(); ++i)
              if (std::find(patch.begin(), patch.end(), dim * face->nodes[i]) == patch.end())
                patch.push_back(dim * face->nodes[i]);
        }
  }



  void
  ImpulseContact::find_smallest_faces()
  {
    smallest_face.assign(contact.n_pairs(), std::numeric_limits<double>::max());
    for (const ContactRow &row : contact.rows())
      smallest_face[row.pair] = std::min(smallest_face[row.pair], row.size);
    for (double &size : smallest_face)
      size = Utilities::MPI::min(size, nodes.communicator());
    centre.resize(contact.n_pairs());
    radius.resize(contact.n_pairs());
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      {
        // The lowest coordinates, and the highest with the other sign.
        std::array<double, 2 * dim> ends;
        ends.fill(std::numeric_limits<double>::max());
        for (const ContactRow &row : contact.pair(p).rows())
          for (unsigned int d = 0; d < dim; ++d)
            {
              ends[d]       = std::min(ends[d], row.reference[d]);
              ends[dim + d] = std::min(ends[dim + d], -row.reference[d]);
            }
        Point<dim> corner;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double low        = Utilities::MPI::min(ends[d], nodes.communicator()),
                         minus_high = Utilities::MPI::min(ends[dim + d], nodes.communicator());
            centre[p][d]            = (low - minus_high) / 2.;
            corner[d]               = -minus_high;
          }
        radius[p] = 2. * corner.distance(centre[p]);
      }
  }



  void
  ImpulseContact::update_contact(const NodeField &u, const double time)
  {
    nodes.to_vector(u, displacement);
    if (!renew_rows)
      tell_what_presses();
    contact.update(displacement, time);
    contact.commit_positions();
  }



  void
  ImpulseContact::renew(const NodeField &u, const double time, const double step)
  {
    ++counted.renewals;
    update_contact(u, time);
    part_sides(u, time, step);
    if (!parted)
      make_rows(u);
  }



  void
  ImpulseContact::tell_what_presses()
  {
    for (const ContactRow &row : contact.rows())
      {
        RowState state = contact.state(row);
        if (state.status != ContactStatus::no_partner && !row.tied)
          state.status = history[row.index].impulse * row.normal > 0. ? ContactStatus::slip
                                                                      : ContactStatus::open;
        contact.enforcement().set_state(row, state);
      }
  }



  void
  ImpulseContact::make_rows(const NodeField &u)
  {
    kept.clear();
    kept_rows.clear();
    for (const ContactRow &from : contact.rows())
      if (from.has_partner)
        {
          const double scale = weight_of_slave(from);
          kept.push_back({from.index,
                          scale * from.gap,
                          scale * from.gap_vector,
                          contact.pair(from).part_of_overlap(contact.time()),
                          scale * from.gap});
          kept_rows.push_back(from.index);
        }
      else
        lose_partner(from);
    largest_weights = 1.;
    motion.restart(u, kept_rows);
    lay_out(u);
    for (std::size_t k = 0; k < kept.size(); ++k)
      take_out_motion(k);
    if (surfaces.needed())
      largest_weights = Utilities::MPI::max(largest_weights, nodes.communicator());
    asleep_until.assign(kept.size(), 0.);
    all_asleep_until = 0.;
    travelled        = RowTravel();
    fresh            = true;
    renew_rows       = false;
  }



  void
  ImpulseContact::lay_out(const NodeField &u)
  {
    std::vector<std::pair<Index, RowKey>> slots;
    solver.rows.clear();
    for (const KeptRow &row : kept)
      add_row(contact.rows()[row.index], slots);
    if (general)
      general->lay_out(solver.rows, slots);
    solver.nodes.reinit(tools.owned(), slots);
    solver.resize();
    set_nodes(u);
    for (std::size_t k = 0; k < kept.size(); ++k)
      set_weights(k);
  }



  // What a spring held is lost with its partner.
  void
  ImpulseContact::lose_partner(const ContactRow &row)
  {
    RowHistory &h         = history[row.index];
    h.impulse             = Tensor<1, dim>();
    ImpulseSpring &spring = springs[row];
    const double   held   = 0.5 * spring.stiffness * spring.gap * spring.gap;
    h.energy.obstacles -= held;
    h.energy.normal += held;
    h.energy.stored = h.energy.ahead = 0.;
    spring                           = ImpulseSpring();
  }



  void
  ImpulseContact::add_row(const ContactRow &from, std::vector<std::pair<Index, RowKey>> &slots)
  {
    std::vector<Index> &patch = patches[from.index];
    if (from.between_nodes)
      {
        patch.assign(1, dim * from.slave);
        for (const StencilEntry &entry : from.stencil)
          if (entry.weight < 0.)
            patch.push_back(dim * entry.node);
      }
    ImpulseRow row;
    row.key     = {from.pair, nodes.key(nodes.local(dim * from.slave))};
    row.first   = slots.size();
    row.n_nodes = 1 + from.stencil.size();
    row.n_lever = from.stencil.empty() ? 0 : patch.size();
    // An obstacle that forces move is a partner with two nodes.
    const bool tool = tools.shift_dof(from.pair) != invalid_index;
    if (tool)
      row.n_nodes = 2;
    row.tied     = from.tied;
    row.friction = from.friction;
    row.area     = from.area / weight_of_slave(from);
    slots.emplace_back(dim * from.slave, row.key);
    for (const StencilEntry &entry : from.stencil)
      slots.emplace_back(dim * entry.node, row.key);
    if (row.n_lever > 0)
      for (const Index dof : patch)
        slots.emplace_back(dof, row.key);
    if (tool)
      {
        row.n_lever = 1;
        slots.emplace_back(tools.shift_dof(from.pair), row.key);
        slots.emplace_back(tools.turn_dof(from.pair), row.key);
      }
    solver.rows.push_back(row);
  }



  void
  ImpulseContact::set_nodes(const NodeField &u)
  {
    const RowNodes &on        = solver.nodes;
    unsigned int    of_bodies = on.n_owned();
    while (of_bodies > 0 && tools.is_tool(on.dof(of_bodies - 1)))
      --of_bodies;
    local.resize(of_bodies);
    for (auto *field : {&reference, &u_nodes, &x_nodes, &made_at, &moved, &v_before})
      field->resize(on.n());
    std::vector<std::uint64_t> keys(on.n());
    for (unsigned int node = of_bodies; node < on.n_owned(); ++node)
      {
        keys[node]            = std::numeric_limits<std::uint64_t>::max() - on.dof(node);
        u_nodes[node]         = Tensor<1, dim>();
        solver.mobility[node] = tools.mobility(on.dof(node));
      }
    for (unsigned int node = 0; node < of_bodies; ++node)
      {
        local[node]           = nodes.local(on.dof(node));
        keys[node]            = nodes.key(local[node]);
        reference[node]       = nodes.positions()[local[node]];
        u_nodes[node]         = u[local[node]];
        made_at[node]         = motion.made_at_displacement()[local[node]];
        solver.mobility[node] = inverse_masses[local[node]];
      }
    if (rule.method == ImpulseRule::Method::bulk_springs)
      {
        stiffness_of_nodes.assign(on.n(), 0.);
        for (unsigned int node = 0; node < of_bodies; ++node)
          stiffness_of_nodes[node] = stiffness_of_cells[local[node]];
        on.forward(stiffness_of_nodes);
      }
    on.forward(keys);
    on.forward(reference);
    on.forward(u_nodes);
    on.forward(made_at);
    on.forward(solver.mobility);
    solver.sort_slots(keys);
  }



  void
  ImpulseContact::set_weights(const std::size_t k)
  {
    const ContactRow &from = contact.rows()[kept[k].index];
    ImpulseRow       &row  = solver.rows[k];
    std::size_t       s    = row.first;
    solver.weights[s++]    = 1.;
    for (const StencilEntry &entry : from.stencil)
      solver.weights[s++] = -entry.weight;
    if (tools.shift_dof(from.pair) != invalid_index)
      solver.weights[s++] = -1.;
    // Averages over slivers of faces can leave a sum that is one to ten digits only; momentum
    // wants all of them. The order of slots is that of the keys of nodes.
    double sum = 0.;
    for (unsigned int i = 0; i < row.n_nodes; ++i)
      if (solver.slot(row, i) != row.first)
        sum -= solver.weights[solver.slot(row, i)];
    for (std::size_t of_master = row.first + 1; of_master < s; ++of_master)
      solver.weights[of_master] /= sum;
    if (from.between_nodes)
      for (std::size_t of_point = row.first; of_point < s; ++of_point)
        solver.weights[of_point] *= weight_of_slave(from);
  }



  // The gaps that the row would have at zero displacements.
  void
  ImpulseContact::take_out_motion(const std::size_t k)
  {
    const ContactRow &from = contact.rows()[kept[k].index];
    const ImpulseRow &row  = solver.rows[k];
    Tensor<1, dim>    by_motion;
    double            absolute = 0.;
    for (unsigned int i = 0; i < row.n_nodes; ++i)
      {
        const std::size_t slot = solver.slot(row, i);
        by_motion += solver.weights[slot] * u_nodes[solver.nodes.node(slot)];
        absolute += std::abs(solver.weights[slot]);
      }
    if (!from.stencil.empty())
      largest_weights = std::max(largest_weights, 0.5 * absolute);
    kept[k].gap_vector -= by_motion;
    kept[k].gap -= by_motion * from.normal;
  }
} // namespace Touchstone

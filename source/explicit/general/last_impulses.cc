// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/explicit/general/last_impulses.h>

#include <algorithm>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Nodes of the coarser side that pressed on a face in one of so many cycles are looked at with
     * the free velocities: they are mostly over an edge of the face, where they do not count as
     * touching, and would ask for a round of their own. */
    constexpr std::uint64_t cycles_remembered = 16;
  } // namespace



  LastImpulses::LastImpulses(const ContactCandidates &candidates,
                             const MovingSurface     &surface,
                             const MPI_Comm           communicator)
    : candidates(candidates)
    , surface(surface)
    , communicator(communicator)
  {
  }



  void
  LastImpulses::begin_interval()
  {
    clear_rows();
    forget();
    std::fill(last_pressed.begin(), last_pressed.end(), 0);
    pressing.clear();
    cycles = 0;
  }



  void
  LastImpulses::forget()
  {
    ++epoch;
    arrived.clear();
    sliding.clear();
    pressed_edges.clear();
  }



  void
  LastImpulses::reinit()
  {
    last_pressed.assign(candidates.at_slots.n(), 0);
    pressed_nodes.assign(candidates.at_slots.n(), 0);
    pressing.clear();
  }



  RowKey
  LastImpulses::slave_of(const RowKey &key)
  {
    return key.pair == SurfaceRow::on_faces ? RowKey{key.pair, key.slave, {}} : key;
  }



  void
  LastImpulses::keep(const std::size_t     k,
                     const SurfaceRow     &row,
                     const Tensor<1, dim> &impulse,
                     const bool            slides)
  {
    of_rows[k] = {impulse, slides, epoch};
    if (slides)
      sliding.insert(slave_of(row.key));
    const SurfaceRow::Side &slave = row.sides[0];
    if (row.key.pair == SurfaceRow::on_faces && slave.n == 1)
      {
        press(slave.slots[0], cycles);
        pressed_nodes[candidates.at_slots.node(slave.slots[0])] = epoch;
      }
    else if (row.edges < candidates.edge_pairs.size())
      pressed_edges.push_back(row.edges);
  }



  Tensor<1, dim>
  LastImpulses::impulse(const std::size_t k, const RowKey &key) const
  {
    if (of_rows[k].epoch == epoch)
      return of_rows[k].impulse;
    const auto found = arrived.find(key);
    return found != arrived.end() ? found->second.impulse : Tensor<1, dim>();
  }



  bool
  LastImpulses::presses_often(const std::size_t slot) const
  {
    const std::uint64_t last = last_pressed[candidates.at_slots.node(slot)];
    return last > 0 && last + cycles_remembered >= cycles;
  }



  void
  LastImpulses::press(const std::size_t slot, const std::uint64_t in_cycle)
  {
    std::uint64_t &last = last_pressed[candidates.at_slots.node(slot)];
    if (last == 0)
      pressing.push_back(slot);
    last = in_cycle;
  }



  void
  LastImpulses::add_nodes_to(MovingSurface &cycle, const std::vector<SurfaceRow> &rows)
  {
    // Where these are is told to other ranks when there are new candidates.
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (of_rows[k].epoch == epoch)
        for (const SurfaceRow::Side &side : rows[k].sides)
          for (unsigned int i = 0; i < side.n; ++i)
            cycle.add_node(side.slots[i]);
    for (const std::size_t number : pressed_edges)
      {
        cycle.add_face(candidates.edge_pairs[number].one / 4);
        cycle.add_face(candidates.edge_pairs[number].other / 4);
      }
    std::size_t kept = 0;
    for (const std::size_t slot : pressing)
      if (presses_often(slot))
        {
          cycle.add_node(slot);
          pressing[kept++] = slot;
        }
      else
        last_pressed[candidates.at_slots.node(slot)] = 0;
    pressing.resize(kept);
  }



  LastImpulses::Carried
  LastImpulses::carried(const std::vector<SurfaceRow> &rows) const
  {
    return {rows_to_carry(rows), nodes_to_carry()};
  }



  // Where the cycle has taken them.
  std::vector<LastImpulses::OfRow>
  LastImpulses::rows_to_carry(const std::vector<SurfaceRow> &rows) const
  {
    std::vector<OfRow> result;
    for (const auto &carried : arrived)
      result.push_back(carried.second);
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (of_rows[k].epoch == epoch)
        {
          const SurfaceRow &row = rows[k];
          OfRow             what;
          what.key     = row.key;
          what.impulse = of_rows[k].impulse;
          what.sliding = of_rows[k].sliding;
          what.lower = what.upper = Point<dim>(surface.at(row.sides[0].slots[0]).x);
          // Of inner edges the slave side alone does not say on which rank their candidates are.
          for (unsigned int side = 0; side < (row.key.pair == SurfaceRow::on_edges ? 2U : 1U);
               ++side)
            for (unsigned int i = 0; i < row.sides[side].n; ++i)
              {
                const MovingSurface::NodeMotion &of = surface.at(row.sides[side].slots[i]);
                for (const Tensor<1, dim> &x : {of.x, of.x + surface.cycle * of.v})
                  for (unsigned int d = 0; d < dim; ++d)
                    {
                      what.lower[d] = std::min(what.lower[d], x[d]);
                      what.upper[d] = std::max(what.upper[d], x[d]);
                    }
              }
          result.push_back(what);
        }
    return result;
  }



  // Each node is remembered by the rank that has its candidates, which are on one. What has none is
  // forgotten, whatever the ranks.
  std::vector<LastImpulses::OfNode>
  LastImpulses::nodes_to_carry() const
  {
    std::vector<OfNode> result;
    for (const std::size_t slot : pressing)
      if (presses_often(slot))
        {
          const MovingSurface::NodeMotion &of = surface.at(slot);
          OfNode node{candidates.key(slot), last_pressed[candidates.at_slots.node(slot)], {}, {}};
          for (unsigned int d = 0; d < dim; ++d)
            {
              node.lower[d] = std::min(of.x[d], of.x[d] + surface.cycle * of.v[d]);
              node.upper[d] = std::max(of.x[d], of.x[d] + surface.cycle * of.v[d]);
            }
          result.push_back(node);
        }
    return result;
  }



  void
  LastImpulses::carry_over(const Carried &carried)
  {
    const auto to_regions = [&](const auto &what, auto &messages) {
      std::pair<Point<dim>, Point<dim>> corners(what.lower, what.upper);
      for (unsigned int d = 0; d < dim; ++d)
        {
          corners.first[d] -= candidates.reach();
          corners.second[d] += candidates.reach();
        }
      candidates.regions().for_each_owner(BoundingBox<dim>(corners), [&](const unsigned int rank) {
        messages[rank].push_back(what);
      });
    };
    std::map<unsigned int, std::vector<OfRow>>  for_rows;
    std::map<unsigned int, std::vector<OfNode>> for_nodes;
    for (const OfRow &what : carried.rows)
      to_regions(what, for_rows);
    for (const OfNode &what : carried.nodes)
      to_regions(what, for_nodes);
    forget();
    for (const auto &[rank, list] : exchange_records(for_rows, communicator))
      for (const OfRow &what : list)
        remember(what);
    for (const auto &[rank, list] : exchange_records(for_nodes, communicator))
      for (const OfNode &what : list)
        if (const std::size_t pair = candidates.find_node(what.key);
            pair < candidates.node_faces.size())
          press(candidates.node_faces[pair].node, what.cycle);
  }



  void
  LastImpulses::remember(const OfRow &what)
  {
    arrived[what.key] = what;
    if (what.sliding)
      sliding.insert(slave_of(what.key));
    if (what.key.pair == SurfaceRow::on_faces)
      {
        if (const std::size_t pair = candidates.find_node(what.key.slave);
            pair < candidates.node_faces.size())
          pressed_nodes[candidates.at_slots.node(candidates.node_faces[pair].node)] = epoch;
      }
    else
      {
        const std::size_t number = candidates.find_edges(
          {{what.key.slave, what.key.others[0], what.key.others[1], what.key.others[2]}});
        if (number < candidates.edge_pairs.size())
          pressed_edges.push_back(number);
      }
  }
} // namespace Touchstone

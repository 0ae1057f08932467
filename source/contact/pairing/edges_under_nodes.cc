// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/deformed_cells.h>
#include <touchstone/contact/pairing/edges_under_nodes.h>

#include <limits>

// Which slave nodes stay on the edges that they stand on (doc/theory.md 4.2, "Parallel edges").
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Takes the place of the key of a face, which a node on an edge does not have. */
    constexpr std::uint64_t on_edge = std::numeric_limits<std::uint64_t>::max();
  } // namespace



  EdgesUnderNodes::EdgesUnderNodes(const PairingInput &input)
    : input(input)
    , slave(*input.slave)
    , edges(slave.owned_nodes().size())
    , stood(edges.size(), false)
    , has_left(edges.size(), false)
    , touched(edges.size(), false)
    , overlaps(edges.size(), input.slave_body != input.master_body)
  {
  }



  bool
  EdgesUnderNodes::find(const std::size_t k,
                        const Search     &search,
                        const SlavePoint &point,
                        const double      size,
                        const BeyondEdge  beyond_edge)
  {
    if (first_of_step)
      touched[k] = point.in_contact;
    EdgeOnEdge::Reach reach;
    reach.size           = size;
    reach.edge_tolerance = input.parameters->edge_tolerance;
    reach.stays          = stood[k] && !has_left[k];
    reach.overlaps       = overlaps[k];
    reach.beyond_edge    = beyond_edge;
    reach.touched        = touched[k];
    edges[k] = EdgeOnEdge::find(slave, search, point, slave.owned_nodes()[k].node, reach);
    return edges[k].has_value();
  }



  bool
  EdgesUnderNodes::end_update(const Vector &u)
  {
    first_of_step = false;
    // The first step begins with the bodies as they are placed.
    if (started)
      return false;
    std::vector<std::size_t>               deep;
    std::vector<std::array<Point<dim>, 2>> feet;
    for (std::size_t k = 0; k < edges.size(); ++k)
      if (overlaps[k] && edges[k] && edges[k]->deep())
        {
          deep.push_back(k);
          feet.push_back(edges[k]->feet(slave.position(slave.owned_nodes()[k], u)));
        }
    const std::vector<bool> overlap =
      lie_within_each_other(feet, *input.solid, {{input.slave_body, input.master_body}}, u);
    bool again = false;
    for (std::size_t i = 0; i < deep.size(); ++i)
      if (!overlap[i])
        {
          overlaps[deep[i]] = false;
          again             = true;
        }
    again = Utilities::MPI::max(static_cast<int>(again), input.solid->communicator) == 1;
    if (again)
      return true;
    for (std::size_t k = 0; k < edges.size(); ++k)
      overlaps[k] = overlaps[k] && edges[k] && edges[k]->deep();
    commit();
    return false;
  }



  void
  EdgesUnderNodes::commit()
  {
    for (std::size_t k = 0; k < edges.size(); ++k)
      stood[k] = edges[k] && edges[k]->may_stay();
    started = true;
    begin_step();
  }



  void
  EdgesUnderNodes::begin_step()
  {
    has_left.assign(edges.size(), false);
    first_of_step = true;
  }



  bool
  EdgesUnderNodes::leave()
  {
    bool changed = false;
    for (std::size_t k = 0; k < edges.size(); ++k)
      if (stood[k] && !has_left[k] && edges[k] && !edges[k]->stands())
        {
          has_left[k] = true;
          changed     = true;
        }
    return changed;
  }



  void
  EdgesUnderNodes::save(std::vector<std::optional<std::uint64_t>> &of_rows) const
  {
    for (std::size_t k = 0; k < edges.size(); ++k)
      if (stood[k])
        of_rows[k] = on_edge;
  }



  void
  EdgesUnderNodes::load(std::vector<std::optional<std::uint64_t>> &of_rows)
  {
    for (std::size_t k = 0; k < edges.size() && k < of_rows.size(); ++k)
      {
        stood[k] = (of_rows[k] == on_edge);
        if (stood[k])
          of_rows[k].reset();
      }
    started = true;
    begin_step();
  }
} // namespace Touchstone

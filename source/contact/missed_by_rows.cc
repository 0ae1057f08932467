// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/contact/contact_checks.h>
#include <touchstone/contact/contact_pair.h>
#include <touchstone/contact/missed_contact.h>
#include <touchstone/contact/overlap_order.h>
#include <touchstone/contact/overlapping_bodies.h>
#include <touchstone/contact/place_in_words.h>
#include <touchstone/contact/search/search.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <utility>

// What the rows of each pair have missed, in words: between the slave nodes, and bodies that have
// passed so far into each other that faces do not tell of it.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** What reaches into the slave body, by how much and where. */
    std::string
    text(const ContactPairParameters &pair, const MissedContact::Place &place)
    {
      char of[20];
      std::snprintf(of, sizeof(of), "%.3g", place.depth);
      return "contact pair '" + pair.name + "': " +
             (pair.obstacle.empty() ? "'" + pair.master_body : "the obstacle '" + pair.obstacle) +
             "' reaches " + of + " into '" + pair.slave_body + "' at " + place_in_words(place.x);
    }



    std::string
    between_nodes(const ContactPairParameters &pair, const MissedContact::Place &place)
    {
      return text(pair, place) +
             ", between slave nodes that touch nothing. Rows of slave nodes cannot describe this "
             "contact: " +
             pair.finer_slave();
    }



    std::string
    at_held_nodes(const ContactPairParameters &pair, const MissedContact::Place &place)
    {
      return text(pair, place) +
             ", where neither surface can follow: the displacement of the slave node along the normal "
             "is prescribed, or another pair decides on it, and the master is held as well. Prescribe "
             "displacements at boundaries that are not in contact";
    }



    /** Add held nodes that have left their rows to others (Contact::held()): these keep the
     * surfaces apart in the mean, whatever displacements are prescribed there. Collective. */
    void
    add_without_rows(const Contact                     &contact,
                     const ContactPair                 &pair,
                     const std::set<Index>             &held,
                     std::vector<MissedContact::Place> &places)
    {
      // The same on all ranks.
      if (held.empty() || !pair.master())
        return;
      Search search(*pair.master(),
                    2. * std::max(pair.slave().largest_face(), pair.master()->largest_face()),
                    pair.parameters().edge_tolerance,
                    pair.parameters().master_normal,
                    contact.communicator());
      // Of each the row, and the area that it would have.
      std::vector<std::pair<const ContactRow *, double>> rows;
      std::vector<Point<dim>>                            positions;
      double                                             adjusted = 0.;
      for (std::size_t k = 0; k < pair.rows().size(); ++k)
        {
          const ContactRow &row = pair.rows()[k];
          adjusted              = std::max(adjusted, -pair.overlap(k));
          if (row.has_partner || row.between_nodes || held.count(row.slave) == 0)
            continue;
          rows.emplace_back(&row, pair.slave().owned_nodes()[k].area);
          positions.push_back(row.position);
        }
      adjusted = Utilities::MPI::max(adjusted, contact.communicator()) *
                 pair.part_of_overlap(contact.time());
      search.update(positions);
      for (const auto &[row, area] : rows)
        {
          SlavePoint point;
          point.x = point.start = row->position;
          point.normal          = pair.slave().normal(row->slave);
          if (const auto partner = search.find(point))
            if (const double depth = (partner->x - row->position) * partner->normal - adjusted;
                depth > Tolerances::touching * row->size)
              places.push_back({depth, row->position, row->size, area});
        }
    }



    /** The deepest of the slave nodes of a pair that touch and whose row was refused, and the area
     * of all of them; the same on all ranks. Collective. */
    MissedContact::Place
    held_nodes(const Contact &contact, const ContactPair &pair, const std::set<Index> &without_rows)
    {
      std::vector<MissedContact::Place> mine;
      const std::vector<SurfaceNode>   &nodes = pair.slave().owned_nodes();
      for (std::size_t k = 0; k < nodes.size(); ++k)
        {
          // The area of the node: its row may have left a part of it to others.
          const ContactRow &row = pair.rows()[k];
          if (const double depth = -row.gap / row.share;
              row.has_partner && contact.state(row).active() && contact.state(row).dropped() &&
              depth > Tolerances::touching * row.size)
            mine.push_back({depth, row.position, row.size, nodes[k].area});
        }
      add_without_rows(contact, pair, without_rows, mine);
      std::vector<MissedContact::Place> all = gather_all(mine, contact.communicator());
      sort_by_depth(all, [](const MissedContact::Place &place) { return place; });
      return MissedContact::first_of(all);
    }



    /** Add pairs without any force whose bodies have come to lie within each other so far that the
     * faces which met do not tell of it. @param idle Such pairs, by the numbers of their bodies. */
    void
    add_overlapping_bodies(const Contact &contact,
                           const std::map<std::pair<unsigned int, unsigned int>, std::string> &idle,
                           std::map<std::string, MissedByRows> &result)
    {
      const auto            &solid = contact.solid_model();
      std::set<unsigned int> bodies;
      for (const auto &[both, pair] : idle)
        bodies.insert({both.first, both.second});
      for (const BodyOverlap &overlap :
           overlapping_bodies(contact, contact.ghosted_displacement(), bodies))
        {
          const auto pair = idle.find(std::minmax(overlap.body, overlap.other));
          if (pair == idle.end())
            continue;
          // What has been so from the start, or half as deep, is as the scene has it: facets of
          // tubes with a clearance overlap, more or less as they slide along each other.
          constexpr double half = 0.5;
          const Vector     zero = contact.with_ghosts(solid.zero_vector());
          const auto       before =
            overlapping_bodies(contact, zero, bodies, half * Tolerances::deep_in_body);
          if (std::any_of(before.begin(), before.end(), [&](const BodyOverlap &other) {
                return std::minmax(other.body, other.other) ==
                         std::minmax(overlap.body, overlap.other) &&
                       other.depth >= half * overlap.depth;
              }))
            continue;
          result[pair->second] = {"contact pair '" + pair->second + "' carries nothing, but " +
                                    overlap.place(solid) +
                                    ". Refine the slave surface, exchange slave and master, or "
                                    "take smaller steps",
                                  true,
                                  1.};
        }
    }
  } // namespace



  std::map<std::string, MissedByRows>
  missed_contact(const Contact &contact)
  {
    std::map<std::string, MissedByRows>                          result;
    std::map<std::pair<unsigned int, unsigned int>, std::string> idle;
    std::set<std::pair<unsigned int, unsigned int>>              carried;
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      {
        const ContactPair &pair = contact.pair(p);
        if (pair.tied())
          continue;
        const Vector                                forces = normal_forces(contact, pair);
        const MissedContact                         missed(contact, pair, forces);
        const bool                                  nothing = missed.carries_nothing();
        const std::pair<unsigned int, unsigned int> bodies =
          std::minmax({pair.slave_body(), pair.master_body()});
        if (!nothing)
          carried.insert(bodies);
        else if (pair.master())
          idle.emplace(bodies, pair.parameters().name);
        MissedByRows               found;
        const MissedContact::Place held = held_nodes(contact, pair, contact.held(p));
        if (held.depth > 0.)
          found = {at_held_nodes(pair.parameters(), held),
                   MissedContact::deep(held),
                   missed.share(held)};
        // Surfaces that slide farther than small sliding knows may overlap anywhere; but a pair
        // without any force has missed what it is for.
        else if (!pair.small_sliding() || nothing)
          if (const MissedContact::Place place = missed.deepest(); place.depth > 0.)
            found = {between_nodes(pair.parameters(), place),
                     MissedContact::deep(place),
                     missed.share(place)};
        if (!found.text.empty())
          result[pair.parameters().name] = found;
      }
    for (const auto &bodies : carried)
      idle.erase(bodies);
    if (!idle.empty())
      add_overlapping_bodies(contact, idle, result);
    return result;
  }
} // namespace Touchstone

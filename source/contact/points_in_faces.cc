// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact_checks.h>
#include <touchstone/contact/contact_pair.h>
#include <touchstone/contact/missed_contact.h>
#include <touchstone/contact/points_in_faces.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

// Which points inside slave faces have rows (doc/theory.md 4.2). It follows from states of balance
// alone, each with fewer points than the next, the first of a step without any: so it depends
// neither on the iterates of Newton's method nor on the steps before, nor on numbers of nodes or
// ranks.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** What the row of a point has to know of the slave nodes, with ghosts: components of a vector
     * over the nodes. */
    enum SlaveFlag
    {
      /** The row of the node itself carries a force. */
      carries,
      /** Its row between nodes carries a force, of an edge or vertex, or is that of a point. */
      taken,
      /** The condition of that row was refused: supports or other rows determine it. */
      refused
    };

    /** @return Flags, with ghosts. Collective. */
    Vector
    slave_flags(const Contact &contact, const ContactPair &pair)
    {
      Vector flags(contact.solid_model().owned, contact.communicator());
      for (const ContactRow &row : pair.rows())
        {
          const RowState &state = contact.state(row);
          if (!row.between_nodes)
            flags(dim * row.slave + carries) = state.active() && state.lambda > 0.;
          else
            {
              flags(dim * row.slave + taken)   = state.active();
              flags(dim * row.slave + refused) = state.active() && state.dropped();
            }
        }
      for (const MaterialPoint &point : pair.points())
        if (const Index node = point.nodes[point.slave];
            contact.solid_model().owned.is_element(dim * node))
          flags(dim * node + taken) = 1.;
      flags.compress(VectorOperation::insert);
      return contact.with_ghosts(flags);
    }



    class PointsOfPair
    {
    public:
      PointsOfPair(const Contact &contact, const ContactPair &pair)
        : contact(contact)
        , pair(pair)
        , flags(slave_flags(contact, pair))
        , points(pair.points())
      {
      }

      /** Add or move points. @return whether any has been. Collective. */
      bool
      place();

      /** Of the last place(). */
      const std::vector<MaterialPoint> &
      result() const
      {
        return points;
      }

    private:
      const Contact             &contact;
      const ContactPair         &pair;
      const Vector               flags;
      std::vector<MaterialPoint> points;

      /** Choose the node that is to have the row; false if there is none. @param before The point
       * that this one takes the place of, or null. Collective. */
      bool
      choose_slave(MaterialPoint &point, const MaterialPoint *before) const;
    };



    bool
    PointsOfPair::choose_slave(MaterialPoint &point, const MaterialPoint *const before) const
    {
      // The owner of a node knows its flags.
      std::array<int, Face::max_nodes> free{};
      for (unsigned int a = 0; a < point.n; ++a)
        if (const Index first = dim * point.nodes[a]; contact.solid_model().owned.is_element(first))
          {
            const bool own = before && before->nodes[before->slave] == point.nodes[a];
            free[a]        = flags(first + carries) == 0. && flags(first + refused) == 0. &&
                      (own || flags(first + taken) == 0.);
          }
      std::vector<int> all(free.begin(), free.end());
      Utilities::MPI::max(all, contact.communicator(), all);
      double largest = Tolerances::least_share;
      bool   found   = false;
      for (unsigned int a = 0; a < point.n; ++a)
        // Of equal weights the first on the face, which is the same in any partition.
        if (all[a] == 1 && point.weights[a] > largest + (found ? Tolerances::edge_end : 0.))
          {
            point.slave = a;
            largest     = point.weights[a];
            found       = true;
          }
      return found;
    }



    /** Whether two points in faces that share a node are about equally deep. Only one of them can
     * have a row, and round-off, or the numbers of the nodes, would choose it: the result would be
     * less symmetric than the scene. */
    bool
    ambiguous(const std::vector<MaterialPoint> &wanted)
    {
      constexpr double equal = 0.99;
      // The deepest come first.
      std::map<Index, const MaterialPoint *> deepest;
      for (const MaterialPoint &point : wanted)
        for (unsigned int a = 0; a < point.n; ++a)
          if (const MaterialPoint *const other =
                deepest.emplace(point.nodes[a], &point).first->second;
              other->face != point.face && point.depth > equal * other->depth)
            return true;
      return false;
    }



    bool
    PointsOfPair::place()
    {
      // Nearer to each other than this, in face coordinates, two points are one.
      constexpr double    same   = 1e-3;
      const Vector        forces = normal_forces(contact, pair);
      const MissedContact missed(contact, pair, forces);
      // Facets of bodies that slave nodes keep apart overlap a little in many places. Points are
      // for what would be no result without them.
      if (points.empty())
        if (const MissedContact::Place place = missed.deepest();
            place.depth == 0. ||
            !(MissedContact::deep(place) || missed.share(place) > MissedContact::most_share))
          return false;
      const std::vector<MaterialPoint> wanted = missed.points();
      if (ambiguous(wanted))
        return false;
      std::set<Index> used;
      bool            changed = false;
      for (MaterialPoint point : wanted)
        {
          // Of faces that share a node the one with the deepest overlap comes first: with a row
          // there its neighbours may touch nothing.
          if (std::any_of(point.nodes.begin(),
                          point.nodes.begin() + point.n,
                          [&](const Index node) { return used.count(node) > 0; }))
            continue;
          const auto before =
            std::find_if(points.begin(), points.end(), [&](const MaterialPoint &other) {
              return other.face == point.face;
            });
          if (!choose_slave(point, before == points.end() ? nullptr : &*before))
            continue;
          if (before == points.end())
            points.push_back(point);
          else if (std::hypot(point.xi[0] - before->xi[0], point.xi[1] - before->xi[1]) < same &&
                   point.slave == before->slave)
            // Its row is there and says that nothing touches.
            continue;
          else
            *before = point;
          used.insert(point.nodes.begin(), point.nodes.begin() + point.n);
          changed = true;
        }
      return changed;
    }
  } // namespace



  void
  withdraw_points(Contact &contact)
  {
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      if (contact.pair(p).takes_points() && !contact.pair(p).points().empty())
        contact.set_points(p, {});
  }



  bool
  place_points(Contact &contact)
  {
    bool changed = false;
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      if (contact.pair(p).takes_points())
        if (PointsOfPair points(contact, contact.pair(p)); points.place())
          {
            contact.set_points(p, points.result());
            changed = true;
          }
    return changed;
  }



  unsigned int
  n_points_in_contact(const Contact &contact)
  {
    unsigned int n = 0;
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      if (const ContactPair &pair = contact.pair(p); pair.takes_points())
        for (const MaterialPoint &point : pair.points())
          for (const ContactRow &row : pair.rows())
            n += row.between_nodes && row.slave == point.nodes[point.slave] &&
                 contact.state(row).active() && contact.state(row).lambda > 0.;
    return Utilities::MPI::sum(n, contact.communicator());
  }
} // namespace Touchstone

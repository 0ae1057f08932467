// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact_checks.h>
#include <touchstone/contact/contact_pair.h>
#include <touchstone/contact/missed_contact.h>
#include <touchstone/contact/pairing/sets_of_points.h>
#include <touchstone/contact/points_in_faces.h>
#include <touchstone/contact/pressing_rows.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>

// Which points inside slave faces have rows (doc/theory.md 4.2). It follows from states of balance
// alone, each with fewer points than the next, the first of a step without any, or with those that
// have pressed into plastic bodies: so it depends neither on the iterates of Newton's method nor on
// numbers of nodes or ranks, and without plasticity not on the steps before either.
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
      Vector             flags(contact.solid_model().owned, contact.communicator());
      const PressingRows pressing(contact);
      for (const ContactRow &row : pair.rows())
        {
          const RowState &state = contact.state(row);
          if (!row.between_nodes)
            flags(dim * row.slave + carries) = pressing.contain(row);
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



    /** Rows that carried a force in the committed state. */
    class CarryingRows
    {
    public:
      explicit CarryingRows(const Contact &contact)
        : states(contact.enforcement().states())
        , pressing(contact, PressingRows::Of::committed)
      {
      }

      bool
      contain(const ContactRow &row) const
      {
        return pressing.contain(row) && !states.of_committed(row).dropped();
      }

    private:
      const RowArray<RowState> &states;
      const PressingRows        pressing;
    };



    /** The points of the committed state that carried a force. Collective. */
    std::vector<MaterialPoint>
    carrying(const CarryingRows &rows, const ContactPair &pair, const MPI_Comm communicator)
    {
      const std::vector<MaterialPoint> &points = pair.committed_points();
      std::vector<int>                  carry(points.size(), 0);
      for (const ContactRow &row : pair.rows())
        if (const MaterialPoint *const point =
              row.between_nodes ? point_of(points, row.slave) : nullptr)
          carry[point - points.data()] = rows.contain(row);
      Utilities::MPI::max(carry, communicator, carry);
      std::vector<MaterialPoint> result;
      for (std::size_t k = 0; k < points.size(); ++k)
        if (carry[k] == 1)
          result.push_back(points[k]);
      return result;
    }



    /** Those of them with which the next step begins. What a point has pressed into a plastic body
     * no other one would carry: it stays until it opens, or its nodes carry the force. Collective.
     */
    std::vector<MaterialPoint>
    staying(const CarryingRows &rows, const Contact &contact, const ContactPair &pair)
    {
      if (!contact.solid_model().has_history())
        return {};
      const std::vector<MaterialPoint> points = carrying(rows, pair, contact.communicator());
      std::vector<int>                 at_node(points.size(), 0);
      for (const ContactRow &row : pair.rows())
        if (!row.between_nodes && rows.contain(row))
          for (std::size_t k = 0; k < points.size(); ++k)
            at_node[k] = at_node[k] || refers_to(points[k], row.slave);
      Utilities::MPI::max(at_node, contact.communicator(), at_node);
      std::vector<MaterialPoint> result;
      for (std::size_t k = 0; k < points.size(); ++k)
        if (at_node[k] == 0)
          result.push_back(points[k]);
      return result;
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
        const CarryingRows rows(contact);
        of_last_step = carrying(rows, pair, contact.communicator());
        stayed       = staying(rows, contact, pair);
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
      /** Points that carried a force when the last step ended. */
      std::vector<MaterialPoint> of_last_step;
      /** Those of them that the step began with. */
      std::vector<MaterialPoint> stayed;

      /** No points but these. */
      bool
      none_new() const;

      /** The one of them that @p point goes on from, or null. */
      const MaterialPoint *
      continued(const MaterialPoint &point) const;

      /** Choose the node that is to have the row; false if there is none. @param before The point
       * that this one takes the place of, or null. @param others That have rows. @param wanted All
       * that are to have rows. Collective. */
      bool
      choose_slave(MaterialPoint                    &point,
                   const MaterialPoint              *before,
                   const std::vector<MaterialPoint> &others,
                   const std::vector<MaterialPoint> &wanted) const;
    };



    bool
    PointsOfPair::none_new() const
    {
      return points.size() == stayed.size() &&
             std::all_of(points.begin(), points.end(), [&](const MaterialPoint &point) {
               return std::any_of(stayed.begin(), stayed.end(), [&](const MaterialPoint &other) {
                 return coincide(point, other);
               });
             });
    }



    const MaterialPoint *
    PointsOfPair::continued(const MaterialPoint &point) const
    {
      const MaterialPoint *result = nullptr;
      for (const MaterialPoint &last : of_last_step)
        if (goes_on_from(last, point) &&
            (!result || distance(last, point) < distance(*result, point)))
          result = &last;
      return result;
    }



    bool
    PointsOfPair::choose_slave(MaterialPoint                    &point,
                               const MaterialPoint *const        before,
                               const std::vector<MaterialPoint> &others,
                               const std::vector<MaterialPoint> &wanted) const
    {
      // The owner of a node knows its flags.
      std::array<int, Face::max_nodes> free{};
      for (unsigned int a = 0; a < point.n; ++a)
        if (const Index first = dim * point.nodes[a]; contact.solid_model().owned.is_element(first))
          {
            const bool own      = before && before->nodes[before->slave] == point.nodes[a];
            const bool possible = flags(first + carries) == 0. && flags(first + refused) == 0. &&
                                  (own || flags(first + taken) == 0.);
            // On a plane of symmetry a row has no friction across, which the point has.
            const bool on_plane = pair.planes_of_symmetry().count(point.nodes[a]) > 0;
            free[a]             = possible ? (on_plane ? 1 : 2) : 0;
          }
      std::vector<int> all(free.begin(), free.end());
      Utilities::MPI::max(all, contact.communicator(), all);
      // Friction goes on in the same row.
      if (const MaterialPoint *const last = continued(point))
        for (unsigned int a = 0; a < point.n; ++a)
          if (all[a] > 0 && point.nodes[a] == last->nodes[last->slave])
            all[a] += 2;
      // Small weights make large coefficients: only where others would close a cycle.
      for (const double least : {Tolerances::least_share, 0.25 * Tolerances::least_share})
        {
          double       largest = 0.;
          unsigned int fewest  = 0;
          int          most    = 0;
          bool         found   = false;
          for (unsigned int a = 0; a < point.n; ++a)
            {
              if (all[a] == 0 || point.weights[a] <= least)
                continue;
              // That of the last step, or a node on no plane of symmetry; of these the one that the
              // fewest other rows refer to, then the one with the largest weight, and of equal
              // weights the first on the face, which is the same in any partition.
              const unsigned int n =
                std::count_if(wanted.begin(), wanted.end(), [&](const MaterialPoint &other) {
                  return !coincide(other, point) && refers_to(other, point.nodes[a]);
                });
              if (found && (all[a] < most ||
                            (all[a] == most &&
                             (n > fewest || (n == fewest &&
                                             point.weights[a] <= largest + Tolerances::edge_end)))))
                continue;
              std::vector<MaterialPoint> trial(others);
              trial.push_back(point);
              trial.back().slave = a;
              if (std::any_of(others.begin(),
                              others.end(),
                              [&](const MaterialPoint &other) {
                                return other.nodes[other.slave] == point.nodes[a];
                              }) ||
                  in_cycle(trial))
                continue;
              point.slave = a;
              largest     = point.weights[a];
              fewest      = n;
              most        = all[a];
              found       = true;
            }
          if (found)
            return true;
        }
      return false;
    }



    bool
    PointsOfPair::place()
    {
      const Vector        forces = normal_forces(contact, pair);
      const MissedContact missed(contact, pair, forces);
      // Facets of bodies that slave nodes keep apart overlap a little in many places. Points are
      // for what would be no result without them.
      if (none_new())
        if (const MissedContact::Place place = missed.deepest();
            place.depth == 0. ||
            !(MissedContact::deep(place) || missed.share(place) > MissedContact::most_share))
          return false;
      const std::vector<MaterialPoint> wanted  = deepest_of_neighbours(on_edges(missed.points()));
      std::vector<MaterialPoint>       result  = points;
      bool                             changed = false;
      for (MaterialPoint point : wanted)
        {
          std::vector<MaterialPoint> others  = result;
          const auto                 of_face = [&](const MaterialPoint &other) {
            return in_same_face(point, other);
          };
          others.erase(std::remove_if(others.begin(), others.end(), of_face), others.end());
          const auto before = std::find_if(result.begin(), result.end(), of_face);
          if (!choose_slave(point, before == result.end() ? nullptr : &*before, others, wanted))
            {
              if (std::any_of(wanted.begin(), wanted.end(), [&](const MaterialPoint &other) {
                    return !coincide(other, point) && equally_deep(point, other);
                  }))
                return false;
              continue;
            }
          if (before == result.end())
            result.push_back(point);
          else if (coincide(point, *before) &&
                   point.nodes[point.slave] == before->nodes[before->slave])
            // Its row is there and says that nothing touches.
            continue;
          else
            {
              // A point on an edge takes the place of those in its faces.
              result = others;
              result.push_back(point);
            }
          changed = true;
        }
      points = result;
      return changed;
    }



    /** How many points of a pair carry a force. Collective. */
    unsigned int
    n_in_contact(const Contact &contact, const ContactPair &pair)
    {
      if (!pair.takes_points() || pair.points().empty())
        return 0;
      unsigned int       n = 0;
      const PressingRows pressing(contact);
      for (const MaterialPoint &point : pair.points())
        for (const ContactRow &row : pair.rows())
          n += row.between_nodes && row.slave == point.nodes[point.slave] && pressing.contain(row);
      return Utilities::MPI::sum(n, contact.communicator());
    }
  } // namespace



  void
  withdraw_points(Contact &contact)
  {
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      if (const ContactPair &pair = contact.pair(p); pair.takes_points() && !pair.points().empty())
        contact.set_points(p, staying(CarryingRows(contact), contact, pair));
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



  std::string
  pairs_with_points(const Contact &contact)
  {
    std::string names;
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      if (const ContactPair &pair = contact.pair(p); pair.takes_points() && !pair.points().empty())
        names += (names.empty() ? "'" : ", '") + pair.parameters().name + "'";
    return names;
  }



  PointsInContact
  points_in_contact(const Contact &contact)
  {
    PointsInContact result;
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      if (const unsigned int n = n_in_contact(contact, contact.pair(p)); n > 0)
        {
          result.n += n;
          const ContactPairParameters &pair = contact.pair(p).parameters();
          result.warnings.push_back(
            "contact pair '" + pair.name +
            "': what touches is narrower than the slave faces and carried by points inside these, so "
            "that the force depends on the mesh and may be too large by a factor: " +
            pair.finer_slave());
        }
    return result;
  }
} // namespace Touchstone

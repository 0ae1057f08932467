// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/base/input_error.h>
#include <touchstone/contact/geometry/deformed_cells.h>
#include <touchstone/contact/start_check.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

// Checks of a contact pair before the first step, for mistakes of the input that would let bodies
// pass through each other without a message: surfaces that face away from each other, and an
// initial overlap deeper than the search distance, where slave nodes find no partner. The checks
// are collective and throw on all ranks alike.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Position and unit outward normal of a node of a surface. */
    using Place = std::array<double, 2 * dim>;

    Place
    place(const Surface &surface, const SurfaceNode &node, const Vector &u)
    {
      // Six numbers, so that the positions and normals of all ranks can be exchanged as plain
      // arrays.
      const Point<dim>     x = surface.position(node, u);
      const Tensor<1, dim> n = surface.normal(node.node);
      return {{x[0], x[1], x[2], n[0], n[1], n[2]}};
    }

    Point<dim>
    position(const Place &place)
    {
      return Point<dim>(place[0], place[1], place[2]);
    }

    Tensor<1, dim>
    normal(const Place &place)
    {
      return Point<dim>(place[3], place[4], place[5]);
    }

    /** A point a little below the centre of a face, so that bodies that only touch do not
     * seem to overlap, and its normal. */
    Place
    place_below(const Surface &surface, const Face &face, const Vector &u)
    {
      Point<dim>     centre;
      Tensor<1, dim> n;
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        {
          for (unsigned int d = 0; d < dim; ++d)
            centre[d] +=
              (face.reference[m][d] + u(dim * face.nodes[m] + d)) / double(face.n_nodes());
          n += surface.normal(face.nodes[m]);
        }
      if (n.norm() > 0.)
        n /= n.norm();
      // Inward by a thousandth of an edge.
      centre -= Tolerances::touching * face.reference[0].distance(face.reference[1]) * n;
      return {{centre[0], centre[1], centre[2], n[0], n[1], n[2]}};
    }

    std::vector<Place>
    own_places(const Surface &surface, const Vector &u)
    {
      std::vector<Place> mine;
      for (const SurfaceNode &node : surface.owned_nodes())
        mine.push_back(place(surface, node, u));
      return mine;
    }

    /** Whether the closest of the @p others, of all ranks, to any of these places opposes it. The
     * others go round the ranks, piece by piece, so that none holds all of them. Collective. */
    bool
    any_faces_closest(const std::vector<Place> &places,
                      std::vector<Place>        others,
                      const MPI_Comm            communicator)
    {
      // Of several at the same distance one that opposes the place: the first one that is met would
      // depend on the ranks.
      std::vector<std::pair<double, double>> closest(places.size(),
                                                     {std::numeric_limits<double>::max(),
                                                      std::numeric_limits<double>::max()});
      const int n_ranks = static_cast<int>(Utilities::MPI::n_mpi_processes(communicator)),
                me      = static_cast<int>(Utilities::MPI::this_mpi_process(communicator)),
                next = (me + 1) % n_ranks, previous = (me + n_ranks - 1) % n_ranks;
      for (int piece = 0; piece < n_ranks; ++piece)
        {
          for (std::size_t k = 0; k < places.size(); ++k)
            for (const Place &other : others)
              closest[k] = std::min(closest[k],
                                    {position(places[k]).distance_square(position(other)),
                                     normal(places[k]) * normal(other)});
          const int n          = static_cast<int>(2 * dim * others.size());
          int       n_received = 0;
          MPI_Sendrecv(&n,
                       1,
                       MPI_INT,
                       next,
                       0,
                       &n_received,
                       1,
                       MPI_INT,
                       previous,
                       0,
                       communicator,
                       MPI_STATUS_IGNORE);
          std::vector<Place> received(n_received / (2 * dim));
          MPI_Sendrecv(others.data(),
                       n,
                       MPI_DOUBLE,
                       next,
                       1,
                       received.data(),
                       n_received,
                       MPI_DOUBLE,
                       previous,
                       1,
                       communicator,
                       MPI_STATUS_IGNORE);
          others.swap(received);
        }
      return std::any_of(closest.begin(), closest.end(), [](const auto &one) {
        return one.second < Tolerances::perpendicular_cosine;
      });
    }



    /** Of the positions in @p places that lie within a body the largest distance to the closest of
     * the @p others whose normal opposes theirs, both of all ranks; length. Zero if no position
     * lies within the body. Collective. */
    double
    deepest(const std::vector<Place> &places,
            const std::vector<Place> &others,
            const Solid              &solid,
            const unsigned int        body,
            const Vector             &u)
    {
      std::vector<Point<dim>> positions;
      for (const Place &place : places)
        positions.push_back(position(place));
      const std::vector<bool> within = lie_within(positions, solid, body, u);
      // Where bodies are as they should be these are none, or few.
      std::vector<Place> inside;
      for (std::size_t k = 0; k < places.size(); ++k)
        if (within[k])
          inside.push_back(places[k]);
      inside = gather_all(inside, solid.communicator);
      if (inside.empty())
        return 0.;
      std::vector<double> closest(inside.size(), std::numeric_limits<double>::max());
      for (std::size_t k = 0; k < inside.size(); ++k)
        for (const Place &other : others)
          // Only surfaces that oppose each other: the other side of a thin body may be closer.
          if (normal(inside[k]) * normal(other) < -Tolerances::perpendicular_cosine)
            closest[k] = std::min(closest[k], position(inside[k]).distance(position(other)));
      Utilities::MPI::min(closest, solid.communicator, closest);
      double result = 0.;
      for (const double distance : closest)
        // Without any opposed surface the depth cannot be measured.
        if (distance < std::numeric_limits<double>::max())
          result = std::max(result, distance);
      return result;
    }
  } // namespace



  StartCheck::StartCheck(const Solid                   &solid,
                         const ContactPairParameters   &parameters,
                         const Surface                 &slave,
                         const Surface                 *master,
                         const unsigned int             slave_body,
                         const unsigned int             master_body,
                         const Vector                  &u,
                         const std::vector<ContactRow> &rows)
    : solid(solid)
    , parameters(parameters)
    , slave(slave)
    , master(master)
    , slave_body(slave_body)
    , master_body(master_body)
    , u(u)
    , rows(rows)
  {
  }



  bool
  StartCheck::nothing_found() const
  {
    unsigned int found = 0;
    for (const ContactRow &row : rows)
      // A partner on one rank suffices: then the surfaces are within reach of each other somewhere.
      found += row.has_partner;
    return Utilities::MPI::sum(found, solid.communicator) == 0;
  }



  double
  StartCheck::depth_of_overlap() const
  {
    // An obstacle has a distance everywhere, and in self-contact points near the surface always lie
    // within the body.
    if (master == nullptr || slave_body == master_body)
      return 0.;
    // Nodes with a partner have a row that resists the overlap. Only faces with a node without one
    // can be lost.
    std::set<Index> nodes;
    for (const ContactRow &row : rows)
      if (!row.has_partner && !row.between_nodes)
        nodes.insert(row.slave);
    std::vector<Place> alone, masters;
    for (const Face &face : slave.owned_faces())
      if (std::any_of(face.nodes.begin(),
                      face.nodes.begin() + face.n_nodes(),
                      [&](const Index node) { return nodes.count(node) > 0; }))
        alone.push_back(place_below(slave, face, u));
    if (Utilities::MPI::max(static_cast<int>(!alone.empty()), solid.communicator) == 0)
      return 0.;
    double depth = deepest(alone, own_places(*master, u), solid, master_body, u);
    // No centre of a slave face needs to lie within the master body, for instance if slave faces
    // are much larger than the master: then test master faces within the slave body.
    if (depth == 0. && nothing_found())
      {
        for (const Face &face : master->owned_faces())
          masters.push_back(place_below(*master, face, u));
        depth = deepest(masters, own_places(slave, u), solid, slave_body, u);
      }
    return depth;
  }



  std::string
  StartCheck::slave_boundaries() const
  {
    std::string names;
    for (const std::string &name : parameters.slave_boundaries)
      names += (names.empty() ? "" : ", ") + name;
    return names;
  }



  void
  StartCheck::throw_if_all_look_away(const bool looks_here, const std::string &what) const
  {
    if (Utilities::MPI::max(static_cast<int>(looks_here), solid.communicator) == 1)
      return;
    throw InputError(parameters.section(),
                     "Slave boundaries",
                     slave_boundaries(),
                     "every node of the slave boundaries faces away from " + what +
                       ": the bodies would pass through each other",
                     "name the boundaries of '" + parameters.slave_body +
                       "' that face it; or look with '--preview' whether both are where they "
                       "belong ('Move', and 'Scale' of files in other units)");
  }



  void
  StartCheck::check_facing() const
  {
    // Which parts of a body will meet is not known before they do, and what is tied to an obstacle
    // meets it nowhere else.
    if (parameters.of_one_body() || (master == nullptr && parameters.tied()))
      return;
    bool looks = false;
    if (master == nullptr)
      {
        for (const ContactRow &row : rows)
          // Normals of slave and obstacle must be opposed at one node at least.
          looks = looks || (row.has_partner && slave.normal(row.slave) * row.normal <
                                                 Tolerances::perpendicular_cosine);
        throw_if_all_look_away(looks, "the obstacle '" + parameters.obstacle + "'");
        return;
      }
    // All ranks take the same branches, since what decides is reduced over them: the calls below
    // are collective.
    const bool   nothing = nothing_found();
    const double asked   = parameters.search_distance;
    // With the default reach, which is at least the size of a face, and a partner found, the
    // surfaces face each other. A search distance set by the user may be less than the overlap.
    if (!nothing && asked == 0.)
      return;
    const double depth = depth_of_overlap();
    if (nothing && asked == 0. && depth > 0.)
      // The search reaches beyond this overlap (ContactPair::check_start()), but from no node.
      throw InputError(parameters.section(),
                       "Slave boundaries",
                       slave_boundaries(),
                       "the bodies overlap between slave nodes, none of which finds a master face: "
                       "the slave faces are larger than the master surface",
                       "exchange slave and master, refine the slave surface, or name the "
                       "boundaries that meet");
    if (nothing ? depth > 0. : depth > asked)
      throw InputError(parameters.section(),
                       "Search distance",
                       dealii::Patterns::Tools::to_string(parameters.search_distance),
                       nothing
                         ? "the bodies overlap, but no slave node finds a master face"
                         : "the bodies overlap by more, where slave nodes find no master face",
                       "set it to 0 or to more than the overlap, or name the boundaries that meet");
    if (!nothing)
      return;
    // Tied is what faces each other now; nothing would ever be.
    if (parameters.tied())
      throw InputError(parameters.section(),
                       "Behaviour",
                       parameters.behaviour.name,
                       "no slave node finds a master face, so nothing would be tied",
                       "name the boundaries that touch; 'Search distance' says across which gap "
                       "they may be tied");
    // No node is within reach, as with bodies that are brought together later. At least one slave
    // node must face the master node closest to it.
    throw_if_all_look_away(any_faces_closest(own_places(slave, u),
                                             own_places(*master, u),
                                             solid.communicator),
                           "the master boundaries of '" + parameters.master_body + "'");
  }
} // namespace Touchstone

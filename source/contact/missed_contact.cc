// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/contact/contact_pair.h>
#include <touchstone/contact/geometry/measured_face.h>
#include <touchstone/contact/missed_contact.h>
#include <touchstone/contact/overlap_order.h>
#include <touchstone/contact/pairing/sets_of_points.h>
#include <touchstone/contact/pressing_rows.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

// Contact that passes between the slave nodes: rows exist at these alone, and Newton's method finds
// nothing wrong with a state in which the bodies overlap elsewhere (doc/theory.md 4.1).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** How near a point is to one of its nodes: 1 there. Rounded off the multiples that the weights
     * of rounded coordinates are. */
    double
    concentration(const MaterialPoint &point)
    {
      double sum = 0.;
      for (unsigned int a = 0; a < point.n; ++a)
        sum += point.weights[a] * point.weights[a];
      constexpr double step = 1e-5, shift = 0.3183;
      return std::floor(sum / step + shift);
    }



    /** The part of an overlap in the reference state that does not count now. */
    double
    adjusted_part(const Contact                &contact,
                  const ContactPair            &pair,
                  const MissedContact::Overlaps which)
    {
      return which == MissedContact::Overlaps::as_placed ||
                 pair.parameters().initial_overlap == ContactPairParameters::Overlap::interference
               ? 0.
               : pair.part_of_overlap(contact.time());
    }
  } // namespace



  MissedContact::MissedContact(const Contact     &contact,
                               const ContactPair &pair,
                               const Vector      &forces,
                               const Overlaps     which)
    : contact(contact)
    , pair(pair)
    , forces(forces)
    , part_adjusted(adjusted_part(contact, pair, which))
    , by_reference(which == Overlaps::as_paired)
  {
    for (std::size_t k = 0; k < pair.rows().size(); ++k)
      adjusted = std::max(adjusted, -pair.overlap(k));
    adjusted = part_adjusted * Utilities::MPI::max(adjusted, contact.communicator());
  }



  bool
  MissedContact::carries_nothing() const
  {
    // Forces on hanging nodes are on those that they follow, so owned nodes have all of the force.
    int carries = 0;
    for (const SurfaceNode &node : pair.slave().owned_nodes())
      for (unsigned int d = 0; d < dim; ++d)
        carries = std::max(carries, static_cast<int>(forces(dim * node.node + d) != 0.));
    return Utilities::MPI::max(carries, contact.communicator()) == 0;
  }



  bool
  MissedContact::carries_nothing(const Face &face) const
  {
    // A hanging node has no row; the force is on the nodes that it follows.
    const TraceBasis *basis = pair.slave().trace(face);
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      for (unsigned int d = 0; d < dim; ++d)
        if (forces(dim * (basis ? basis->nodes[m] : face.nodes[m]) + d) != 0.)
          return false;
    return true;
  }



  Face
  MissedContact::placed(const Face &face) const
  {
    Face result = MeasuredFace::displaced(face, contact.ghosted_displacement());
    if (by_reference)
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        {
          result.committed[m]    = -result.displacement[m];
          result.displacement[m] = Tensor<1, dim>();
        }
    return result;
  }



  std::vector<MissedContact::Overlap>
  MissedContact::deepest_first(const std::vector<Overlap> &found) const
  {
    std::vector<Overlap> all = gather_all(found, contact.communicator());
    sort_by_depth(all, [](const Overlap &overlap) { return overlap.place; });
    return all;
  }



  std::vector<MissedContact::Overlap>
  MissedContact::overlaps(const bool idle) const
  {
    std::vector<Face> slaves;
    for (const Face &face : pair.slave().owned_faces())
      if (carries_nothing(face) == idle)
        slaves.push_back(placed(face));
    return deepest_first(pair.master() ? within_faces(slaves, master_faces(slaves))
                                       : obstacle_within(slaves));
  }



  std::vector<MissedContact::Overlap>
  MissedContact::missed() const
  {
    // Where a node or a point of the face carries a force, its row resists the overlap already.
    std::vector<Overlap> result = overlaps(/*idle=*/true);
    // Pairings may measure gaps to other surfaces than facets: the row of a point there knows.
    for (const MaterialPoint &point : open_points())
      result.erase(std::remove_if(result.begin(),
                                  result.end(),
                                  [&](const Overlap &overlap) {
                                    return goes_on_from(point, overlap.deepest);
                                  }),
                   result.end());
    return result;
  }



  std::vector<MaterialPoint>
  MissedContact::open_points() const
  {
    if (!pair.takes_points() || pair.points().empty())
      return {};
    std::map<Index, const ContactRow *> rows;
    for (const ContactRow &row : pair.rows())
      if (row.between_nodes && row.has_partner)
        rows[row.slave] = &row;
    std::vector<MaterialPoint> mine;
    for (const MaterialPoint &point : pair.points())
      if (const auto found = rows.find(point.nodes[point.slave]); found != rows.end())
        // Farther away it is another side that the point faces.
        if (const double gap = found->second->gap / found->second->share;
            gap >= 0. && gap < Tolerances::deep_smooth_node * found->second->size)
          mine.push_back(point);
    return gather_all(mine, contact.communicator());
  }



  MissedContact::Place
  MissedContact::first_of(const std::vector<Place> &places)
  {
    Place result;
    if (!places.empty())
      result = places.front();
    result.area = 0.;
    for (const Place &place : places)
      result.area += place.area;
    return result;
  }



  std::vector<MissedContact::Place>
  MissedContact::beside_nodes() const
  {
    std::vector<Place> places;
    for (const Overlap &overlap : overlaps(/*idle=*/false))
      // An obstacle behind the face does not touch it.
      if (overlap.place.area > 0. && (pair.master() || !overlap.in_doubt))
        places.push_back(overlap.place);
    return places;
  }



  MissedContact::Place
  MissedContact::deepest() const
  {
    std::vector<Place> places;
    for (const Overlap &overlap : missed())
      places.push_back(overlap.place);
    return first_of(places);
  }



  double
  MissedContact::share(const Place &place) const
  {
    if (carries_nothing())
      return 1.;
    double             carrying = 0.;
    const PressingRows pressing(contact);
    for (const ContactRow &row : pair.rows())
      if (pressing.contain(row))
        carrying += row.area;
    carrying = Utilities::MPI::sum(carrying, contact.communicator());
    // Rows of points have no area.
    return place.area > 0. ? place.area / (place.area + carrying) : 0.;
  }



  bool
  MissedContact::deep(const Place &place)
  {
    return place.depth > Tolerances::deep_smooth_node * place.size;
  }



  std::vector<MaterialPoint>
  MissedContact::points() const
  {
    std::vector<Overlap> found = missed();
    // The first ones choose their nodes first. By the depth at the points, not by the deepest that
    // a search has found of each face. Of equally deep ones, as under a straight ridge, those that
    // are nearest to a node have the least choice; their place, which has no meaning, comes last.
    double deepest = 0.;
    for (const Overlap &overlap : found)
      deepest = std::max(deepest, overlap.point.depth);
    const auto order = [deepest](const Overlap &overlap) {
      const MaterialPoint &point  = overlap.point;
      const auto [depth, x, y, z] = overlap_order(point.depth, overlap.at_point, deepest);
      return std::make_tuple(depth, -concentration(point), x, y, z);
    };
    std::sort(found.begin(), found.end(), [&](const Overlap &a, const Overlap &b) {
      return order(a) < order(b);
    });
    std::vector<MaterialPoint> result;
    for (const Overlap &overlap : found)
      // An obstacle behind a face is no overlap of the surface.
      if (overlap.point.n > 0)
        result.push_back(overlap.point);
    return result;
  }
} // namespace Touchstone

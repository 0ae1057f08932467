// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/contact/contact_pair.h>
#include <touchstone/contact/geometry/deformed_cells.h>
#include <touchstone/contact/geometry/face_area.h>
#include <touchstone/contact/geometry/measured_face.h>
#include <touchstone/contact/missed_contact.h>
#include <touchstone/contact/overlap_order.h>
#include <touchstone/contact/search/self_contact.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/mpi.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <map>

// Contact that passes between the slave nodes: rows exist at these alone, and Newton's method finds
// nothing wrong with a state in which the bodies overlap elsewhere (doc/theory.md 4.1).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    using Box = BoundingBox<dim>;
    using Xi  = MeasuredFace::Xi;
  } // namespace



  MissedContact::MissedContact(const Contact     &contact,
                               const ContactPair &pair,
                               const Vector      &forces)
    : contact(contact)
    , pair(pair)
    , forces(forces)
  {
    for (std::size_t k = 0; k < pair.rows().size(); ++k)
      adjusted = std::max(adjusted, -pair.overlap(k));
    adjusted = part_adjusted() * Utilities::MPI::max(adjusted, contact.communicator());
    find_planes_of_symmetry();
  }



  void
  MissedContact::find_planes_of_symmetry()
  {
    const MPI_Comm communicator = contact.communicator();
    if (Utilities::MPI::max(contact.planes_of_symmetry().size(), communicator) == 0)
      return;
    // A node may lie on two, and with a third one no normal is left.
    for (unsigned int k = 0; k < 2; ++k)
      {
        Vector normals(contact.solid_model().owned, communicator);
        for (const auto &[node, planes] : contact.planes_of_symmetry())
          if (planes.size() > k)
            {
              // Orthogonal to each other.
              Tensor<1, dim> normal = planes[k];
              if (k > 0)
                normal -= (normal * planes[0]) * planes[0];
              if (const double length = normal.norm(); length > Tolerances::perpendicular_cosine)
                for (unsigned int d = 0; d < dim; ++d)
                  normals(dim * node + d) = normal[d] / length;
            }
        normals.compress(VectorOperation::insert);
        planes_of_nodes.push_back(contact.with_ghosts(normals));
      }
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



  double
  MissedContact::part_adjusted() const
  {
    return pair.parameters().initial_overlap == ContactPairParameters::Overlap::interference
             ? 0.
             : pair.part_of_overlap(contact.time());
  }



  Face
  MissedContact::present(const Face &face) const
  {
    Face result = face;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      {
        for (unsigned int d = 0; d < dim; ++d)
          result.displacement[m][d] = contact.ghosted_displacement()(dim * face.nodes[m] + d);
        // Averaged with the faces beyond a plane of symmetry normals lie in it. Otherwise facets
        // beside it would seem to have half of their arc.
        Tensor<1, dim> normal = result.normals[m];
        for (const Vector &planes : planes_of_nodes)
          {
            Tensor<1, dim> plane;
            for (unsigned int d = 0; d < dim; ++d)
              plane[d] = planes(dim * face.nodes[m] + d);
            normal -= (normal * plane) * plane;
          }
        if (const double length = normal.norm(); length > Tolerances::perpendicular_cosine)
          result.normals[m] = normal / length;
      }
    return result;
  }



  std::vector<Face>
  MissedContact::master_faces(const std::vector<Face> &slaves) const
  {
    Box own;
    for (std::size_t k = 0; k < slaves.size(); ++k)
      if (const Box box =
            MeasuredFace::box_around(slaves[k], MeasuredFace(slaves[k], nullptr).size());
          k == 0)
        own = box;
      else
        own.merge_with(box);
    const MPI_Comm         communicator = contact.communicator();
    const std::vector<Box> boxes        = Utilities::MPI::all_gather(communicator, own);
    const std::vector<int> any =
      Utilities::MPI::all_gather(communicator, static_cast<int>(!slaves.empty()));
    std::map<unsigned int, std::vector<Face>> messages;
    for (const Face &face : pair.master()->owned_faces())
      {
        // Of one body a face that carries may be slave and master: its rows resist as well.
        if (pair.parameters().of_one_body() && !carries_nothing(face))
          continue;
        const Face now = present(face);
        const Box  box = MeasuredFace::box_around(now, 0.);
        for (unsigned int rank = 0; rank < boxes.size(); ++rank)
          if (any[rank] && boxes[rank].get_neighbor_type(box) != NeighborType::not_neighbors)
            messages[rank].push_back(now);
      }
    std::vector<Face> result;
    for (const auto &[rank, faces] : exchange_records(messages, communicator))
      result.insert(result.end(), faces.begin(), faces.end());
    return result;
  }



  void
  MissedContact::add_points(const MeasuredFace  &of,
                            const MeasuredFace  &in,
                            const Face          &slave,
                            Overlap             &worst,
                            std::vector<Sample> &samples) const
  {
    const double size  = worst.place.size,
                 least = Tolerances::touching * size + of.sagitta() + in.sagitta();
    for (const double a : MeasuredFace::samples)
      for (const double b : MeasuredFace::samples)
        {
          const Xi        xi    = {{a, b}};
          const FacePoint point = evaluate(of.face, of.exact, xi);
          if (!in.meets(point.normal()))
            continue;
          Xi         foot;
          const auto depth = in.depth(point.x, least, foot);
          // Deeper points belong to another side of the body, or contact_checks finds the bodies
          // within each other.
          if (!depth || *depth > size)
            continue;
          if (pair.parameters().of_one_body())
            {
              const FacePoint there = evaluate(MeasuredFace::in_reference(in.face), in.exact, foot);
              if (SelfContact::through_body(
                    evaluate(MeasuredFace::in_reference(of.face), of.exact, xi).x,
                    there.x,
                    there.normal(),
                    *depth))
                continue;
            }
          double counts = *depth;
          if (const double part = part_adjusted(); part > 0.)
            {
              const Face before = MeasuredFace::in_reference(of.face),
                         there  = MeasuredFace::in_reference(in.face);
              Xi unused;
              // None if the point has slid here from another face: then what rows have at most.
              const auto start =
                MeasuredFace(there, in.exact).depth(evaluate(before, of.exact, xi).x, 0., unused);
              const double taken_out = std::max(adjusted, part * start.value_or(0.));
              counts -= taken_out;
              // The gap of a row there would have to be less by it, too. Round-off of surfaces that
              // touch is no overlap.
              if (taken_out > Tolerances::touches_at_start * size)
                worst.adjusted = true;
            }
          // Facets of curved surfaces may be off by as much: told of, but no measure of the area.
          const double sure = Tolerances::touching * size + of.facet_error() + in.facet_error();
          const double area = counts > sure ? face_area(slave) : worst.place.area;
          if (counts > least)
            samples.push_back({&of.face == &slave ? xi : foot, counts - least});
          if (counts > std::max(least, worst.place.depth))
            worst = {{counts, point.x, size, area},
                     in.face.body,
                     point.x + in.to_straight_edges(foot),
                     true,
                     worst.adjusted,
                     &of.face == &slave ? xi : foot,
                     {}};
        }
  }



  // Of equally deep samples, as along a ridge, round-off must not choose one. This power leaves
  // hardly more than the deepest, and is as smooth a function of the state as the depths. Those
  // that are half as deep do not count at all: whether they lie within the body can be in doubt.
  MeasuredFace::Xi
  MissedContact::middle(const std::vector<Sample> &samples)
  {
    double deepest = 0.;
    for (const Sample &sample : samples)
      deepest = std::max(deepest, sample.depth);
    Xi     result{};
    double sum = 0.;
    for (const Sample &sample : samples)
      {
        const double weight = std::pow(std::max(0., 2. * sample.depth / deepest - 1.), 4);
        sum += weight;
        for (unsigned int a = 0; a < 2; ++a)
          result[a] += weight * sample.xi[a];
      }
    for (double &value : result)
      value = std::clamp(value / sum, -1., 1.);
    return result;
  }



  MeasuredFace::Xi
  MissedContact::rounded(Xi xi)
  {
    // Before it touches anything a body is as exact as a solver leaves what is nearly no force.
    constexpr double step = 1e-3;
    for (double &value : xi)
      value = step * std::round(value / step);
    return xi;
  }



  std::vector<MissedContact::Overlap>
  MissedContact::within_faces(const std::vector<Face> &slaves,
                              const std::vector<Face> &masters) const
  {
    std::vector<std::pair<Box, std::size_t>> boxes;
    for (std::size_t i = 0; i < masters.size(); ++i)
      boxes.emplace_back(MeasuredFace::box_around(masters[i], 0.), i);
    const auto tree = pack_rtree(boxes);
    // Of each two faces: that a point is behind a face does not say that it lies within the body,
    // and what does not must not hide what does.
    std::vector<Overlap>             found;
    std::vector<std::vector<Sample>> of_found;
    for (const Face &face : slaves)
      {
        const MeasuredFace slave(face, pair.slave().exact_surface(face));
        const Box          box = MeasuredFace::box_around(face, slave.size());
        namespace query        = boost::geometry::index;
        for (const auto &entry : tree | query::adaptors::queried(query::intersects(box)))
          {
            const Face &other = masters[entry.second];
            if (pair.parameters().of_one_body() && SelfContact::share_node(face, other))
              continue;
            const AnalyticSurface *const exact = pair.master()->exact_surface(other);
            // The normal case: most faces only face each other.
            if (exact == nullptr && slave.clear_of(other, Tolerances::touching * slave.size()))
              continue;
            const MeasuredFace  master(other, exact);
            Overlap             worst;
            std::vector<Sample> samples;
            worst.place.size = slave.size();
            // Both ways: a ridge between master nodes has none of them within.
            add_points(master, slave, face, worst, samples);
            add_points(slave, master, face, worst, samples);
            if (worst.place.depth > 0.)
              {
                found.push_back(worst);
                found.back().point.face = face.key;
                of_found.push_back(samples);
              }
          }
      }
    const std::vector<bool> inside = lie_within_bodies(found);
    std::vector<Overlap>    result;
    std::size_t             k = 0;
    for (const Face &face : slaves)
      {
        Overlap             worst;
        std::vector<Sample> samples;
        bool                some_adjusted = false;
        for (; k < found.size() && found[k].point.face == face.key; ++k)
          if (inside[k])
            {
              samples.insert(samples.end(), of_found[k].begin(), of_found[k].end());
              const double area = std::max(worst.place.area, found[k].place.area);
              some_adjusted     = some_adjusted || found[k].adjusted;
              if (found[k].place.depth > worst.place.depth)
                worst = found[k];
              worst.place.area = area;
            }
        if (worst.place.depth == 0.)
          continue;
        if (!some_adjusted)
          worst.point = MaterialPoint(face, pair.slave().trace(face), rounded(middle(samples)));
        worst.point.face = face.key;
        result.push_back(worst);
      }
    return result;
  }



  std::vector<bool>
  MissedContact::lie_within_bodies(const std::vector<Overlap> &found) const
  {
    const MPI_Comm communicator = contact.communicator();
    // Nothing on any rank, the normal case: no cells need be gathered in trees.
    if (Utilities::MPI::max(found.size(), communicator) == 0)
      return {};
    // The cells around a point may belong to any rank.
    std::vector<Overlap> all;
    std::size_t          first = 0;
    const auto           parts = gather_records(found, communicator);
    for (std::size_t rank = 0; rank < parts.size(); ++rank)
      {
        if (rank == Utilities::MPI::this_mpi_process(communicator))
          first = all.size();
        all.insert(all.end(), parts[rank].begin(), parts[rank].end());
      }
    std::map<unsigned int, DeformedCells> cells;
    for (const Overlap &overlap : all)
      cells.try_emplace(overlap.body,
                        contact.solid_model(),
                        overlap.body,
                        contact.ghosted_displacement());
    std::vector<int> inside;
    for (const Overlap &overlap : all)
      inside.push_back(!overlap.in_doubt || cells.at(overlap.body).contain(overlap.inside));
    Utilities::MPI::max(inside, communicator, inside);
    const auto mine = inside.begin() + first;
    return {mine, mine + found.size()};
  }



  std::vector<MissedContact::Overlap>
  MissedContact::deepest_first(const std::vector<Overlap> &found) const
  {
    std::vector<Overlap> all;
    for (const auto &part : gather_records(found, contact.communicator()))
      all.insert(all.end(), part.begin(), part.end());
    double deepest = 0.;
    for (const Overlap &overlap : all)
      deepest = std::max(deepest, overlap.place.depth);
    std::sort(all.begin(), all.end(), [deepest](const Overlap &a, const Overlap &b) {
      return overlap_order(a.place.depth, a.place.x, deepest) <
             overlap_order(b.place.depth, b.place.x, deepest);
    });
    return all;
  }



  std::vector<MissedContact::Overlap>
  MissedContact::overlaps() const
  {
    std::vector<Face> slaves;
    for (const Face &face : pair.slave().owned_faces())
      // Where a node or a point of the face carries a force, its row resists the overlap already.
      if (carries_nothing(face))
        slaves.push_back(present(face));
    std::vector<Overlap> result = deepest_first(
      pair.master() ? within_faces(slaves, master_faces(slaves)) : obstacle_within(slaves));
    // Pairings may measure gaps to other surfaces than facets: the row of a point there knows.
    for (const MaterialPoint &point : open_points())
      result.erase(std::remove_if(result.begin(),
                                  result.end(),
                                  [&](const Overlap &overlap) {
                                    // Nearer to each other than to the next sample.
                                    return overlap.point.face == point.face &&
                                           std::hypot(overlap.deepest[0] - point.xi[0],
                                                      overlap.deepest[1] - point.xi[1]) < 0.25;
                                  }),
                   result.end());
    return result;
  }



  std::vector<MaterialPoint>
  MissedContact::open_points() const
  {
    std::vector<MaterialPoint> result;
    if (!pair.takes_points() || pair.points().empty())
      return result;
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
    for (const auto &of_rank : gather_records(mine, contact.communicator()))
      result.insert(result.end(), of_rank.begin(), of_rank.end());
    return result;
  }



  MissedContact::Place
  MissedContact::deepest() const
  {
    Place result;
    for (const Overlap &overlap : overlaps())
      {
        const double area = result.area + overlap.place.area;
        if (result.depth == 0.)
          result = overlap.place;
        result.area = area;
      }
    return result;
  }



  double
  MissedContact::share(const Place &place) const
  {
    if (carries_nothing())
      return 1.;
    double carrying = 0.;
    for (const ContactRow &row : pair.rows())
      if (const RowState &state = contact.state(row); state.active() && state.lambda > 0.)
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
    std::vector<MaterialPoint> result;
    for (const Overlap &overlap : overlaps())
      // An obstacle behind a face is no overlap of the surface.
      if (overlap.point.n > 0)
        {
          result.push_back(overlap.point);
          result.back().depth = overlap.place.depth;
        }
    return result;
  }
} // namespace Touchstone

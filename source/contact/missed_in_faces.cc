// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/base/near_ranks.h>
#include <touchstone/contact/contact_pair.h>
#include <touchstone/contact/entered_faces.h>
#include <touchstone/contact/geometry/deformed_cells.h>
#include <touchstone/contact/geometry/face_area.h>
#include <touchstone/contact/geometry/sampled_face.h>
#include <touchstone/contact/missed_contact.h>
#include <touchstone/contact/overlap_order.h>
#include <touchstone/contact/search/self_contact.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/mpi.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

// Where the slave and master faces of a pair lie within each other: points of each in the other
// (doc/theory.md 4.1). For obstacles see missed_obstacle.cc.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    using Box = BoundingBox<dim>;
    using Xi  = MeasuredFace::Xi;

    /** How far a point of a face has moved in the step. */
    Tensor<1, dim>
    moved(const Face &face, const Xi &xi)
    {
      const FaceShapes shapes(face.degree, xi);
      Tensor<1, dim>   result;
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        result += shapes.value[m] * (face.displacement[m] - face.committed[m]);
      return result;
    }

    /** Whether a point of one face is on the other side of the same body for another face.
     * @param cosine Of the angle between their normals at present. */
    bool
    through_body(const MeasuredFace &of,
                 const Xi           &xi,
                 const MeasuredFace &in,
                 const Xi           &foot,
                 const double        depth,
                 const double        cosine)
    {
      const Point<dim> x     = evaluate(MeasuredFace::in_reference(of.face), of.exact, xi).x;
      const FacePoint  there = evaluate(MeasuredFace::in_reference(in.face), in.exact, foot);
      return SelfContact::through_body(x, there.x, there.normal(), depth) &&
             !SelfContact::made_to_overlap(x, there.x, there.normal(), in.face, cosine);
    }
  } // namespace



  std::vector<Face>
  MissedContact::master_faces(const std::vector<Face> &slaves) const
  {
    const MPI_Comm            communicator = contact.communicator();
    std::vector<Box>          around_slaves, boxes;
    std::vector<const Face *> masters;
    for (const Face &slave : slaves)
      around_slaves.push_back(MeasuredFace::box_around(slave, MeasuredFace(slave, nullptr).size()));
    for (const Face &face : pair.master()->owned_faces())
      // Of one body a face that carries may be slave and master: its rows resist as well.
      if (!pair.parameters().of_one_body() || carries_nothing(face))
        {
          masters.push_back(&face);
          boxes.push_back(MeasuredFace::box_around(placed(face), 0.));
        }
    std::map<unsigned int, std::vector<Face>> messages;
    const auto ranks = near_ranks(around_slaves, boxes, communicator);
    for (std::size_t f = 0; f < masters.size(); ++f)
      for (const unsigned int rank : ranks[f])
        messages[rank].push_back(placed(*masters[f]));
    // Faces are large: no more copies than necessary.
    auto received = exchange_records(messages, communicator);
    messages.clear();
    std::vector<Face> result;
    for (auto &[rank, faces] : received)
      if (result.empty())
        result.swap(faces);
      else
        result.insert(result.end(), faces.begin(), faces.end());
    return result;
  }



  void
  MissedContact::add_points(const SampledFace   &of,
                            const SampledFace   &in,
                            const Face          &slave,
                            Overlap             &worst,
                            std::vector<Sample> &samples) const
  {
    const double size  = worst.place.size,
                 least = Tolerances::touching * size + of.sagitta() + in.sagitta();
    for (const SampledFace::Sample &point : of.points())
      {
        // Deeper points belong to another side of the body, or contact_checks finds the bodies
        // within each other.
        if (!in.meets(point.normal) || in.beside(point.x, size))
          continue;
        Xi         foot;
        const auto behind = in.depth(point.x, by_reference ? -size : least, foot);
        if (!behind || *behind > size)
          continue;
        const FacePoint at_foot = evaluate(in.face, in.exact, foot);
        // Since the reference state, in which the two have been paired.
        Tensor<1, dim> motion;
        double         depth = *behind;
        if (by_reference)
          {
            motion = moved(of.face, point.xi);
            depth += (moved(in.face, foot) - motion) * at_foot.normal();
            if (depth < least || depth > size)
              continue;
          }
        if (pair.parameters().of_one_body() &&
            through_body(of, point.xi, in, foot, depth, point.normal * at_foot.normal()))
          continue;
        double counts = depth;
        if (part_adjusted > 0.)
          {
            const Face before = MeasuredFace::in_reference(of.face),
                       there  = MeasuredFace::in_reference(in.face);
            Xi unused;
            // None if the point has slid here from another face: then what rows have at most.
            const auto start = MeasuredFace(there, in.exact)
                                 .depth(evaluate(before, of.exact, point.xi).x, 0., unused);
            const double taken_out = std::max(adjusted, part_adjusted * start.value_or(0.));
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
          samples.push_back({&of.face == &slave ? point.xi : foot, counts - least});
        // Of samples that are equally deep, as along a ridge, the first: not what round-off
        // chooses.
        constexpr double deeper = 1. + 1e-6;
        if (counts <= std::max(least, deeper * worst.place.depth))
          continue;
        worst          = {{counts, point.x + motion, size, area},
                          in.face.body,
                          point.x + in.to_straight_edges(foot),
                          at_foot.normal(),
                          // What has been paired at a distance is not the other side of a body.
                          !by_reference || *behind > Tolerances::touching * size,
                          worst.adjusted,
                          MaterialPoint(slave,
                               pair.slave().trace(slave),
                               &of.face == &slave ? point.xi : foot),
                          {}};
        worst.found_at = point.x;
        worst.behind   = by_reference ? *behind : counts;
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
    // Each is near several slave faces that follow each other. More would take memory beside the
    // preconditioner.
    constexpr std::size_t              most_sampled = 1000;
    std::map<std::size_t, SampledFace> sampled;
    // Of each two faces: that a point is behind a face does not say that it lies within the body,
    // and what does not must not hide what does.
    std::vector<Overlap>             found;
    std::vector<std::vector<Sample>> of_found;
    for (const Face &face : slaves)
      {
        const SampledFace slave(face, pair.slave().exact_surface(face));
        const Box         box = MeasuredFace::box_around(face, slave.size());
        namespace query       = boost::geometry::index;
        for (const auto &entry : tree | query::adaptors::queried(query::intersects(box)))
          {
            const Face &other = masters[entry.second];
            if (pair.parameters().of_one_body() && SelfContact::share_node(face, other))
              continue;
            const AnalyticSurface *const exact = pair.master()->exact_surface(other);
            // The normal case: most faces only face each other.
            if (!by_reference && exact == nullptr &&
                slave.clear_of(other, Tolerances::touching * slave.size()))
              continue;
            if (sampled.size() >= most_sampled)
              sampled.clear();
            const SampledFace &master =
              sampled.try_emplace(entry.second, other, exact).first->second;
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
    std::vector<bool> inside = lie_within_bodies(found);
    for (const unsigned int body : std::set<unsigned int>{pair.slave_body(), pair.master_body()})
      remove_entered_elsewhere(found, body, inside);
    std::vector<Overlap> result;
    std::size_t          k = 0;
    for (const Face &face : slaves)
      {
        std::vector<Overlap> of_face;
        std::vector<Sample>  samples;
        double               area          = 0.;
        bool                 some_adjusted = false;
        for (; k < found.size() && found[k].point.face == face.key; ++k)
          if (inside[k])
            {
              of_face.push_back(found[k]);
              samples.insert(samples.end(), of_found[k].begin(), of_found[k].end());
              area          = std::max(area, found[k].place.area);
              some_adjusted = some_adjusted || found[k].adjusted;
            }
        if (of_face.empty())
          continue;
        // In which order master faces were found, or round-off, must not choose among equals.
        sort_by_depth(of_face, [](const Overlap &overlap) { return overlap.place; });
        Overlap &worst   = of_face.front();
        worst.place.area = area;
        if (!some_adjusted)
          worst.point = MaterialPoint(face, pair.slave().trace(face), rounded(middle(samples)));
        worst.point.face  = face.key;
        worst.point.depth = worst.place.depth;
        worst.at_point    = evaluate(face, pair.slave().exact_surface(face), worst.point.xi).x;
        result.push_back(worst);
      }
    return result;
  }



  Vector
  MissedContact::searched_displacement() const
  {
    return by_reference ? contact.with_ghosts(contact.solid_model().zero_vector())
                        : contact.ghosted_displacement();
  }



  void
  MissedContact::remove_entered_elsewhere(const std::vector<Overlap> &found,
                                          const unsigned int          body,
                                          std::vector<bool>          &inside) const
  {
    // Of one body either surface has faces that the other one lacks.
    if (pair.parameters().of_one_body())
      return;
    std::vector<std::size_t>     numbers;
    std::vector<PointBehindFace> points;
    for (std::size_t k = 0; k < found.size(); ++k)
      if (inside[k] && found[k].body == body && found[k].in_doubt)
        {
          numbers.push_back(k);
          points.push_back({found[k].found_at, found[k].normal, found[k].behind});
        }
    const std::vector<bool> through = have_come_through(
      points,
      body == pair.slave_body() ? pair.slave() : *pair.master(),
      searched_displacement(),
      [&](const Face &face) { return body == pair.slave_body() && !carries_nothing(face); },
      contact.communicator());
    for (std::size_t k = 0; k < numbers.size(); ++k)
      inside[numbers[k]] = through[k];
  }



  std::vector<bool>
  MissedContact::lie_within_bodies(const std::vector<Overlap> &found) const
  {
    // Where it is not in doubt bodies are not looked for.
    std::vector<bool>                                result(found.size(), true);
    std::map<unsigned int, std::vector<std::size_t>> of_body;
    for (std::size_t k = 0; k < found.size(); ++k)
      if (found[k].in_doubt)
        of_body[found[k].body].push_back(k);
    for (const unsigned int body : std::set<unsigned int>{pair.slave_body(), pair.master_body()})
      {
        const std::vector<std::size_t> &numbers = of_body[body];
        std::vector<Point<dim>>         points;
        for (const std::size_t k : numbers)
          points.push_back(found[k].inside);
        const std::vector<bool> inside =
          lie_within(points, contact.solid_model(), body, searched_displacement());
        for (std::size_t k = 0; k < numbers.size(); ++k)
          result[numbers[k]] = inside[k];
      }
    return result;
  }
} // namespace Touchstone

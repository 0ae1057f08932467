#include <touchstone/contact/search/facing_faces.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace Touchstone
{
  using namespace dealii;

  std::vector<const Face *>
  masters_of(const std::vector<FacingFace> &facing)
  {
    std::vector<const Face *> result;
    for (const FacingFace &face : facing)
      result.push_back(face.master);
    return result;
  }



  namespace
  {
    /** What moves less than this part of a face against another does not pass
     * through a body, and what is closer touches. */
    constexpr double small_motion = 0.1, touching = 1e-3;

    /** A face lies behind another if that covers this part of it, and not beside it. */
    constexpr double behind = 0.1;

    BoundingBox<dim>
    box(const Face &face)
    {
      BoundingBox<dim> result({face.position(0), face.position(0)});
      for (unsigned int m = 1; m < face.n_nodes(); ++m)
        result.merge_with(BoundingBox<dim>({face.position(m), face.position(m)}));
      return result;
    }

    double
    area(const Face &face)
    {
      static const QGauss<2> quadrature(3);
      double                 sum = 0.;
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        {
          const Point<2>  p = quadrature.point(q);
          const FacePoint x = evaluate(face, nullptr, {{2. * p[0] - 1., 2. * p[1] - 1.}});
          sum += 4. * quadrature.weight(q) * cross_product_3d(x.tangents[0], x.tangents[1]).norm();
        }
      return sum;
    }

    double
    area(const std::vector<OverlapPoint> &points)
    {
      return std::accumulate(points.begin(),
                             points.end(),
                             0.,
                             [](const double sum, const OverlapPoint &p) {
                               return sum + p.weight;
                             });
    }

    Tensor<1, dim>
    mean_motion(const Face &face)
    {
      Tensor<1, dim> sum;
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        sum += face.displacement[m] - face.committed[m];
      return sum / face.n_nodes();
    }

    /** The integral of the gap between the facets; negative where they overlap. */
    double
    gap(const Face &slave, const Tensor<1, dim> &normal, const FacingFace &facing)
    {
      double sum = 0.;
      for (const OverlapPoint &p : facing.points)
        sum +=
          p.weight *
          ((evaluate(*facing.master, nullptr, p.master).x - evaluate(slave, nullptr, p.slave).x) *
           normal);
      return sum;
    }

    std::vector<FacingFace>
    cover(const Face &slave, const std::vector<const Face *> &masters)
    {
      std::vector<FacingFace> result;
      auto                    points = overlap(slave, masters);
      for (std::size_t f = 0; f < masters.size(); ++f)
        if (!points[f].empty())
          result.push_back({masters[f], std::move(points[f])});
      return result;
    }

    /** Search::layers() by face. */
    std::map<const Face *, unsigned int>
    layers(const Search &search, const std::vector<const Face *> &faces)
    {
      const std::vector<unsigned int>      numbers = search.layers(faces);
      std::map<const Face *, unsigned int> result;
      for (std::size_t i = 0; i < faces.size(); ++i)
        result[faces[i]] = numbers[i];
      return result;
    }

    /** The box around the way that @p slave has come, seen from what covers it. */
    BoundingBox<dim>
    way(const Face &slave, const std::vector<FacingFace> &covering)
    {
      Tensor<1, dim> motion = mean_motion(slave);
      for (const FacingFace &facing : covering)
        motion -= mean_motion(*facing.master) / static_cast<double>(covering.size());
      BoundingBox<dim> result = box(slave);
      const auto      &ends   = result.get_boundary_points();
      result.merge_with(BoundingBox<dim>({ends.first - motion, ends.second - motion}));
      return result;
    }

    /** Whether @p faces hang together. */
    bool
    one_layer(const Search &search, const std::vector<const Face *> &faces)
    {
      const std::vector<unsigned int> numbers = search.layers(faces);
      return std::adjacent_find(numbers.begin(), numbers.end(), std::not_equal_to<>()) ==
             numbers.end();
    }

    /** Whether @p facing hang together over the nodes of @p faces. */
    bool
    one_layer(const Search                    &search,
              const std::vector<FacingFace>   &facing,
              const std::vector<const Face *> &faces)
    {
      if (facing.size() < 2)
        return true;
      const std::map<const Face *, unsigned int> number = layers(search, faces);
      return std::all_of(facing.begin(), facing.end(), [&](const FacingFace &face) {
        return number.at(face.master) == number.at(facing[0].master);
      });
    }
  } // namespace



  FacingFaces::Entries
  FacingFaces::entries(const Face &slave, const Tensor<1, dim> &normal) const
  {
    Entries    result;
    SlavePoint centre{{}, {}, normal, false, {}};
    for (unsigned int m = 0; m < slave.n_nodes(); ++m)
      {
        const SlavePoint corner{
          slave.position(m), slave.reference[m] + slave.committed[m], normal, false, {}};
        centre.x += corner.x / slave.n_nodes();
        centre.start += corner.start / slave.n_nodes();
        if (const Face *face = search.entry(corner))
          result.faces.push_back(face);
      }
    if (const Face *face = search.entry(centre))
      result.faces.push_back(face);
    const auto  known = touched.find(slave.key);
    const Face *face  = known == touched.end() ? nullptr : search.face(known->second);
    if (face != nullptr)
      {
        result.faces.push_back(search.follow(centre, *face));
        result.last_touched = true;
      }
    return result;
  }



  std::vector<FacingFace>
  FacingFaces::find(const Face &slave)
  {
    std::vector<const Face *> near;
    if (const auto known = candidates.find(slave.key); known != candidates.end())
      {
        for (const auto &[key, place] : known->second)
          if (const Face *face = search.face(key, place))
            near.push_back(face);
        return cover(slave, near);
      }
    const FacePoint      centre = evaluate(slave, nullptr, {{0., 0.}});
    const Tensor<1, dim> normal = centre.normal();
    near                        = search.near(box(slave), normal);
    std::vector<FacingFace> all = cover(slave, near);
    // Those that cover the face mostly hang together without the help of others.
    const bool   layered = !one_layer(search, masters_of(all)) && !one_layer(search, all, near);
    const double size    = cross_product_3d(centre.tangents[0], centre.tangents[1]).norm();
    const double far     = small_motion * std::sqrt(4. * size);
    bool         moved   = false;
    for (const FacingFace &facing : all)
      moved = moved || (mean_motion(slave) - mean_motion(*facing.master)).norm() > far;
    // Where there is but one layer on its way it cannot have come to another.
    if (layered || all.empty() ||
        (moved && !one_layer(search, search.near(way(slave, all), normal))))
      {
        const Entries in    = entries(slave, normal);
        const bool    known = std::all_of(in.faces.begin(), in.faces.end(), [&](const Face *face) {
          return std::find(near.begin(), near.end(), face) != near.end();
        });
        if (!known || layered)
          return resolve(slave, normal, in);
      }
    Candidates &those = candidates[slave.key];
    for (const Face *face : near)
      if (may_overlap(slave, *face, limit))
        those.emplace_back(face->key, search.place(*face));
    return all;
  }



  std::vector<FacingFace>
  FacingFaces::resolve(const Face &slave, const Tensor<1, dim> &normal, const Entries &in) const
  {
    // What lies around the places of entry is within reach, too.
    BoundingBox<dim> around = box(slave);
    for (const Face *face : in.faces)
      around.merge_with(box(*face));
    const std::vector<const Face *> masters = search.near(around, normal);

    struct Layer
    {
      std::vector<FacingFace> faces;
      double                  area = 0., gap = 0.;
      bool                    entered = false;
    };
    const std::map<const Face *, unsigned int> number = layers(search, masters);
    std::map<unsigned int, Layer>              by_number;
    for (FacingFace &facing : cover(slave, masters))
      {
        Layer &layer = by_number[number.at(facing.master)];
        layer.area += area(facing.points);
        layer.gap += gap(slave, normal, facing);
        layer.faces.push_back(std::move(facing));
      }
    for (std::size_t i = 0; i < in.faces.size(); ++i)
      {
        const auto found = number.find(in.faces[i]);
        const auto layer = found == number.end() ? by_number.end() : by_number.find(found->second);
        // From what it touched it may just have gone away.
        const bool only_touched = in.last_touched && i + 1 == in.faces.size();
        if (layer != by_number.end() && (!only_touched || layer->second.gap < 0.))
          layer->second.entered = true;
      }

    std::vector<Layer> order;
    for (auto &[id, layer] : by_number)
      order.push_back(std::move(layer));
    std::sort(order.begin(), order.end(), [](const Layer &a, const Layer &b) {
      if (a.entered != b.entered)
        return a.entered;
      const double of_a = std::abs(a.gap / a.area), of_b = std::abs(b.gap / b.area);
      return of_a != of_b ? of_a < of_b : a.faces[0].master->key < b.faces[0].master->key;
    });

    std::vector<FacingFace> result;
    for (Layer &layer : order)
      {
        const std::size_t before = result.size();
        for (FacingFace &facing : layer.faces)
          {
            double hidden = 0.;
            for (std::size_t i = 0; i < before; ++i)
              hidden += area(overlap(*result[i].master, *facing.master));
            if (hidden < behind * area(*facing.master))
              result.push_back(std::move(facing));
          }
      }
    std::sort(result.begin(), result.end(), [](const FacingFace &a, const FacingFace &b) {
      return a.master->key < b.master->key;
    });
    return result;
  }



  void
  FacingFaces::commit(const std::vector<CoveredFace> &faces)
  {
    std::unordered_map<std::uint64_t, std::uint64_t> now;
    for (const auto &[slave, masters] : faces)
      {
        const Tensor<1, dim> normal = evaluate(slave, nullptr, {{0., 0.}}).normal();
        double               sum = 0., largest = 0., whole = 0.;
        const Face          *master = nullptr;
        for (const FacingFace &f : masters)
          {
            const double covered = area(f.points);
            sum += gap(slave, normal, f);
            whole += covered;
            if (covered > (1. + 1e-9) * largest)
              {
                largest = covered;
                master  = f.master;
              }
          }
        if (master && sum < touching * std::sqrt(whole) * whole)
          now[slave.key] = master->key;
      }
    touched.swap(now);
  }
} // namespace Touchstone

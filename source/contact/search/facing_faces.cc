// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/face_area.h>
#include <touchstone/contact/search/connected_components.h>
#include <touchstone/contact/search/facing_faces.h>
#include <touchstone/contact/search/far_side.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

// Which master faces cover a slave face. Normally all faces within reach with an opposed normal do.
// Exceptions are thin bodies and faces that have passed through a body within a step: then more
// than one connected component of master faces lies in front of or behind the slave face, and the
// motion since the start of the step decides (doc/theory.md 4, "Passing through"). The result of
// the search is kept until nodes have moved by a small part of the shortest edge.
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
    void
    sort_by_key(std::vector<const Face *> &faces)
    {
      std::sort(faces.begin(), faces.end(), [](const Face *a, const Face *b) {
        return a->key < b->key;
      });
    }

    BoundingBox<dim>
    box(const Face &face)
    {
      BoundingBox<dim> result({face.position(0), face.position(0)});
      for (unsigned int m = 1; m < face.n_nodes(); ++m)
        result.merge_with(BoundingBox<dim>({face.position(m), face.position(m)}));
      return result;
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

    /** Length of an edge of a square with the area of the tangent plane at the centre of a face. */
    double
    centre_size(const Face &face)
    {
      // The face is [-1,1]^2, of area 4 |t_1 x t_2|.
      const FacePoint centre = evaluate(face, nullptr, {{0., 0.}});
      return std::sqrt(4. * cross_product_3d(centre.tangents[0], centre.tangents[1]).norm());
    }

    Tensor<1, dim>
    mean_motion(const Face &face)
    {
      Tensor<1, dim> sum;
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        sum += face.displacement[m] - face.committed[m];
      return sum / face.n_nodes();
    }

    /** The gap between the facets along the slave normal at a point, length; negative where they
     * overlap. */
    double
    gap(const Face &slave, const Tensor<1, dim> &normal, const Face &master, const OverlapPoint &p)
    {
      return (evaluate(master, nullptr, p.master).x - evaluate(slave, nullptr, p.slave).x) * normal;
    }

    /** The integral of the gap, volume. */
    double
    gap(const Face                      &slave,
        const Tensor<1, dim>            &normal,
        const Face                      &master,
        const std::vector<OverlapPoint> &points)
    {
      double sum = 0.;
      for (const OverlapPoint &p : points)
        sum += p.weight * gap(slave, normal, master, p);
      return sum;
    }

    /** The middle of what is covered of a slave face. */
    Point<dim>
    mean_position(const Face &slave, const std::vector<OverlapPoint> &points)
    {
      Tensor<1, dim> sum;
      for (const OverlapPoint &p : points)
        sum += p.weight * evaluate(slave, nullptr, p.slave).x;
      return Point<dim>(sum / area(points));
    }

    /** connected_components() by face. */
    std::map<const Face *, unsigned int>
    components_by_face(const std::vector<const Face *> &faces)
    {
      const std::vector<unsigned int>      numbers = connected_components(faces);
      std::map<const Face *, unsigned int> result;
      for (std::size_t i = 0; i < faces.size(); ++i)
        result[faces[i]] = numbers[i];
      return result;
    }

    /** The box around the path of @p slave in this step, relative to the faces that cover it. */
    BoundingBox<dim>
    path(const Face &slave, const std::vector<FacingFace> &covering)
    {
      // In a frame that moves with the mean of the covering faces: a rigid motion of both bodies is
      // no motion towards each other.
      Tensor<1, dim> motion = mean_motion(slave);
      for (const FacingFace &facing : covering)
        motion -= mean_motion(*facing.master) / static_cast<double>(covering.size());
      BoundingBox<dim> result = box(slave);
      const auto      &ends   = result.get_boundary_points();
      result.merge_with(BoundingBox<dim>({ends.first - motion, ends.second - motion}));
      return result;
    }

    /** Whether the faces that cover a slave face are connected over the nodes of all that are
     * near. */
    bool
    covering_is_connected(const std::vector<FacingFace>   &covering,
                          const std::vector<const Face *> &near)
    {
      // In most cases they are, without faces beside the covered part.
      if (covering.size() < 2 || is_connected(masters_of(covering)))
        return true;
      const std::map<const Face *, unsigned int> number = components_by_face(near);
      return std::all_of(covering.begin(), covering.end(), [&](const FacingFace &face) {
        return number.at(face.master) == number.at(covering[0].master);
      });
    }

    /** A connected component of the master faces that cover a slave face. */
    struct Component
    {
      std::vector<FacingFace> faces;
      /** Covered area, and the integral of the gap over it. */
      double area = 0., gap = 0.;
      /** The slave face has entered its body in this step, or touched it at its start. */
      bool entered = false;
    };

    /** Whether @p a takes precedence over @p b. */
    bool
    comes_first(const Component &a, const Component &b)
    {
      // A component that was entered explains where the slave face came from. Otherwise the one
      // with the smaller mean gap (integral over area); the key decides between equal ones,
      // independent of the partition.
      if (a.entered != b.entered)
        return a.entered;
      const double of_a = std::abs(a.gap / a.area), of_b = std::abs(b.gap / b.area);
      return of_a != of_b ? of_a < of_b : a.faces[0].master->key < b.faces[0].master->key;
    }

    /** Of components in the order of precedence all faces that do not lie behind those of
     * earlier ones. */
    std::vector<FacingFace>
    remove_hidden_faces(std::vector<Component> &&order)
    {
      std::vector<FacingFace> result;
      for (Component &component : order)
        {
          const std::size_t before = result.size();
          for (FacingFace &facing : component.faces)
            {
              // The area of this face that earlier accepted faces cover.
              double hidden = 0.;
              for (std::size_t i = 0; i < before; ++i)
                hidden += area(overlap(*result[i].master, *facing.master));
              if (hidden < Tolerances::behind * face_area(*facing.master))
                result.push_back(std::move(facing));
            }
        }
      std::sort(result.begin(), result.end(), [](const FacingFace &a, const FacingFace &b) {
        return a.master->key < b.master->key;
      });
      return result;
    }
  } // namespace



  bool
  FacingFaces::lies_far(const Face           &slave,
                        const Tensor<1, dim> &normal,
                        const FacingFace     &facing) const
  {
    const Face                      &master = *facing.master;
    const std::vector<OverlapPoint> &points = facing.points;
    // Most faces are not behind their points, as the first of these tells.
    if (!is_deep(search.tree(), master, -gap(slave, normal, master, points.front())))
      return false;
    const Face   before  = at_start_of_step(slave);
    const double covered = area(points);
    return on_far_side(search.tree(),
                       mean_position(before, points),
                       normal,
                       master,
                       -gap(slave, normal, master, points) / covered,
                       -gap(before, normal, at_start_of_step(master), points) / covered);
  }



  std::vector<FacingFace>
  FacingFaces::cover(const Face                      &slave,
                     const Tensor<1, dim>            &normal,
                     const std::vector<const Face *> &masters) const
  {
    std::vector<FacingFace> result;
    auto                    points = overlap(slave, masters);
    for (std::size_t f = 0; f < masters.size(); ++f)
      {
        FacingFace facing{masters[f], std::move(points[f])};
        if (!facing.points.empty() && !lies_far(slave, normal, facing))
          result.push_back(std::move(facing));
      }
    return result;
  }



  FacingFaces::Entries
  FacingFaces::entries(const Face &slave, const Tensor<1, dim> &normal) const
  {
    const SweptSearch swept = search.swept();
    Entries           result;
    SlavePoint        centre{{}, {}, normal, false, {}};
    for (unsigned int m = 0; m < slave.n_nodes(); ++m)
      {
        // Each node of the face and its centre are followed from the start of the step like nodes
        // of pointwise rows.
        const SlavePoint corner{
          slave.position(m), slave.reference[m] + slave.committed[m], normal, false, {}};
        centre.x += corner.x / slave.n_nodes();
        centre.start += corner.start / slave.n_nodes();
        if (const Face *face = swept.entry(corner))
          result.faces.push_back(face);
      }
    if (const Face *face = swept.entry(centre))
      result.faces.push_back(face);
    // What the face touched at the start of the step is followed along the surface by closest
    // points to its present position: sliding must not lose it.
    const auto  known = touched.find(slave.key);
    const Face *face  = known == touched.end() ? nullptr : search.exchange().face(known->second);
    if (face != nullptr)
      {
        result.faces.push_back(swept.follow(centre, *face).face);
        result.last_touched = true;
      }
    return result;
  }



  bool
  FacingFaces::is_ambiguous(const Face                    &slave,
                            const Tensor<1, dim>          &normal,
                            const std::vector<FacingFace> &covering,
                            const bool                     connected) const
  {
    if (!connected || covering.empty())
      return true;
    // What moves by less than a fraction of the face has not passed through a body, which saves the
    // search along its path in most cases.
    const double limit_of_motion = Tolerances::small_motion * centre_size(slave);
    const bool moved = std::any_of(covering.begin(), covering.end(), [&](const FacingFace &facing) {
      return (mean_motion(slave) - mean_motion(*facing.master)).norm() > limit_of_motion;
    });
    // With a single component along its path no other one can have been entered.
    return moved && !is_connected(search.near(path(slave, covering), normal));
  }



  std::vector<FacingFace>
  FacingFaces::find(const Face &slave)
  {
    const FaceExchange       &exchange = search.exchange();
    const Tensor<1, dim>      normal   = evaluate(slave, nullptr, {{0., 0.}}).normal();
    std::vector<const Face *> near;
    // Known candidates are intersected anew, but not searched for.
    if (const auto known = candidates.find(slave.key); known != candidates.end())
      {
        for (const auto &[key, index] : known->second)
          if (const Face *face = exchange.face(key, index))
            near.push_back(face);
        return cover(slave, normal, near);
      }
    near = search.near(box(slave), normal);
    // Integrals over the faces are summed in the order of keys, on any number of ranks.
    sort_by_key(near);
    const std::vector<FacingFace> all       = cover(slave, normal, near);
    const bool                    connected = covering_is_connected(all, near);
    if (is_ambiguous(slave, normal, all, connected))
      {
        const Entries in    = entries(slave, normal);
        const bool    known = std::all_of(in.faces.begin(), in.faces.end(), [&](const Face *face) {
          return std::find(near.begin(), near.end(), face) != near.end();
        });
        // The entered faces are among those that are near and these are connected: there is only
        // one component, and no choice.
        if (!known || !connected)
          return resolve(slave, normal, in);
      }
    // Only unambiguous results are kept. Those of resolve() depend on the motion and are determined
    // in each iteration.
    Candidates &those = candidates[slave.key];
    for (const Face *face : near)
      if (may_overlap(slave, *face, limit))
        those.emplace_back(face->key, exchange.index(*face));
    return all;
  }



  std::vector<FacingFace>
  FacingFaces::resolve(const Face &slave, const Tensor<1, dim> &normal, const Entries &in) const
  {
    // The faces that it has entered may lie farther away than the reach: search around them, too.
    BoundingBox<dim> around = box(slave);
    for (const Face *face : in.faces)
      around.merge_with(box(*face));
    std::vector<const Face *> masters = search.near(around, normal);
    sort_by_key(masters);

    // Area and integral of the gap by component.
    const std::map<const Face *, unsigned int> number = components_by_face(masters);
    std::map<unsigned int, Component>          by_number;
    for (FacingFace &facing : cover(slave, normal, masters))
      {
        Component &component = by_number[number.at(facing.master)];
        component.area += area(facing.points);
        component.gap += gap(slave, normal, *facing.master, facing.points);
        component.faces.push_back(std::move(facing));
      }
    for (std::size_t i = 0; i < in.faces.size(); ++i)
      {
        const auto found = number.find(in.faces[i]);
        if (found == number.end())
          continue;
        const auto component = by_number.find(found->second);
        // From the component that it touched at the start it may just have separated: that counts
        // only if they overlap.
        const bool only_touched = in.last_touched && i + 1 == in.faces.size();
        if (component != by_number.end() && (!only_touched || component->second.gap < 0.))
          component->second.entered = true;
      }

    // By precedence.
    std::vector<Component> order;
    for (auto &[id, component] : by_number)
      order.push_back(std::move(component));
    std::sort(order.begin(), order.end(), comes_first);
    return remove_hidden_faces(std::move(order));
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
            sum += gap(slave, normal, *f.master, f.points);
            whole += covered;
            // The master face that covers most of it represents the component; areas that are equal
            // up to round-off must not change the choice, so the first keeps it.
            if (covered > (1. + Tolerances::equal_areas) * largest)
              {
                largest = covered;
                master  = f.master;
              }
          }
        // Touches: the mean gap sum / whole is below a fraction of the size of the covered part, or
        // negative.
        if (master && sum < Tolerances::touching * std::sqrt(whole) * whole)
          now[slave.key] = master->key;
      }
    touched.swap(now);
  }
} // namespace Touchstone

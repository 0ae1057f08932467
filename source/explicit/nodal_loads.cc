// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/hexahedron.h>
#include <touchstone/explicit/nodal_loads.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <map>

// Loads of explicit dynamics: all that does not depend on the time is integrated before the first
// cycle. Cells are visited in the order of their keys, so that sums at nodes do not depend on the
// partition (doc/explicit.md, section 3).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A face of a cell with bilinear shapes, whose tangents give normal times area. */
    struct LoadedFace
    {
      std::array<unsigned int, 4> nodes;
      BoundaryIds::value_type     boundary;
      /** 1 if the cross product of the tangents points out of the cell, else -1. */
      double sign;
      bool   owned;
    };

    double
    edge_shape(const unsigned int side, const double x)
    {
      return side == 0 ? 1. - x : x;
    }

    /** The faces on boundaries, cell by cell in the order of the keys. */
    std::vector<LoadedFace>
    boundary_faces(const Solid &solid, const NodeMap &map)
    {
      std::vector<DoFHandler<dim>::active_cell_iterator> by_index(
        solid.dof_handler.get_triangulation().n_active_cells());
      for (const auto &cell : solid.dof_handler.active_cell_iterators())
        by_index[cell->active_cell_index()] = cell;
      std::vector<LoadedFace> result;
      for (unsigned int c = 0; c < map.cells().size(); ++c)
        {
          const auto &cell = by_index[map.cells()[c].index];
          for (const unsigned int f : cell->face_indices())
            if (cell->at_boundary(f))
              {
                LoadedFace face;
                face.boundary = cell->face(f)->boundary_id();
                // Of the faces of the cell itself, not as the mesh orients them: the face across
                // direction d, whose first tangent is along the next direction.
                const unsigned int d = f / 2, e = (d + 1) % dim, g = (d + 2) % dim;
                for (unsigned int k = 0; k < 4; ++k)
                  face.nodes[k] =
                    map.nodes(c)[((f % 2) << d) | ((k & 1) << e) | (((k >> 1) & 1) << g)];
                face.sign  = f % 2 == 1 ? 1. : -1.;
                face.owned = map.cells()[c].owned;
                result.push_back(face);
              }
        }
      return result;
    }
  } // namespace



  NodalLoads::NodalLoads(const BoundaryConditions &conditions,
                         const Solid              &solid,
                         const NodeMap            &map)
    : map(map)
  {
    add_body_forces(conditions);
    add_surface_loads(conditions, solid);
    for (const NodeSetLoad &load : conditions.node_set_loads())
      for (unsigned int d = 0; d < dim; ++d)
        {
          std::vector<LoadPoint> points;
          for (const SetNode &node : load.nodes)
            {
              LoadPoint point{};
              point.position  = node.position;
              point.n_nodes   = 1;
              point.nodes[0]  = map.local(dim * node.node);
              point.shapes[0] = 1.;
              point.direction = node.share * Point<dim>::unit_vector(d);
              points.push_back(point);
            }
          add(load.force[d], std::move(points));
        }
  }



  void
  NodalLoads::add(const Function &function, std::vector<LoadPoint> &&points)
  {
    if (!function || points.empty())
      return;
    Load load{function, {}, {}, !function->depends_on_time()};
    if (function->depends_on_position() && !load.constant)
      load.points = std::move(points);
    else
      {
        std::map<unsigned int, Tensor<1, dim>> sums;
        for (const LoadPoint &point : points)
          {
            const double value = load.constant ? function->value(point.position, 0.) : 1.;
            for (unsigned int a = 0; a < point.n_nodes; ++a)
              if (point.nodes[a] < map.n_owned())
                sums[point.nodes[a]] += value * point.shapes[a] * point.direction;
          }
        load.nodal.assign(sums.begin(), sums.end());
      }
    loads.push_back(std::move(load));
  }



  void
  NodalLoads::add_body_forces(const BoundaryConditions &conditions)
  {
    const auto &functions = conditions.volume_loads();
    Hexahedron  shapes;
    for (unsigned int body = 0; body < functions.size(); ++body)
      for (unsigned int d = 0; d < dim; ++d)
        if (functions[body][d])
          {
            std::vector<LoadPoint> points;
            for (unsigned int c = 0; c < map.cells().size(); ++c)
              if (map.cells()[c].body == body)
                {
                  const auto x = corners(map, map.nodes(c));
                  shapes.reinit(x);
                  for (unsigned int q = 0; q < Hexahedron::n_points; ++q)
                    {
                      LoadPoint point;
                      point.n_nodes      = Hexahedron::n_nodes;
                      point.nodes        = map.nodes(c);
                      point.direction[d] = shapes.weight(q);
                      for (unsigned int a = 0; a < Hexahedron::n_nodes; ++a)
                        {
                          point.shapes[a] = Hexahedron::shape(q, a);
                          point.position += point.shapes[a] * x[a];
                        }
                      points.push_back(point);
                    }
                }
            add(functions[body][d], std::move(points));
          }
  }



  Tensor<1, dim>
  NodalLoads::normal(const PressurePoint &point) const
  {
    Tensor<1, dim> tangents[2];
    for (unsigned int k = 0; k < 4; ++k)
      for (unsigned int i = 0; i < 2; ++i)
        tangents[i] += point.derivatives[i][k] * map.positions()[point.nodes[k]];
    return point.sign * cross_product_3d(tangents[0], tangents[1]);
  }



  void
  NodalLoads::add_tractions(const BoundaryConditions::Load   &load,
                            const std::vector<PressurePoint> &points)
  {
    // A function with the direction of its traction for each point, from place and normal.
    const auto add_with = [&](const Function &function, const auto &direction) {
      if (!function)
        return;
      std::vector<LoadPoint> all;
      for (const PressurePoint &point : points)
        {
          LoadPoint one;
          one.position = point.position;
          one.n_nodes  = 4;
          std::copy(point.nodes.begin(), point.nodes.end(), one.nodes.begin());
          std::copy(point.shapes.begin(), point.shapes.end(), one.shapes.begin());
          one.direction = direction(point.position, normal(point));
          all.push_back(one);
        }
      add(function, std::move(all));
    };
    for (unsigned int d = 0; d < dim; ++d)
      add_with(load.traction[d], [d](const Point<dim> &, const Tensor<1, dim> &n) {
        return n.norm() * Point<dim>::unit_vector(d);
      });
    add_with(load.pressure, [](const Point<dim> &, const Tensor<1, dim> &n) { return -n; });
    if (!load.resultant)
      return;
    if (load.resultant->follows())
      {
        resultants.push_back({load.resultant, points, {}});
        for (const PressurePoint &point : points)
          resultants.back().areas.push_back(normal(point).norm());
        return;
      }
    for (unsigned int k = 0; k < 2 * dim; ++k)
      add_with(load.resultant->functions()[k], [&](const Point<dim> &x, const Tensor<1, dim> &n) {
        return n.norm() * ResultantLoad::traction_of_unit(k, load.resultant->at_start(), x);
      });
  }



  void
  NodalLoads::add_springs(const GroundSprings::Spring      &spring,
                          const std::vector<PressurePoint> &points)
  {
    for (const PressurePoint &point : points)
      {
        const Tensor<1, dim> n    = normal(point);
        const double         area = n.norm();
        springs.push_back(
          {point.nodes, point.shapes, n / area, area * spring.normal, area * spring.tangential});
      }
  }



  void
  NodalLoads::add_surface_loads(const BoundaryConditions &conditions, const Solid &solid)
  {
    if (conditions.surface_loads().empty() && !conditions.depends_on_displacement())
      return;
    const auto            faces = boundary_faces(solid, map);
    const QGauss<dim - 1> quadrature(3);
    const auto            points_of = [&](const BoundaryIds &boundary) {
      std::vector<PressurePoint> points;
      for (const LoadedFace &face : faces)
        if (boundary.count(face.boundary) > 0)
          for (unsigned int q = 0; q < quadrature.size(); ++q)
            {
              PressurePoint        point;
              const Point<dim - 1> x = quadrature.point(q);
              point.nodes            = face.nodes;
              point.owned            = face.owned;
              point.sign             = face.sign * quadrature.weight(q);
              for (unsigned int k = 0; k < 4; ++k)
                {
                  const unsigned int i = k & 1, j = k >> 1;
                  point.shapes[k]         = edge_shape(i, x[0]) * edge_shape(j, x[1]);
                  point.derivatives[0][k] = (i == 0 ? -1. : 1.) * edge_shape(j, x[1]);
                  point.derivatives[1][k] = (j == 0 ? -1. : 1.) * edge_shape(i, x[0]);
                  point.position += point.shapes[k] * map.positions()[face.nodes[k]];
                }
              points.push_back(point);
            }
      return points;
    };
    for (const auto &load : conditions.surface_loads())
      add_tractions(load, points_of(load.boundary));
    for (const auto &spring : conditions.ground_springs().all_springs())
      add_springs(spring, points_of(spring.boundary));
    for (const auto &load : conditions.follower_pressure().all_loads())
      if (std::vector<PressurePoint> points = points_of(load.boundary); !points.empty())
        pressures.push_back({load.pressure, std::move(points)});
  }



  void
  NodalLoads::evaluate(const double t, const NodeField &u, NodeField &force) const
  {
    std::fill(force.begin(), force.end(), Tensor<1, dim>());
    for (const Load &load : loads)
      {
        const double factor =
          load.constant || !load.points.empty() ? 1. : load.function->value(Point<dim>(), t);
        for (const auto &[node, value] : load.nodal)
          force[node] += factor * value;
        for (const LoadPoint &point : load.points)
          {
            const Tensor<1, dim> whole = load.function->value(point.position, t) * point.direction;
            for (unsigned int a = 0; a < point.n_nodes; ++a)
              force[point.nodes[a]] += point.shapes[a] * whole;
          }
      }
    add_resultants(t, u, force);
    for (const Spring &spring : springs)
      {
        Tensor<1, dim> moved;
        for (unsigned int k = 0; k < 4; ++k)
          moved += spring.shapes[k] * u[spring.nodes[k]];
        const Tensor<1, dim> whole = -spring.along * moved + (spring.along - spring.across) *
                                                               (spring.normal * moved) *
                                                               spring.normal;
        for (unsigned int k = 0; k < 4; ++k)
          force[spring.nodes[k]] += spring.shapes[k] * whole;
      }
    for (const Pressure &pressure : pressures)
      {
        const bool   uniform = !pressure.function->depends_on_position();
        const double common  = uniform ? pressure.function->value(Point<dim>(), t) : 0.;
        for (const PressurePoint &point : pressure.points)
          {
            Tensor<1, dim> tangents[2];
            for (unsigned int k = 0; k < 4; ++k)
              for (unsigned int i = 0; i < 2; ++i)
                tangents[i] +=
                  point.derivatives[i][k] * (map.positions()[point.nodes[k]] + u[point.nodes[k]]);
            const double value = uniform ? common : pressure.function->value(point.position, t);
            const Tensor<1, dim> whole =
              -value * point.sign * cross_product_3d(tangents[0], tangents[1]);
            for (unsigned int k = 0; k < 4; ++k)
              force[point.nodes[k]] += point.shapes[k] * whole;
          }
      }
  }



  double
  NodalLoads::square_frequency(const std::vector<double> &masses) const
  {
    // Largest sum of the norms of the blocks of a row over the mass: the shapes of a face add up to
    // one.
    std::map<unsigned int, double> sums;
    for (const Spring &spring : springs)
      for (unsigned int k = 0; k < 4; ++k)
        if (spring.nodes[k] < map.n_owned())
          sums[spring.nodes[k]] += spring.shapes[k] * std::max(spring.across, spring.along);
    double largest = 0.;
    for (const auto &[node, sum] : sums)
      largest = std::max(largest, sum / masses[node]);
    return Utilities::MPI::max(largest, map.communicator());
  }
} // namespace Touchstone

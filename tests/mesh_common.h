// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_tests_mesh_common_h
#define touchstone_tests_mesh_common_h

#include <touchstone/base/input_error.h>
#include <touchstone/mesh/body_mesh.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>

#include <cmath>
#include <iostream>
#include <sstream>

namespace Touchstone
{
  /** The number, or that it is as small as it should be: rounding differs
   * between machines. */
  inline std::string
  small(const double x, const double tolerance = 1e-12)
  {
    std::ostringstream out;
    if (std::abs(x) <= tolerance)
      out << "<= " << tolerance;
    else
      out << x << " FAILED";
    return out.str();
  }

  /** A geometry with the parameters in @p text. */
  inline std::shared_ptr<Geometry>
  make_geometry(const std::string &type, const std::string &text)
  {
    const auto               geometry = GeometryRegistry::make(type);
    dealii::ParameterHandler prm;
    geometry->declare(prm);
    prm.parse_input_from_string(text);
    geometry->check("Body x/Geometry");
    return geometry;
  }

  /** Volume, areas and distances of boundary points from exact surfaces. */
  inline void
  measure(const BodyMesh                               &mesh,
          const dealii::Triangulation<3>               &triangulation,
          std::map<dealii::types::boundary_id, double> &areas,
          double                                       &volume,
          double                                       &distance)
  {
    using namespace dealii;
    const MappingQ<3> mapping(2);
    const FE_Q<3>     fe(1);
    FEValues<3>       cells(mapping, fe, QGauss<3>(4), update_JxW_values);
    FEFaceValues<3>   faces(mapping, fe, QGauss<2>(4), update_JxW_values);
    // The nodes of degree 2, which lie on the exact surface.
    FEFaceValues<3> nodes(mapping, fe, QGaussLobatto<2>(3), update_quadrature_points);

    areas.clear();
    volume = distance = 0.;
    for (const auto &cell : triangulation.active_cell_iterators())
      {
        cells.reinit(cell);
        for (const double weight : cells.get_JxW_values())
          {
            volume += weight;
            if (weight <= 0.)
              std::cout << "negative Jacobian FAILED\n";
          }
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary())
            {
              const auto id = cell->face(f)->boundary_id();
              faces.reinit(cell, f);
              for (const double weight : faces.get_JxW_values())
                areas[id] += weight;
              if (mesh.surfaces.count(id) == 0)
                continue;
              nodes.reinit(cell, f);
              for (const Point<3> &x : nodes.get_quadrature_points())
                distance = std::max(distance, x.distance(mesh.surfaces.at(id)->project(x)));
            }
      }
  }

  /** Smallest Jacobian determinant at a corner of a cell over the lengths of the
   * edges there: 1 for boxes, 0 for flat corners. */
  inline double
  scaled_jacobian(const dealii::Triangulation<3> &triangulation)
  {
    double smallest = 1.;
    for (const auto &cell : triangulation.active_cell_iterators())
      for (unsigned int v = 0; v < 8; ++v)
        {
          std::array<dealii::Tensor<1, 3>, 3> edge;
          for (unsigned int d = 0; d < 3; ++d)
            {
              edge[d] = cell->vertex(v | 1u << d) - cell->vertex(v & ~(1u << d));
              edge[d] /= edge[d].norm();
            }
          smallest = std::min(smallest, edge[0] * cross_product_3d(edge[1], edge[2]));
        }
    return smallest;
  }

  /** Create, refine, print. */
  inline void
  print_geometry(const std::string &title, const std::string &type, const std::string &text)
  {
    using namespace dealii;
    std::cout << title << '\n';
    const auto geometry = make_geometry(type, text);
    for (const double factor : {0.75, 1., 1.25, 1.99})
      std::cout << "  factor " << factor << ": " << geometry->create(factor, "", "").cells.size()
                << " cells\n";

    const BodyMesh    mesh  = geometry->create(1., "", "");
    const Orientation count = orientation(mesh);
    std::cout << "  not positive " << count.negative + count.distorted << '\n';
    Triangulation<3> triangulation;
    create_triangulation(mesh, triangulation);
    for (unsigned int level = 0; level < 2; ++level)
      {
        std::map<types::boundary_id, double> areas;
        double                               volume, distance;
        measure(mesh, triangulation, areas, volume, distance);
        std::cout << "  level " << level << ": " << triangulation.n_active_cells() << " cells, "
                  << triangulation.n_used_vertices() << " vertices, volume " << volume
                  << ", scaled Jacobian " << scaled_jacobian(triangulation) << '\n';
        for (const auto &[name, id] : mesh.boundary_names)
          std::cout << "    " << name << ' ' << id << ": " << areas[id] << '\n';
        for (const auto &[id, area] : areas)
          {
            bool named = false;
            for (const auto &[name, other] : mesh.boundary_names)
              named = named || other == id;
            if (!named)
              std::cout << "    boundary " << id << " has no name FAILED\n";
          }
        std::cout << "    off the exact surface " << small(distance) << '\n';
        triangulation.refine_global(1);
      }
  }

  /** Print the message of the InputError that @p action throws. */
  template <class Action>
  void
  print_error(const Action &action)
  {
    try
      {
        action();
        std::cout << "no error FAILED\n";
      }
    catch (const InputError &error)
      {
        std::cout << error.what() << '\n';
      }
  }
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/cell_mass.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <numeric>

// The mass of a cell: consistent, lumped, or by the rule whose errors cancel those of the step in
// the speed of waves; and with the mass of massless nodes at the others.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Distance between the centres of the faces across a direction. */
    double
    extent(const Triangulation<dim>::active_cell_iterator &cell, const unsigned int d)
    {
      return cell->face(2 * d)->center().distance(cell->face(2 * d + 1)->center());
    }

    /**
     * The rule of two points in each direction, at (1 +- xi)/2 with xi^2 = 2/3 (1 - C^2),
     * where C is the Courant number of the direction, at most 1.
     */
    Quadrature<dim>
    dispersion_corrected_rule(const MaterialParameters                       &material,
                              const Triangulation<dim>::active_cell_iterator &cell,
                              const double                                    step)
    {
      // The speed of plane longitudinal waves, sqrt((kappa + 4/3 mu) / rho), the fastest of the
      // material.
      const double modulus = material.bulk_modulus() + 4. / 3. * material.shear_modulus();
      const double wave    = std::sqrt(modulus / material.density);
      Point<dim>   xi;
      for (unsigned int d = 0; d < dim; ++d)
        xi[d] = std::sqrt(2. / 3. * std::max(0., 1. - std::pow(wave * step / extent(cell, d), 2)));
      std::vector<Point<dim>> points;
      for (unsigned int corner = 0; corner < GeometryInfo<dim>::vertices_per_cell; ++corner)
        {
          const Point<dim> vertex = GeometryInfo<dim>::unit_cell_vertex(corner);
          Point<dim>       x;
          for (unsigned int d = 0; d < dim; ++d)
            x[d] = 0.5 * (1. + (2. * vertex[d] - 1.) * xi[d]);
          points.push_back(x);
        }
      return Quadrature<dim>(points, std::vector<double>(points.size(), 1. / points.size()));
    }
  } // namespace



  CellMass::CellMass(const MassKind kind,
                     const Solid   &solid,
                     const Vector  &no_mass,
                     const double   step)
    : kind(kind)
    , solid(solid)
    , no_mass(no_mass)
    , step(step)
    , scalar_fe(solid.fe.degree)
    , values(solid.mapping,
             scalar_fe,
             QGauss<dim>(solid.fe.degree + 1),
             update_values | update_JxW_values)
    , lumped(scalar_fe.n_dofs_per_cell())
    , dofs(solid.fe.n_dofs_per_cell())
  {
    nodes.resize(lumped.size());
    complete.reinit(lumped.size(), lumped.size());
  }



  void
  CellMass::reinit(const DoFHandler<dim>::active_cell_iterator &cell)
  {
    const MaterialParameters &material = solid.bodies[cell->material_id()].material;
    values.reinit(Triangulation<dim>::active_cell_iterator(cell));
    cell->get_dof_indices(dofs);
    for (unsigned int i = 0; i < dofs.size(); ++i)
      if (solid.fe.system_to_component_index(i).first == 0)
        nodes[solid.fe.system_to_component_index(i).second] = dofs[i];
    const unsigned int n = nodes.size();
    // Row sums give the lumped mass. It is needed for every kind, as the key by which the
    // mass of massless nodes is distributed.
    complete = 0.;
    std::fill(lumped.begin(), lumped.end(), 0.);
    for (const unsigned int q : values.quadrature_point_indices())
      for (unsigned int a = 0; a < n; ++a)
        {
          const double part = material.density * values.JxW(q) * values.shape_value(a, q);
          lumped[a] += part;
          if (kind == MassKind::consistent)
            for (unsigned int b = 0; b < n; ++b)
              complete(a, b) += part * values.shape_value(b, q);
        }
    if (kind == MassKind::lumped)
      for (unsigned int a = 0; a < n; ++a)
        complete(a, a) = lumped[a];
    if (kind == MassKind::dispersion_corrected)
      {
        // The rule does not know the volume of a distorted cell.
        const double total = std::accumulate(lumped.begin(), lumped.end(), 0.);
        const auto   rule  = dispersion_corrected_rule(material, cell, step);
        for (const Point<dim> &x : rule.get_points())
          for (unsigned int a = 0; a < n; ++a)
            for (unsigned int b = 0; b < n; ++b)
              complete(a, b) +=
                total / rule.size() * scalar_fe.shape_value(a, x) * scalar_fe.shape_value(b, x);
      }
    move();
  }



  void
  CellMass::move()
  {
    // Entries between a massless node and another one vanish, too, for the matrix must not
    // couple a massless node to accelerations. Their sum is added to the diagonal of the
    // other nodes in proportion to their lumped mass, so that the mass of the cell is kept.
    moved       = complete;
    double kept = 0., lost = 0.;
    for (unsigned int a = 0; a < nodes.size(); ++a)
      for (unsigned int b = 0; b < nodes.size(); ++b)
        if (no_mass(nodes[a]) > 0. || no_mass(nodes[b]) > 0.)
          {
            lost += moved(a, b);
            moved(a, b) = 0.;
          }
        else if (a == b)
          kept += lumped[a];
    for (unsigned int a = 0; a < nodes.size() && lost > 0.; ++a)
      if (no_mass(nodes[a]) == 0.)
        moved(a, a) += lost * lumped[a] / kept;
  }
} // namespace Touchstone

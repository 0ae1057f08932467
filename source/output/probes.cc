// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/output/probes.h>
#include <touchstone/output/statistics_csv.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** How far, in parts of a cell, a point may lie outside: between the nodes of a curved boundary
     * cells are flatter than the body that they stand for. */
    constexpr double outside = 0.1;

    /** The name of a file of a probe, without what shells and file systems take for something. */
    std::string
    file_name(const std::string &name)
    {
      std::string result = "probe_" + name;
      for (char &c : result)
        if (c == ' ')
          c = '_';
      return result + ".csv";
    }

    double
    von_mises_of(const double *s)
    {
      return std::sqrt(
        0.5 * (std::pow(s[0] - s[1], 2) + std::pow(s[1] - s[2], 2) + std::pow(s[2] - s[0], 2)) +
        3. * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
    }

    const char *const columns =
      "displacement_x[length],displacement_y[length],displacement_z[length],"
      "stress_xx[force/length^2],stress_yy[force/length^2],stress_zz[force/length^2],"
      "stress_xy[force/length^2],stress_yz[force/length^2],stress_xz[force/length^2],"
      "von_mises[force/length^2]\n";

    std::string
    header(const ProbeParameters::Place place)
    {
      return std::string("time[time],") +
             (place == ProbeParameters::Place::boundary
                ? "area[length^2],"
                : "s[length],x[length],y[length],z[length],") +
             columns;
    }
  } // namespace



  Probes::Probes(const std::vector<ProbeParameters> &parameters,
                 const Forest                       &forest,
                 const Solid                        &solid)
    : solid(solid)
  {
    for (const ProbeParameters &one : parameters)
      {
        Probe probe{&one, 0, {}, {}};
        while (solid.bodies[probe.body].name != one.body)
          ++probe.body;
        if (one.place == ProbeParameters::Place::boundary)
          probe.boundary = forest.boundary(probe.body, one.boundary, one.section(), "Boundary");
        else
          {
            const unsigned int n = one.place == ProbeParameters::Place::line ? one.n_points : 1;
            for (unsigned int i = 0; i < n; ++i)
              {
                probe.points.emplace_back();
                probe.points.back().position = dealii::Point<dim>(
                  one.point + (n > 1 ? double(i) / (n - 1) : 0.) * (one.end - one.point));
              }
          }
        probes.push_back(probe);
        texts[one.name] = header(one.place);
      }
    reinit();
  }



  void
  Probes::reinit()
  {
    for (Probe &probe : probes)
      for (Point &point : probe.points)
        find(probe, point);
  }



  void
  Probes::find(const Probe &probe, Point &point) const
  {
    double closest = std::numeric_limits<double>::max();
    point.here     = false;
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && cell->material_id() == probe.body &&
          cell->center().distance(point.position) < cell->diameter())
        {
          dealii::Point<dim> unit;
          try
            {
              unit = solid.mapping.transform_real_to_unit_cell(cell, point.position);
            }
          catch (const Mapping<dim>::ExcTransformationFailed &)
            {
              continue; // far from this cell
            }
          const double distance = GeometryInfo<dim>::distance_to_unit_cell(unit);
          // The first of cells that have it in common.
          if (distance < outside && distance < closest - 1e-9)
            {
              closest    = distance;
              point.cell = cell;
              point.unit = GeometryInfo<dim>::project_to_unit_cell(unit);
              point.here = true;
            }
        }
    // Of the ranks that are closest, the first one has it.
    const MPI_Comm     communicator = solid.communicator;
    const double       best         = Utilities::MPI::min(closest, communicator);
    const unsigned int rank         = Utilities::MPI::this_mpi_process(communicator);
    const unsigned int who          = Utilities::MPI::min(
      point.here && closest <= best + 1e-9 ? rank : numbers::invalid_unsigned_int, communicator);
    if (who == numbers::invalid_unsigned_int)
      {
        std::string place;
        for (unsigned int d = 0; d < dim; ++d)
          place += (d == 0 ? "" : ", ") + all_digits(point.position[d]);
        throw InputError(probe.parameters->section(),
                         "Point",
                         place,
                         "this point is not in the body '" + probe.parameters->body + "'",
                         "give positions before deformation; 'touchstone --validate' without this "
                         "probe says where the body is");
      }
    point.here = who == rank;
  }



  std::vector<Probes::Values>
  Probes::at_points(const Probe &probe, const std::array<const Vector *, 3> &fields) const
  {
    std::vector<double> sums(n_values * probe.points.size(), 0.);
    for (std::size_t i = 0; i < probe.points.size(); ++i)
      if (const Point &point = probe.points[i]; point.here)
        {
          FEValues<dim> values(solid.mapping, solid.fe, Quadrature<dim>(point.unit), update_values);
          values.reinit(point.cell);
          std::vector<dealii::Vector<double>> result(1, dealii::Vector<double>(dim));
          for (unsigned int f = 0; f < fields.size(); ++f)
            {
              values.get_function_values(*fields[f], result);
              for (unsigned int d = 0; d < dim; ++d)
                sums[n_values * i + dim * f + d] = result[0](d);
            }
        }
    Utilities::MPI::sum(sums, solid.communicator, sums);
    std::vector<Values> all(probe.points.size());
    for (std::size_t i = 0; i < all.size(); ++i)
      std::copy_n(sums.begin() + n_values * i, n_values, all[i].begin());
    return all;
  }



  std::pair<Probes::Values, double>
  Probes::on_boundary(const Probe &probe, const std::array<const Vector *, 3> &fields) const
  {
    const QGauss<dim - 1> points(solid.fe.degree + 1);
    FEFaceValues<dim> values(solid.mapping, solid.fe, points, update_values | update_JxW_values);
    std::vector<dealii::Vector<double>> result(points.size(), dealii::Vector<double>(dim));
    std::vector<double>                 sums(n_values + 1, 0.);
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && cell->material_id() == probe.body)
        for (const unsigned int f : cell->face_indices())
          if (cell->at_boundary(f) && probe.boundary.count(cell->face(f)->boundary_id()) > 0)
            {
              values.reinit(cell, f);
              for (unsigned int field = 0; field < fields.size(); ++field)
                {
                  values.get_function_values(*fields[field], result);
                  for (const unsigned int q : values.quadrature_point_indices())
                    for (unsigned int d = 0; d < dim; ++d)
                      sums[dim * field + d] += values.JxW(q) * result[q](d);
                }
              for (const double weight : values.get_JxW_values())
                sums[n_values] += weight;
            }
    Utilities::MPI::sum(sums, solid.communicator, sums);
    Values means;
    for (unsigned int i = 0; i < n_values; ++i)
      means[i] = sums[i] / sums[n_values];
    return {means, sums[n_values]};
  }



  void
  Probes::record(const OutputFolder &folder,
                 VolumeOutput       &volume,
                 const Vector       &displacement,
                 const double        time)
  {
    if (probes.empty())
      return;
    const std::array<Vector, 2>         stress = volume.nodal_stress(displacement);
    const std::array<const Vector *, 3> fields = {{&displacement, &stress[0], &stress[1]}};
    const auto                          add =
      [](std::string &text, const std::vector<double> &before, const Values &values) {
        for (const double value : before)
          text += all_digits(value) + ",";
        for (const double value : values)
          text += all_digits(value) + ",";
        text += all_digits(von_mises_of(values.data() + dim)) + "\n";
      };
    for (const Probe &probe : probes)
      {
        std::string &text = texts.at(probe.parameters->name);
        if (probe.points.empty())
          {
            const auto [means, area] = on_boundary(probe, fields);
            add(text, {time, area}, means);
          }
        else
          {
            const std::vector<Values> values = at_points(probe, fields);
            for (std::size_t i = 0; i < values.size(); ++i)
              {
                const dealii::Point<dim> &x = probe.points[i].position;
                add(text,
                    {time, x.distance(probe.points.front().position), x[0], x[1], x[2]},
                    values[i]);
              }
          }
        folder.write_file_atomically(file_name(probe.parameters->name), text);
      }
  }
} // namespace Touchstone

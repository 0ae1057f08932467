// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/contact/contact_checks.h>
#include <touchstone/drive/informed_solver.h>
#include <touchstone/drive/model_report.h>
#include <touchstone/output/progress.h>
#include <touchstone/scene/pair_input.h>
#include <touchstone/solid/bodies.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A number with few digits, without the sign of a zero. */
    std::string
    readable(const double value)
    {
      char text[40];
      std::snprintf(text, sizeof(text), "%.6g", value + 0.);
      return text;
    }

    /** Counts and integrals, summed over the ranks. */
    struct Sums
    {
      std::vector<double> cells, volumes, faces, areas;
    };

    /** Of bodies, and of boundaries by their ids. Sums over ranks are in their order, so that the
     * last digits, which are not shown, are all that depends on it. */
    Sums
    measure(const Solid &solid)
    {
      const QGauss<dim>     points(solid.fe.degree + 1);
      const QGauss<dim - 1> face_points(solid.fe.degree + 1);
      FEValues<dim>         cell_values(solid.mapping, solid.fe, points, update_JxW_values);
      FEFaceValues<dim>     face_values(solid.mapping, solid.fe, face_points, update_JxW_values);

      types::boundary_id largest = 0;
      for (const auto &cell : solid.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int f : cell->face_indices())
            if (cell->at_boundary(f))
              largest = std::max(largest, cell->face(f)->boundary_id());
      const std::size_t   n        = Utilities::MPI::max(largest, solid.communicator) + 1;
      const std::size_t   n_bodies = solid.bodies.size();
      std::vector<double> sums(2 * (n_bodies + n), 0.);
      for (const auto &cell : solid.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            cell_values.reinit(cell);
            sums[cell->material_id()] += 1.;
            for (const double weight : cell_values.get_JxW_values())
              sums[n_bodies + cell->material_id()] += weight;
            for (const unsigned int f : cell->face_indices())
              if (cell->at_boundary(f))
                {
                  face_values.reinit(cell, f);
                  const std::size_t at = 2 * n_bodies + cell->face(f)->boundary_id();
                  sums[at] += 1.;
                  for (const double weight : face_values.get_JxW_values())
                    sums[at + n] += weight;
                }
          }
      Utilities::MPI::sum(sums, solid.communicator, sums);
      const auto part = [&sums](const std::size_t from, const std::size_t length) {
        return std::vector<double>(sums.begin() + from, sums.begin() + from + length);
      };
      return {part(0, n_bodies),
              part(n_bodies, n_bodies),
              part(2 * n_bodies, n),
              part(2 * n_bodies + n, n)};
    }

    std::string
    extent(const BoundingBox<dim> &box)
    {
      const auto &[low, high] = box.get_boundary_points();
      std::string text;
      for (unsigned int d = 0; d < dim; ++d)
        text += std::string(d == 0 ? "" : ", ") + "xyz"[d] + " " + readable(low[d]) + " to " +
                readable(high[d]);
      return text;
    }

    /** How many corners of cells of the mesh file a set has, and where. */
    std::string
    extent_of_set(const Forest::NodeSet &set)
    {
      std::vector<Point<dim>> points;
      for (const auto &x : set)
        points.emplace_back(x[0], x[1], x[2]);
      return std::to_string(points.size()) + (points.size() == 1 ? " node" : " nodes") +
             (points.empty() ? "" : ", " + extent(BoundingBox<dim>(points)));
    }
  } // namespace



  std::vector<std::string>
  describe_bodies(const Scene &scene, const Forest &forest, const Solid &solid)
  {
    const Sums                          sums  = measure(solid);
    const std::vector<BoundingBox<dim>> boxes = body_boxes(solid);
    std::vector<std::string>            lines;
    for (unsigned int b = 0; b < scene.bodies.size(); ++b)
      {
        const BodyParameters &body = scene.bodies[b];
        std::string line = "body " + body.name + ": " + readable(sums.cells[b]) + " cells, " +
                           body.element_type.word() + ", " + extent(boxes[b]) + "; volume " +
                           readable(sums.volumes[b]);
        if (body.material.density > 0.)
          line += ", mass " + readable(body.material.density * sums.volumes[b]);
        lines.push_back(line);
        // Each boundary once: by its name if it has one.
        for (const auto &[ids, name] : forest.names_of_boundaries(b))
          {
            double faces = 0., area = 0.;
            for (const types::boundary_id id : ids)
              if (id < sums.faces.size())
                {
                  faces += sums.faces[id];
                  area += sums.areas[id];
                }
            lines.push_back("  boundary " + name + ": " + readable(faces) + " faces, area " +
                            readable(area));
          }
        for (const std::string &name : forest.names_of_node_sets(b))
          lines.push_back("  set of nodes " + name + ": " +
                          extent_of_set(forest.node_set(b, name)));
      }
    return lines;
  }



  std::string
  expected_cost(const Scene &scene, const Solid &solid, const CycleCounts *cycles)
  {
    const double n        = solid.dof_handler.n_dofs(),
                 mesh     = solid.dof_handler.get_triangulation().n_global_active_cells();
    double      megabytes = 200., seconds = 0.;
    std::string what;
    if (cycles != nullptr)
      {
        // doc/explicit.md, section 8.
        const bool cheap =
          std::all_of(scene.bodies.begin(), scene.bodies.end(), [](const BodyParameters &body) {
            return body.element() == ElementType::one_point;
          });
        megabytes += (cheap ? 1.9e-3 : 4e-3) * mesh;
        // Equal cycles up to the end of each interval, as they are made.
        double n_cycles = 0., before = 0.;
        for (const LoadPhase &phase : scene.load_stepping.all_phases())
          {
            n_cycles +=
              phase.steps *
              std::ceil((phase.end_time - before) / phase.steps /
                        (scene.time_integration.cycles.courant_factor * cycles->stable_step) *
                        (1. - 1e-9));
            before = phase.end_time;
          }
        seconds = (cheap ? 0.25e-6 : 0.6e-6) * mesh * n_cycles;
        what    = " for all of about " + readable(n_cycles) + " cycles";
      }
    else
      {
        // Measured with two_tubes.prm, one step, elastic and neo-Hookean; doc/benchmarks.md.
        const bool factors =
          scene.linear_solver.type == "MUMPS" ||
          (scene.linear_solver.type == "automatic" &&
           (n < 10000. || informed_solver(scene).prefers_factors(static_cast<int>(n)) ||
            scene.contact.enforcement.name == "lagrange multipliers"));
        megabytes += factors ? 107. * std::pow(n / 12000., 1.25) : 2.15e-3 * n;
        seconds = factors ? 0.2 * std::pow(n / 12000., 1.67) : 4e-6 * n;
        if (!solid.linear())
          seconds += 5e-6 * n * (scene.discretisation.degree > 1 ? 4. : 1.);
        what = std::string(" for each iteration of Newton's method, ") +
               (factors ? "with a factorisation" : "with multigrid");
      }
    char text[120];
    std::snprintf(text, sizeof(text), "%.2g GB of memory and ", megabytes / 1000.);
    return "expected, to the order of magnitude and on one core: " + std::string(text) +
           (seconds < 0.1 ? "less than 0.1 s" : readable_duration(seconds)) + what;
  }



  std::vector<std::string>
  describe_gaps(const Scene &scene, const Forest &forest, const Solid &solid)
  {
    if (scene.pairs.empty())
      return {};
    const BoundaryConditions conditions(forest, solid);
    ContactParameters        parameters = scene.contact;
    // Any of implicit runs: the gaps are there before it does anything.
    parameters.enforcement = std::string("elimination");
    try
      {
        Contact contact(pair_inputs(scene, forest, solid),
                        parameters,
                        solid,
                        conditions.mirrors(),
                        conditions.supported_directions());
        contact.update(solid.zero_vector(), 0.);
        return start_report(contact);
      }
    catch (const InputError &error)
      {
        // What an implicit run would refuse may be all right here.
        return {std::string("gaps cannot be told: ") + error.what()};
      }
  }
} // namespace Touchstone

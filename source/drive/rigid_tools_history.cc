// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/archive/archive.h>
#include <touchstone/base/input_error.h>
#include <touchstone/drive/rigid_tools.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>

// How runs with obstacles that forces move begin, and what is kept of their steps.
namespace Touchstone
{
  using namespace dealii;

  RigidTools::RigidTools(const std::vector<ObstacleParameters> &obstacles,
                         const TimeIntegrationParameters       &time_integration,
                         const double                           residual_tolerance,
                         const Contact                         &contact)
    : residual_tolerance(residual_tolerance)
    , contact(contact)
    , tools(rigid_tools(obstacles, contact))
  {
    if (time_integration.dynamic())
      scheme = time_integration.coefficients();
    for (unsigned int t = 0; t < tools.size(); ++t)
      {
        RigidTool::State           &state = tools[t].committed;
        const FreeMotionParameters &free  = tools[t].free();
        Tensor<1, dim>              momentum, spin;
        for (unsigned int d = 0; d < dim; ++d)
          {
            spin[d]     = free.angular_velocity[d];
            momentum[d] = free.inertia[d] * spin[d];
          }
        const Tensor<1, dim> gyroscopic = cross_product_3d(spin, momentum);
        for (unsigned int c = 0; c < RigidTool::n_components; ++c)
          if (free.is_free(c))
            {
              unknowns.push_back({t, c, c < dim ? 1. : tools[t].length()});
              if (!scheme)
                continue;
              state.velocity[c] = free.start(c);
              state.acceleration[c] =
                (state.load[c] - (c < dim ? 0. : gyroscopic[c - dim])) / free.resistance(c);
            }
        tools[t].present = state;
      }
  }



  void
  RigidTools::start()
  {
    if (tools.empty())
      return;
    const std::vector<PairResult> results = pair_results(contact, contact.ghosted_displacement());
    for (RigidTool &tool : tools)
      tool.committed.contact = tool.present.contact = tool.force_of_bodies(results, 0.);
    if (!scheme)
      check_resistance();
  }



  void
  RigidTools::check_resistance() const
  {
    for (unsigned int t = 0; t < tools.size(); ++t)
      {
        std::vector<Unknown> own;
        for (const Unknown &unknown : unknowns)
          if (unknown.tool == t)
            own.push_back(unknown);
        const unsigned int   n = own.size();
        std::vector<double>  sums(n * n);
        const Point<dim>     centre = tools[t].centre(0.);
        const Tensor<2, dim> axes(unit_symmetric_tensor<dim>());
        for (const unsigned int p : tools[t].pairs())
          for (const ContactRow &row : contact.pair(p).rows())
            if (row.has_partner)
              {
                std::vector<Tensor<1, dim>> ways;
                for (const Unknown &unknown : own)
                  {
                    const Tensor<1, dim> axis = axes[unknown.component % dim];
                    const Tensor<1, dim> way =
                      unknown.component < dim
                        ? axis
                        : cross_product_3d(axis, Tensor<1, dim>(contact_point(row) - centre));
                    // What resists acts along the normal, or in all directions.
                    const bool all = row.friction != nullptr && row.friction->law != nullptr;
                    ways.push_back((row.tied || all ? way : (way * row.normal) * row.normal) /
                                   unknown.scale);
                  }
                for (unsigned int i = 0; i < n; ++i)
                  for (unsigned int k = 0; k < n; ++k)
                    sums[i * n + k] += ways[i] * ways[k];
              }
        LAPACKFullMatrix<double> matrix(n, n);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int k = 0; k < n; ++k)
            matrix(i, k) = Utilities::MPI::sum(sums[i * n + k], contact.communicator());
        matrix.compute_svd();
        if (matrix.singular_value(n - 1) > 1e-12 * matrix.singular_value(0))
          continue;
        unsigned int main = 0;
        for (unsigned int k = 0; k < n; ++k)
          if (std::abs(matrix.get_svd_vt()(n - 1, k)) > std::abs(matrix.get_svd_vt()(n - 1, main)))
            main = k;
        throw InputError(tools[t].section(),
                         "Free directions",
                         FreeMotionParameters::word(own[main].component),
                         "nothing resists this motion: the surface moves along itself, and no pair "
                         "has friction",
                         "remove the direction, or give a contact pair of the obstacle friction");
      }
  }



  std::map<std::string, RigidToolResult>
  RigidTools::results() const
  {
    std::map<std::string, RigidToolResult> all;
    for (const RigidTool &tool : tools)
      all[tool.name()] = tool.result(tool.present, time, scheme.has_value());
    return all;
  }



  void
  RigidTools::commit()
  {
    for (RigidTool &tool : tools)
      tool.committed = tool.present;
    committed_inverse = broyden.inverse;
    committed_time    = time;
    committed_step    = step;
  }



  void
  RigidTools::rollback()
  {
    for (RigidTool &tool : tools)
      {
        tool.present = tool.committed;
        tool.place(tool.present);
      }
  }



  RigidTools::Transfer
  RigidTools::transfer() const
  {
    Transfer result;
    for (const RigidTool &tool : tools)
      result.states.push_back(tool.committed);
    result.inverse = committed_inverse;
    result.step    = committed_step;
    result.time    = committed_time;
    result.guess   = broyden.x();
    return result;
  }



  void
  RigidTools::adopt(const Transfer &before)
  {
    for (unsigned int k = 0; k < tools.size(); ++k)
      tools[k].committed = before.states[k];
    committed_inverse = before.inverse;
    committed_step    = before.step;
    committed_time = time = before.time;
    rollback();
  }



  void
  RigidTools::continue_at(const double t, const Numbers &of_other_mesh)
  {
    if (tools.empty())
      return;
    time = t;
    broyden.begin(of_other_mesh);
    place();
    guess = of_other_mesh;
  }



  void
  RigidTools::save(ArchiveWriter &archive) const
  {
    if (!tools.empty())
      archive.put("rigid tools", transfer());
  }



  void
  RigidTools::load(const ArchiveReader &archive)
  {
    if (!tools.empty())
      adopt(archive.get<Transfer>("rigid tools"));
  }
} // namespace Touchstone

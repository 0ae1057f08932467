// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/summary.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <sstream>

/**
 * @file
 * Output of the summary: JSON for programs, and text for users and tests. Printed numbers
 * are rounded so that runs with other solvers, ranks or machines print the same text.
 */

namespace Touchstone
{
  namespace
  {
    /** Relative size below which printed digits are taken for round-off. */
    constexpr double round_off = 1e-9;
    /**
     * Penetrations are converged to this fraction of a face (doc/theory.md 5, equation (13)); below
     * it the figure is arbitrary.
     */
    constexpr double gap_round_off = 1e-8;

    /** Magnitude of a vector for the scale of round-off: its components are rounded one by one. */
    double
    largest_component(const dealii::Tensor<1, dim> &value)
    {
      return std::max({std::abs(value[0]), std::abs(value[1]), std::abs(value[2])});
    }



    /** Round to multiples of about round_off * scale, so that small components
     * do not show the digits in which two solvers differ, and print six digits. */
    std::string
    rounded(double value, const double scale, const double tolerance = round_off)
    {
      if (!std::isfinite(value))
        return "none";
      if (scale > 0.)
        {
          // The quantum is a power of ten: the same for all values of about the same scale.
          const double quantum = tolerance * std::pow(10., std::ceil(std::log10(scale)));
          value                = std::round(value / quantum) * quantum;
        }
      std::ostringstream out;
      out.imbue(std::locale::classic());
      // Adding zero turns -0 into 0.
      out << std::setprecision(6) << value + 0.;
      return out.str();
    }



    std::string
    rounded(const dealii::Tensor<1, dim> &value, const double scale)
    {
      std::ostringstream out;
      for (unsigned int d = 0; d < dim; ++d)
        out << ' ' << std::setw(12) << rounded(value[d], scale);
      return out.str();
    }



    /** A registered quantity: whole number, number or vector. */
    Json
    to_json(const StepValue &value)
    {
      if (value.kind == StepValue::count)
        return Json(static_cast<unsigned int>(value.components[0]));
      if (value.kind == StepValue::number)
        return Json(value.components[0]);
      return Json(
        dealii::Tensor<1, dim>({value.components[0], value.components[1], value.components[2]}));
    }

    /** Names of members have no blanks. */
    std::string
    member_name(std::string name)
    {
      std::replace(name.begin(), name.end(), ' ', '_');
      return name;
    }



    /** Results of the contact pairs by their names, with the registered quantities. */
    Json
    contact_results(const RunSummary &summary)
    {
      Json pairs = Json::object();
      for (const auto &[name, result] : summary.contact)
        {
          Json pair = Json::object()
                        .set("force", result.force)
                        .set("moment", result.moment)
                        .set("area", result.area)
                        .set("max_pressure", result.max_pressure)
                        .set("max_penetration", result.max_penetration)
                        .set("active", result.active);
          for (const StepValue &value : summary.quantities)
            if (value.pair == name)
              pair.set(member_name(value.name), to_json(value));
          pairs.set(name, pair);
        }
      return pairs;
    }


    /** Members of an object from a map of names. */
    template <class Map>
    Json
    object_of(const Map &members)
    {
      Json result = Json::object();
      for (const auto &[name, value] : members)
        result.set(name, value);
      return result;
    }



    Json
    reactions_of(const RunSummary &summary)
    {
      Json bodies = Json::object();
      for (const auto &[body, boundaries] : summary.reactions)
        bodies.set(body, object_of(boundaries));
      return bodies;
    }



    /** Mean and maximum over the ranks: an imbalance of 1 is even, of the number of ranks the
     * worst. */
    Json
    balance_of(const RunSummary &summary)
    {
      Json spread = Json::object();
      for (const auto &[phase, counts] : summary.balance)
        spread.set(phase,
                   Json::object()
                     .set("mean", counts.mean)
                     .set("max", counts.max)
                     .set("imbalance", counts.imbalance()));
      return spread;
    }



    /** Of adaptive runs: cells, unknowns and estimated error of each mesh, from which the rate of
     * convergence follows. */
    Json
    meshes_of(const RunSummary &summary)
    {
      Json result = Json::array();
      for (const RunSummary::Mesh &mesh : summary.meshes)
        result.append(Json::object()
                        .set("step", mesh.step)
                        .set("cells", mesh.cells)
                        .set("unknowns", mesh.unknowns)
                        .set("estimated_error", mesh.estimated_error));
      return result;
    }



    /** Quantities of contact pairs stand with their pair, those of the whole scene beside them. */
    Json
    results_of(const RunSummary &summary)
    {
      Json result = Json::object()
                      .set("contact", contact_results(summary))
                      .set("reactions", reactions_of(summary));
      if (!summary.plastic_strain.empty())
        result.set("plastic_strain", object_of(summary.plastic_strain));
      for (const StepValue &value : summary.quantities)
        if (value.pair.empty())
          result.set(member_name(value.name), to_json(value));
      return result;
    }



    /** Of explicit runs. */
    void
    add_cycles(const RunSummary &summary, Json &result)
    {
      if (summary.cycles > 0)
        result.set("cycles", summary.cycles);
      const auto &work = summary.contact_work;
      if (work.cycles > 0)
        result.set("contact_work",
                   Json::object()
                     .set("mean_sweeps", work.mean_sweeps())
                     .set("most_sweeps", work.most_sweeps)
                     .set("rounds", work.rounds)
                     .set("renewals", work.renewals)
                     .set("unconverged_cycles", work.unconverged)
                     .set("most_energy_given_in_a_cycle", work.most_given));
      if (work.search.searches > 0)
        result.set("general_contact",
                   Json::object()
                     .set("checks_of_crossings", work.crossing_rounds)
                     .set("most_checks_in_a_cycle", work.most_crossing_rounds)
                     .set("cycles_with_more_than_five", work.many_crossing_rounds)
                     .set("halvings", work.halvings)
                     .set("most_candidates", work.search.candidates)
                     .set("searches", work.search.searches)
                     .set("faces_sent", work.search.faces_sent)
                     .set("messages", work.search.messages)
                     .set("largest_region_over_mean", work.search.imbalance));
    }
  } // namespace



  Json
  RunSummary::to_json() const
  {
    Json all_warnings = Json::array();
    for (const std::string &text : warnings)
      all_warnings.append(text);

    Json result = Json::object()
                    .set("title", title)
                    .set("version", version)
                    .set("converged", converged)
                    .set("ranks", ranks)
                    .set("cells", cells)
                    .set("unknowns", unknowns);
    if (!meshes.empty())
      result.set("meshes", meshes_of(*this));
    if (motion)
      result.set("motion", motion->to_json());
    result.set("steps", steps);
    if (!phases.empty())
      {
        Json list = Json::array();
        for (const auto &[name, end] : phases)
          list.append(Json::object().set("name", name).set("end_time", end));
        result.set("phases", list);
      }
    add_cycles(*this, result);
    return result
      .set("iterations",
           Json::object()
             .set("newton", iterations.newton)
             .set("contact", iterations.contact)
             .set("damped", iterations.damped)
             .set("linear_total", iterations.linear_total)
             .set("linear_mean", iterations.linear_mean))
      .set("counts",
           Json::object()
             .set("assemblies", counts.assemblies)
             .set("factorisations", counts.factorisations)
             .set("preconditioner_setups", counts.preconditioner_setups)
             .set("searches", counts.searches))
      .set("seconds",
           Json::object()
             .set("wall", seconds.wall)
             .set("cpu", seconds.cpu)
             .set("assembly", seconds.assembly)
             .set("linear_solver", seconds.linear_solver)
             .set("search", seconds.search)
             .set("output", seconds.output))
      .set("balance", balance_of(*this))
      .set("peak_memory_mb", peak_memory_mb)
      .set("results", results_of(*this))
      .set("errors", object_of(errors))
      .set("warnings", all_warnings)
      .set("failure", failure);
  }



  std::string
  RunSummary::balance_line() const
  {
    std::ostringstream line;
    line.imbue(std::locale::classic());
    line << "Largest over mean of " << ranks << " ranks:" << std::fixed << std::setprecision(2);
    std::string separator = " ";
    for (const auto &[phase, counts] : balance)
      {
        std::string name = phase;
        std::replace(name.begin(), name.end(), '_', ' ');
        line << separator << name << ' ' << counts.imbalance();
        separator = ", ";
      }
    return line.str();
  }



  void
  RunSummary::print_results(std::ostream &out, const bool with_iterations) const
  {
    // Scales of round-off are the largest components of all forces and of all moments: a lateral
    // force that is zero by symmetry is round-off relative to the normal one.
    double force_scale = 0., moment_scale = 0.;
    for (const auto &[name, result] : contact)
      {
        force_scale  = std::max(force_scale, largest_component(result.force));
        moment_scale = std::max(moment_scale, largest_component(result.moment));
      }
    for (const auto &[body, boundaries] : reactions)
      for (const auto &[boundary, force] : boundaries)
        force_scale = std::max(force_scale, largest_component(force));

    out << (converged     ? "Converged"
            : interrupted ? "INTERRUPTED"
                          : "NOT CONVERGED")
        << ": " << steps << " steps";
    if (with_iterations && cycles > 0)
      out << ", " << cycles << " cycles";
    else if (with_iterations)
      out << ", " << iterations.newton << " Newton iterations";
    if (with_iterations && iterations.damped > 0)
      out << ", " << iterations.damped << " with a shorter increment";
    out << '\n';
    if (!failure.empty())
      out << "  " << failure << '\n';

    for (const auto &[name, result] : contact)
      out << "Contact " << name << '\n'
          << "  force          " << rounded(result.force, force_scale) << '\n'
          << "  moment         " << rounded(result.moment, moment_scale) << '\n'
          << "  area            " << std::setw(12) << rounded(result.area, result.area) << '\n'
          << "  max pressure    " << std::setw(12)
          << rounded(result.max_pressure,
                     // The mean pressure bounds the scale from below: a maximum that is zero by
                     // cancellation would have no scale of its own.
                     std::max(result.max_pressure,
                              result.area > 0. ? result.force.norm() / result.area : 0.))
          << '\n'
          << "  max penetration " << std::setw(12)
          << rounded(result.max_penetration, std::sqrt(result.area), gap_round_off) << '\n'
          << "  active nodes    " << std::setw(12) << result.active << '\n';

    for (const auto &[body, boundaries] : reactions)
      for (const auto &[boundary, force] : boundaries)
        out << "Reaction " << body << ", " << boundary << '\n'
            << "  force          " << rounded(force, force_scale) << '\n';

    if (motion)
      motion->print(out);
    for (const auto &[body, strain] : plastic_strain)
      out << "Plastic strain " << body << ": " << rounded(strain, strain) << '\n';

    for (const auto &[name, error] : errors)
      // Relative already, so that the scale is one.
      out << "Error " << name << ": " << rounded(error, 1.) << '\n';
  }
} // namespace Touchstone

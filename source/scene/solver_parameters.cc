#include <touchstone/base/input_error.h>
#include <touchstone/scene/expression.h>
#include <touchstone/scene/solver_parameters.h>

#include <deal.II/base/utilities.h>

#include <cmath>

namespace Touchstone
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  namespace
  {
    void
    check_positive(const std::string &section,
                   const std::string &key,
                   const double       value,
                   const std::string &remedy)
    {
      if (value <= 0.)
        throw InputError(
          section, key, Patterns::Tools::to_string(value), "must be positive", remedy);
    }
  } // namespace



  void
  DiscretisationParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Degree",
                      degree,
                      "Polynomial degree of the hexahedra, 1 or 2, for all bodies.",
                      Patterns::Integer(1, 2));
    prm.add_parameter("Refinement factor",
                      refinement_factor,
                      "Multiplies the number of cells per direction of the built-in "
                      "geometries; powers of two refine the mesh with its "
                      "manifolds. Meshes from files accept only those.",
                      Patterns::Double(0.));
    prm.add_parameter(
      "Partitioner",
      partitioner,
      "How cells are spread over ranks: 'coordinates' cuts across the longest side, "
      "and the halves again; 'p4est' cuts its space-filling curve, which goes "
      "through one body after the other, and can refine the mesh; 'automatic' is "
      "'p4est' where the run refines, 'coordinates' elsewhere; 'METIS' cuts the "
      "graph of cells and faces, with cells and contact work balanced each for "
      "itself; 'METIS, cells only' leaves contact out. The results are the same.",
      Patterns::Selection("automatic|coordinates|p4est|METIS|METIS, cells only"));
    prm.add_parameter("Contact weight",
                      contact_weight,
                      "Work of a slave face over that of a cell, for 'coordinates' and 'p4est'; "
                      "a master face counts a quarter of it. [no unit]",
                      Patterns::Double(0., 1000.));
  }



  void
  DiscretisationParameters::check(const std::string &section) const
  {
    check_positive(section,
                   "Refinement factor",
                   refinement_factor,
                   "1 takes the cells as they are given, 2 halves their size");
#ifndef TOUCHSTONE_WITH_METIS
    if (partitioner == "METIS" || partitioner == "METIS, cells only")
      throw InputError(section,
                       "Partitioner",
                       partitioner,
                       "this program was built without METIS",
                       "set it to 'automatic', or install libmetis-dev and build again");
#endif
  }



  void
  RefinementParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Estimator",
                      estimator,
                      "Where the mesh is refined: 'none' leaves it as it is; 'Kelly' looks at the "
                      "jumps of stress between cells, 'recovered stress' at the distance from "
                      "stress to averaged stress (Zienkiewicz-Zhu), both also at the contact; "
                      "'region' takes what 'Region' says alone.",
                      Patterns::Selection("none|region|Kelly|recovered stress"));
    prm.add_parameter("Cycles",
                      cycles,
                      "How often the first load step is solved, the mesh refined by what came out, "
                      "and the step solved again.",
                      Patterns::Integer(0, 20));
    prm.add_parameter("Cycles per step",
                      cycles_per_step,
                      "The same for each later step, in which the mesh may also be coarsened where "
                      "contact has moved on.",
                      Patterns::Integer(0, 20));
    prm.add_parameter("Refine fraction",
                      refine_fraction,
                      "The cells with the largest estimated errors that make up this share of the "
                      "sum of squares are refined. [no unit]",
                      Patterns::Double(0., 1.));
    prm.add_parameter("Contact fraction",
                      contact_fraction,
                      "The slave faces over which the contact pressure varies most, and that make "
                      "up this share of the sum of its squared variations, are refined, with the "
                      "master faces that meet them. [no unit]",
                      Patterns::Double(0., 1.));
    prm.add_parameter("Coarsen fraction",
                      coarsen_fraction,
                      "The cells with the smallest errors that make up this share may be joined "
                      "again, but never beyond the mesh that the run began with. [no unit]",
                      Patterns::Double(0., 1.));
    prm.add_parameter("Maximum level",
                      maximum_level,
                      "A cell of the first mesh is halved at most this many times.",
                      Patterns::Integer(0, 8));
    prm.add_parameter("Maximum cells",
                      maximum_cells,
                      "With more cells than about this the mesh is refined no further.",
                      Patterns::Integer(1));
    prm.add_parameter("Tolerance",
                      tolerance,
                      "Refinement ends when the estimated error of the stress, relative in the "
                      "energy norm, falls below this; 0 goes through all cycles. [no unit]",
                      Patterns::Double(0., 1.));
    prm.add_parameter("Region",
                      region,
                      "Formula of x, y, z and t: cells at whose centre it is positive are refined "
                      "in each cycle.",
                      Patterns::Anything());
  }



  void
  RefinementParameters::check(const std::string &section) const
  {
    if (estimator == "region" && region.empty())
      throw InputError(section,
                       "Region",
                       region,
                       "'Estimator = region' needs to know where",
                       "give a formula of x, y, z and t, e.g. 'Region = 0.1 - z'");
    if (!region.empty())
      check_expression(section, "Region", region);
    if (active() && refine_fraction + coarsen_fraction > 1.)
      throw InputError(section,
                       "Coarsen fraction",
                       Patterns::Tools::to_string(coarsen_fraction),
                       "makes more than the whole together with 'Refine fraction'",
                       "take less, 0.02 is usual");
  }



  void
  LoadSteppingParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("End time",
                      end_time,
                      "The time t in formulas runs from 0 to here. [time]",
                      Patterns::Double(0.));
    prm.add_parameter("Steps",
                      steps,
                      "Number of equal steps when none has to be cut.",
                      Patterns::Integer(1));
    prm.add_parameter("Maximum cuts",
                      maximum_cuts,
                      "A step that does not converge is halved at most this many "
                      "times in a row.",
                      Patterns::Integer(0, 30));
  }



  void
  LoadSteppingParameters::check(const std::string &section) const
  {
    check_positive(section, "End time", end_time, "1 is as good as any other");
  }



  void
  NewtonParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Residual tolerance",
                      residual_tolerance,
                      "Largest out-of-balance force, relative to the forces that "
                      "act. [no unit]",
                      Patterns::Double(0., 1.));
    prm.add_parameter("Gap tolerance",
                      gap_tolerance,
                      "Largest gap or penetration of an active node, relative to "
                      "the size of the slave faces. [no unit]",
                      Patterns::Double(0., 1.));
    prm.add_parameter("Maximum iterations",
                      maximum_iterations,
                      "A step that needs more Newton iterations is cut.",
                      Patterns::Integer(1));
    prm.add_parameter("Line search",
                      line_search,
                      "'automatic' halves an increment that leaves the forces much further out of "
                      "balance than they were while no contact row changes; 'none' takes "
                      "every increment in full.",
                      Patterns::Selection("automatic|none"));
  }



  void
  NewtonParameters::check(const std::string &section) const
  {
    const std::string remedy = "round-off ends at about 1e-12, 1e-9 is usual";
    // What is no better than this is no solution.
    constexpr double coarsest = 1e-2;
    for (const auto &[key, tolerance] : {std::make_pair("Residual tolerance", residual_tolerance),
                                         std::make_pair("Gap tolerance", gap_tolerance)})
      {
        check_positive(section, key, tolerance, remedy);
        if (!(tolerance < coarsest))
          throw InputError(section,
                           key,
                           Patterns::Tools::to_string(tolerance),
                           "is so large that what is no solution would count as one",
                           "give less than " + Patterns::Tools::to_string(coarsest) + "; " +
                             remedy);
      }
  }



  void
  LinearSolverParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Type",
                      type,
                      "'MUMPS' factorises; 'Belos CG' and 'Belos GMRES' iterate with "
                      "multigrid, for large models without multipliers: CG takes "
                      "symmetric systems, GMRES also unsymmetric ones. 'automatic' takes, from "
                      "10,000 unknowns on and without multipliers, CG for symmetric systems and "
                      "GMRES for unsymmetric ones, and MUMPS otherwise or if these would take "
                      "longer, which the log says.",
                      Patterns::Selection("automatic|MUMPS|Belos CG|Belos GMRES"));
    prm.add_parameter("Tolerance",
                      tolerance,
                      "Relative residual to which an iterative solver takes the linear "
                      "system of a Newton iteration. Newton's own 'Residual tolerance' "
                      "decides how exact the result is. [no unit]",
                      Patterns::Double(0., 1.));
    prm.add_parameter("Maximum iterations",
                      maximum_iterations,
                      "Of Belos CG or GMRES in one solve.",
                      Patterns::Integer(1));
    prm.add_parameter("Restart",
                      restart,
                      "GMRES starts anew after this many iterations. It keeps two vectors "
                      "for each of them.",
                      Patterns::Integer(1));
    prm.add_parameter("Preconditioner",
                      preconditioner,
                      "Of Belos CG or GMRES: 'multigrid' by smoothed aggregation, in whose place "
                      "they keep the factors of a matrix where it would be slow; 'diagonal' "
                      "multiplies by the inverse 3 x 3 diagonal blocks of the nodes, many times "
                      "as slow, to compare with published work.",
                      Patterns::Selection("multigrid|diagonal"));
    prm.add_parameter("Contact operator",
                      contact_operator,
                      "How an iterative solver multiplies: 'applied' applies constraints and "
                      "contact terms beside the continuum matrix, and assembles all in "
                      "one matrix only where multigrid is set up; 'assembled' does so in each "
                      "Newton iteration.",
                      Patterns::Selection("applied|assembled"));
    prm.add_parameter(
      "Low rank tolerance",
      low_rank_tolerance,
      "MUMPS compresses the blocks of its factors, up to this relative error: less "
      "memory for large models, at about the same time; 0: not at all. 1e-8 costs no "
      "Newton iteration. [no unit]",
      Patterns::Double(0., 1e-2));
    prm.add_parameter("Out of core",
                      out_of_core,
                      "MUMPS keeps its factors in files, in the folder that the environment "
                      "variable MUMPS_OOC_TMPDIR names or in /tmp: for models that memory has "
                      "no room for.",
                      Patterns::Bool());
  }



  void
  LinearSolverParameters::check(const std::string &section) const
  {
    check_positive(section,
                   "Tolerance",
                   tolerance,
                   "two to four digits a Newton iteration are usual: 1e-3");
    if (preconditioner != "multigrid" && !iterative())
      throw InputError(section,
                       "Preconditioner",
                       preconditioner,
                       "is for solvers that iterate, but 'Type' is '" + type + "'",
                       "remove it, or set 'Type' to 'Belos CG' or 'Belos GMRES'");
    if (iterative())
      for (const auto &[key, set, value] :
           {std::make_tuple("Low rank tolerance",
                            low_rank_tolerance > 0.,
                            Patterns::Tools::to_string(low_rank_tolerance)),
            std::make_tuple("Out of core", out_of_core, std::string("true"))})
        if (set)
          throw InputError(section,
                           key,
                           value,
                           "is an option of MUMPS, but 'Type' is '" + type + "'",
                           "remove it, or set 'Type' to 'MUMPS'");
  }



  void
  OutputParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Directory",
                      directory,
                      "Folder for all output; empty: output/STEM for a scene file "
                      "STEM.prm.",
                      Patterns::Anything());
    prm.add_parameter("VTU interval",
                      vtu_interval,
                      "Pictures (solution.pvd, contact.pvd) every so many steps and "
                      "at the end; 0: never.",
                      Patterns::Integer(0));
  }



  void
  OutputParameters::check(const std::string &) const
  {
  }



  void
  CheckpointParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Steps between",
                      steps_between,
                      "Write a checkpoint, from which --resume goes on, every so many steps and at "
                      "the end; 0: not by steps.",
                      Patterns::Integer(0));
    prm.add_parameter("Minutes between",
                      minutes_between,
                      "Write a checkpoint after a step if the last one is this long ago, and at "
                      "the end; 0: not by time. [minutes]",
                      Patterns::Double(0.));
  }



  void
  ReferenceParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Type",
                      type,
                      "The exact solution that the result is compared with; 'none' "
                      "compares with nothing.",
                      Patterns::Anything());
    prm.add_parameter("Pair",
                      pair,
                      "The contact pair that is compared; empty: the first.",
                      Patterns::Anything());
    prm.add_parameter("Values",
                      values,
                      "Named numbers that the type asks for, for example "
                      "'radius: 10, pressure: 5'.",
                      Patterns::Anything());
    prm.add_parameter("Pressure",
                      pressure,
                      "Contact pressure that the result is compared with if the type is "
                      "'formula', a formula in x, y, z (reference coordinates of the slave "
                      "surface) and t; empty: not compared. [force per reference area]",
                      Patterns::Anything());
  }



  std::map<std::string, double>
  ReferenceParameters::numbers(const std::string &section) const
  {
    std::map<std::string, double> result;
    for (const std::string &item : dealii::Utilities::split_string_list(values, ','))
      {
        const std::size_t colon = item.find(':');
        const std::string name  = dealii::Utilities::trim(item.substr(0, colon));
        double            value = std::nan("");
        if (colon != std::string::npos)
          try
            {
              value = dealii::Utilities::string_to_double(item.substr(colon + 1));
            }
          catch (const std::exception &)
            {
            }
        if (name.empty() || !std::isfinite(value) || !result.emplace(name, value).second)
          throw InputError(section,
                           "Values",
                           item,
                           result.count(name) > 0 ? "this name is given twice"
                                                  : "this is not a name with a number",
                           "write 'name: number' with commas between them, for "
                           "example 'radius: 10, pressure: 5'");
      }
    return result;
  }



  void
  ReferenceParameters::check(const std::string &section) const
  {
    numbers(section);
    if (!pressure.empty())
      check_expression(section, "Pressure", pressure);
  }
} // namespace Touchstone

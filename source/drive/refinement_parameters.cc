// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/expression.h>
#include <touchstone/base/input_error.h>
#include <touchstone/drive/refinement_parameters.h>

namespace Touchstone
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  void
  RefinementParameters::declare(ParameterHandler &prm)
  {
    estimator.declare(prm,
                      "Estimator",
                      "Where the mesh is refined: 'none' leaves it as it is; 'Kelly' looks at the "
                      "jumps of stress between cells, 'recovered stress' at the distance from "
                      "stress to averaged stress (Zienkiewicz-Zhu), 'contact force' at the same "
                      "weighted by its influence on the contact forces, whose errors it estimates "
                      "(with 'Cycles = 0' that alone), all three also at the contact; "
                      "'region' takes what 'Region' says alone.");
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
    prm.add_parameter(
      "Tolerance",
      tolerance,
      "Refinement ends when the estimated error falls below this: that of the "
      "stress, relative in the energy norm, or with 'Estimator = contact force' the "
      "largest relative one of a contact force; 0 goes through all cycles. [no "
      "unit]",
      Patterns::Double(0., 1.));
    prm.add_parameter("Region",
                      region,
                      "Formula of x, y, z and t: cells at whose centre it is positive are refined "
                      "in each cycle.",
                      FormulaPattern());
  }



  void
  RefinementParameters::check(const std::string &section) const
  {
    if (estimator == Estimator::region && region.empty())
      throw InputError(section,
                       "Region",
                       region,
                       "'Estimator = region' needs to know where",
                       "give a formula of x, y, z and t, e.g. 'Region = 0.1 - z'");
    if (!region.empty())
      check_expression(section, "Region", region);
    // Cells would be in both sets, those to be refined and those to be coarsened.
    if (active() && refine_fraction + coarsen_fraction > 1.)
      throw InputError(section,
                       "Coarsen fraction",
                       Patterns::Tools::to_string(coarsen_fraction),
                       "makes more than the whole together with 'Refine fraction'",
                       "take less, 0.02 is usual");
  }
} // namespace Touchstone

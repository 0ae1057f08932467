// SPDX-License-Identifier: LGPL-2.1-or-later
// Values that cannot be, and entries that contradict each other.

#include "scene_support.h"

namespace
{
  /** Elastic constants, and elements that do not fit the degree or the law. */
  void
  elements_and_laws()
  {
    try_override("negative modulus", {"Body lower/Material/Young modulus=-1"});
    try_override("modulus of zero", {"Body lower/Material/Young modulus=0"});
    try_override("incompressible", {"Body lower/Material/Poisson ratio=0.5"});
    try_override("Poisson ratio of -1", {"Body lower/Material/Poisson ratio=-1"});
    try_override("b-bar of degree 2", {"Discretisation/Degree=2", "Body lower/Element=b-bar"});
    try_override("full of degree 2", {"Discretisation/Degree=2", "Body lower/Element=full"});
    try_override("automatic of degree 2", {"Discretisation/Degree=2"});
    const std::string law = "Body lower/Material/Law=";
    try_override("b-bar at finite strain", {law + "neo-Hookean", "Body lower/Element=b-bar"});
    try_override("incompatible modes at finite strain",
                 {law + "St. Venant-Kirchhoff", "Body lower/Element=incompatible modes"});
    try_override("F-bar at small strain", {"Body lower/Element=F-bar"});
    try_override("F-bar of degree 2",
                 {law + "neo-Hookean", "Body lower/Element=F-bar", "Discretisation/Degree=2"});
    try_override("F-bar at finite strain", {law + "neo-Hookean", "Body lower/Element=F-bar"});
    try_override("automatic at finite strain", {law + "neo-Hookean"});
    try_override("automatic at finite strain of degree 2",
                 {law + "neo-Hookean", "Discretisation/Degree=2"});
    try_override("incompressible at finite strain",
                 {law + "neo-Hookean", "Body lower/Material/Poisson ratio=0.5"});
    try_override("unknown law", {law + "Arruda-Boyce"});
  }



  /** Plastic materials: elements, yield stress, hardening. */
  void
  plasticity()
  {
    const std::string law        = "Body lower/Material/Law=";
    const std::string small      = law + "small-strain von Mises",
                      finite     = law + "finite-strain von Mises",
                      plasticity = "Body lower/Material/Plasticity/",
                      yield = plasticity + "Yield stress=5", voce = plasticity + "Hardening=Voce";
    try_override("plasticity of an elastic law", {yield});
    try_override("plasticity, small strain", {small, yield});
    try_override("plasticity, finite strain", {finite, yield});
    try_override("plasticity, degree 2", {small, yield, "Discretisation/Degree=2"});
    try_override("plasticity, incompatible modes",
                 {small, yield, "Body lower/Element=incompatible modes"});
    try_override("plasticity, F-bar at small strain", {small, yield, "Body lower/Element=F-bar"});
    try_override("plasticity, b-bar at finite strain", {finite, yield, "Body lower/Element=b-bar"});
    try_override("no yield stress", {small});
    try_override("yield stress of zero", {small, plasticity + "Yield stress=0"});
    try_override("unknown hardening", {small, plasticity + "Hardening=Swift"});
    try_override(
      "softening",
      {small, yield, plasticity + "Hardening=linear", plasticity + "Hardening modulus=-1"});
    try_override(
      "Voce softening",
      {small, yield, voce, plasticity + "Saturation stress=4", plasticity + "Saturation rate=1"});
    try_override(
      "Voce without rate",
      {small, yield, voce, plasticity + "Saturation stress=6", plasticity + "Saturation rate=0"});
    for (const std::string curve : {"",
                                    "0.1: 5",
                                    "0: 0",
                                    "0: 5, 0.2: 6, 0.1: 7",
                                    "0: 5, 0.1: 4",
                                    "0: 5, 0.1",
                                    "0: 5, 0.1: 6"})
      try_override("yield curve " + curve,
                   {small, plasticity + "Hardening=table", plasticity + "Yield curve=" + curve});
    try_override("yield stress beside a table",
                 {small, yield, plasticity + "Hardening=table", plasticity + "Yield curve=0: 5"});
    try_override("negative kinematic modulus", {small, yield, plasticity + "Kinematic modulus=-1"});
    try_override("recovery of nothing", {small, yield, plasticity + "Kinematic recovery=3"});
    try_override(
      "negative recovery",
      {small, yield, plasticity + "Kinematic modulus=1", plasticity + "Kinematic recovery=-3"});
  }



  /** Boundaries that are held or moved and loaded, and formulas. */
  void
  supports_and_loads()
  {
    try_override("held twice", {"Body upper/Symmetry=top"});
    try_override("listed twice", {"Body upper/Fixed=top, top"});
    try_override("empty boundary", {"Body upper/Fixed=top,,left"});
    try_override("pressure on a fixed boundary", {"Body lower/Fixed=right"});
    try_override("pressure on a symmetry plane", {"Body lower/Symmetry=right"});
    try_override("traction along a symmetry plane",
                 {"Body lower/Symmetry=right",
                  "Body lower/Boundary right/Pressure=",
                  "Body lower/Boundary right/Traction y=1"});
    try_override("moved and loaded",
                 {"Body lower/Boundary right/Displacement x=1",
                  "Body lower/Boundary right/Traction x=1"});
    try_override("moved and pressed",
                 {"Body lower/Boundary right/Displacement x=0",
                  "Body lower/Boundary right/Displacement y=0",
                  "Body lower/Boundary right/Displacement z=0"});

    const std::string key = "Body lower/Boundary right/Pressure=";
    try_override("unfinished formula", {key + "5*"});
    try_override("unknown variable", {key + "5*r"});
    try_override("unbalanced bracket", {key + "sin(x"});
    try_override("two formulas", {key + "1; 2"});
    try_override("decimal comma", {key + "1,5"});
    try_override("division by zero", {key + "1/0"});
    try_override("all that formulas can", {key + "t<0.5 ? max(x,y)*sin(pi*z) : 1e-3"});
  }



  /** Obstacles, pairs, and what they ask of elements. */
  void
  contact()
  {
    try_override("motion in space", {"Obstacle floor/Motion z=0.1*x"});
    try_override("no direction", {"Obstacle floor/Direction=0,0,0"});
    try_override("no radius", {"Obstacle floor/Shape=sphere", "Obstacle floor/Radius=0"});

    try_override("unknown slave", {"Contact pair between/Slave body=lowr"});
    try_override("unknown master", {"Contact pair between/Master body=third"});
    try_override("unknown obstacle", {"Contact pair below/Obstacle=wall"});
    try_override("no slave boundary", {"Contact pair between/Slave boundaries="});
    try_override("no master boundary", {"Contact pair between/Master boundaries="});
    try_override("boundary twice", {"Contact pair between/Slave boundaries=top, top"});
    try_override("no master", {"Contact pair below/Obstacle="});
    try_override("two masters", {"Contact pair between/Obstacle=floor"});
    try_override("boundaries of an obstacle", {"Contact pair below/Master boundaries=top"});
    const std::vector<std::string> one_body = {"Contact pair between/Master body=lower",
                                               "Contact pair between/Master boundaries=left, top",
                                               "Contact pair between/Pairing=pointwise"};
    try_override("slave is master", one_body);
    const auto also = [&](const std::string &more) {
      std::vector<std::string> result(one_body);
      result.push_back("Contact pair between/" + more);
      return result;
    };
    try_override("averaged rows of one body", also("Pairing=averaged"));
    try_override("adjusted overlap of one body", also("Initial overlap=adjust"));
    try_override("tied to itself", also("Behaviour=tied"));
    std::vector<std::string> refined = one_body;
    refined.push_back("Refinement/Estimator=Kelly");
    try_override("refined body that touches itself", refined);
    try_override("two boundaries of one body", also("Master boundaries=left"));
    try_override("tied", {"Contact pair between/Behaviour=tied"});
    try_override("tied and finite",
                 {"Contact pair between/Behaviour=tied", "Contact pair between/Sliding=finite"});
    try_override("smoothed faces of degree 2",
                 {"Contact pair between/Master normal=smoothed", "Discretisation/Degree=2"});
  }



  /** Solvers, tolerances and the reference solution. */
  void
  numerics()
  {
    try_override("multipliers and CG",
                 {"Contact/Enforcement=lagrange multipliers", "Linear solver/Type=Belos CG"});
    try_override("multipliers and GMRES",
                 {"Contact/Enforcement=lagrange multipliers", "Linear solver/Type=Belos GMRES"});
    try_override("no refinement", {"Discretisation/Refinement factor=0"});
    try_override("no time", {"Load stepping/End time=0"});
    try_override("exact", {"Newton/Residual tolerance=0"});
    try_override("exact gap", {"Newton/Gap tolerance=0"});
    try_override("exact solver", {"Linear solver/Tolerance=0"});
    try_override("pair of the reference", {"Reference solution/Pair=besides"});
    try_override("values of the reference", {"Reference solution/Values=radius: 10, p"});
    try_override("value given twice", {"Reference solution/Values=r: 10, r: 1"});
  }
} // namespace



int
main()
{
  elements_and_laws();
  plasticity();
  supports_and_loads();
  contact();
  numerics();
  return 0;
}

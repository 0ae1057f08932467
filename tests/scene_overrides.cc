// SPDX-License-Identifier: LGPL-2.1-or-later
// Overrides of the command line that cannot be read or are unknown.

#include "scene_support.h"

int
main()
{
  try_override("top level", {"Title=new"});
  try_override("blanks around the signs", {" Newton / Gap tolerance = 1e-6 "});
  try_override("empty value where that is possible", {"Body upper/Fixed="});
  try_override("no equals sign", {"Newton/Gap tolerance"});
  try_override("no key", {"Newton/=1"});
  try_override("nothing", {"=1"});
  try_override("empty section", {"Newton//Gap tolerance=1e-6"});
  try_override("comment in the value", {"Title=number #1"});
  try_override("section is missing", {"Steps=3"});
  try_override("misspelt section", {"Neuton/Gap tolerance=1e-6"});
  try_override("misspelt key", {"Newton/Gap tolerence=1e-6"});
  try_override("unknown body", {"Body uper/Element=full"});
  try_override("unknown boundary", {"Body upper/Boundary top/Pressure=1"});
  try_override("a boundary more",
               {"Body upper/Boundary conditions=bottom", "Body upper/Boundary bottom/Pressure=1"});
  const std::string friction = "Contact pair between/Friction/";
  try_override("friction is switched off",
               {"Contact pair between/Behaviour=frictionless", friction + "Coefficient=0.3"});
  try_override("a bound of tresca where there is no friction",
               {"Contact pair between/Behaviour=tied", friction + "Shear strength=3"});
  try_override("misspelt key of friction that is switched off",
               {"Contact pair between/Behaviour=frictionless", friction + "Coeficient=0.3"});
  try_override("keys that explicit dynamics has no use for",
               {"Time integration/Scheme=central_differences",
                "Newton/Gap tolerance=1e-6",
                "Body lower/Material/Density=1",
                "Body upper/Material/Density=1"});
  try_override("keys of another enforcement",
               {"Contact/Penalty factor=3",
                "Contact/Tangential factor=2",
                "Contact/Augmentation=outer",
                "Contact/Contact iterations=5",
                "Contact pair below/Edge tolerance=0.1"});
  try_override("keys of this enforcement",
               {"Contact/Enforcement=augmented lagrange",
                "Contact/Penalty factor=3",
                "Contact/Friction=regularised",
                "Contact/Tangential factor=2",
                "Contact/Augmentation=outer",
                "Contact pair between/Behaviour=coulomb",
                "Contact pair between/Friction/Coefficient=0.3"});
  try_override("keys of another enforcement of explicit dynamics",
               {"Time integration/Scheme=central_differences",
                "Contact/Enforcement=soft penalty",
                "Contact/Penalty factor=3",
                "Contact/Contact tolerance=1e-6",
                "Contact/Linearisation=frozen",
                "Body lower/Material/Density=1",
                "Body upper/Material/Density=1"});
  try_override("keys of other schemes",
               {"Time integration/HHT alpha=0.1",
                "Time integration/Spectral radius=0.5",
                "Time integration/Mass=lumped"});
  try_override("how fields are written that are not",
               {"Output/VTU interval=0", "Output/Format=xdmf", "Output/Unsmoothed values=both"});
  try_override("axis of an obstacle that does not turn", {"Obstacle floor/Rotate axis=1, 0, 0"});
  try_override("points of a probe that is no line",
               {"Probes=place", "Probe place/Body=lower", "Probe place/Points=5"});
  try_override("pairs that are no longer listed",
               {"Contact pairs=", "Contact/Enforcement=penalty"});
  const std::string steps = "Load stepping/", two = steps + "Phases=clamp, pull",
                    clamp = steps + "Phase clamp/End time=1",
                    pull  = steps + "Phase pull/End time=3";
  try_override("phases", {two, clamp, pull, steps + "Phase pull/Steps=3"});
  try_override("a phase without a section", {two, clamp});
  try_override("a phase without an end", {two, clamp, steps + "Phase pull/Steps=3"});
  try_override("a phase that ends before it begins", {two, pull, steps + "Phase clamp/End time=4"});
  try_override("a phase that is not listed", {steps + "Phases=clamp", clamp, pull});
  try_override("a number of steps beside phases", {two, clamp, pull, steps + "Steps=7"});
  const std::string overlap = "Contact pair between/Overlap end time=";
  try_override("end of an overlap that does not grow", {overlap + "0.5"});
  try_override("end of an overlap after the end of the run",
               {"Contact pair between/Initial overlap=ramp", overlap + "1.5"});
  const std::string right = "Body lower/Boundary right/";
  try_override("force and moment at a point",
               {right + "Force x=5*t", right + "Moment y=2", right + "Reference point=1, 2, 3"});
  try_override("force that depends on the place", {right + "Force x=5*x"});
  try_override("point without a force", {right + "Reference point=1, 2, 3"});
  try_override("two coordinates", {right + "Force x=5", right + "Reference point=1, 2"});
  try_override("force on a boundary that is moved",
               {right + "Force x=5", right + "Displacement y=1", right + "Pressure="});
  try_override("springs that pull", {right + "Spring stiffness normal=-1"});
  const std::string cut = "Contact pair between/", tied = cut + "Behaviour=tied";
  try_override("pretension", {tied, cut + "Pretension force=50*t"});
  try_override("pretension of a pair that is not tied", {cut + "Pretension force=50*t"});
  try_override("force and shortening",
               {tied, cut + "Pretension force=50*t", cut + "Pretension shortening=0.1"});
  try_override("lock without pretension", {tied, cut + "Pretension until=clamp"});
  try_override("lock at no phase",
               {tied, cut + "Pretension force=50*t", cut + "Pretension until=clamp"});
  try_override("pretension that depends on the place", {tied, cut + "Pretension force=50*x"});
  const std::string floor = "Obstacle floor/", free = floor + "Free directions=",
                    scheme = "Time integration/Scheme=", lower = "Body lower/";
  const std::vector<std::string> mass  = {floor + "Mass=1", floor + "Inertia=1, 1, 1"},
                                 dense = {lower + "Material/Density=1",
                                          "Body upper/Material/Density=1"};
  const auto both = [](std::vector<std::string> one, const std::vector<std::string> &other) {
    one.insert(one.end(), other.begin(), other.end());
    return one;
  };
  const std::vector<std::string> dynamic =
    both(both(dense, mass), {scheme + "newmark", "Time integration/Impact=elastic"});
  try_override("inertia without dynamics", both(mass, {free + "x, about z"}));
  try_override("moments of inertia of what does not turn", both(dynamic, {free + "x"}));
  try_override("mass of what turns alone", both(dynamic, {free + "about z"}));
  try_override("coefficient of a control that there is not",
               both(dense,
                    {scheme + "central_differences",
                     lower + "Element=one point",
                     lower + "Hourglass control=none",
                     lower + "Hourglass coefficient=0.5"}));
  try_override("a boundary on which nothing is prescribed",
               {"Body upper/Boundary conditions=bottom", "Body upper/Boundary bottom/Pressure="});
  return 0;
}

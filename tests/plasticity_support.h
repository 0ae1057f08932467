// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_tests_plasticity_support_h
#define touchstone_tests_plasticity_support_h

#include <touchstone/scene/scene.h>

#include <string>
#include <vector>

namespace Touchstone
{
  /** A law with its hardening: name, and entries of the subsection Plasticity. */
  struct HardeningCase
  {
    std::string              name;
    std::vector<std::string> entries;
  };

  /** All kinds of hardening, for E = 1000. */
  inline const std::vector<HardeningCase> hardening_cases = {
    {"none", {"Hardening=none", "Yield stress=2"}},
    {"linear", {"Hardening=linear", "Yield stress=2", "Hardening modulus=50"}},
    {"table", {"Hardening=table", "Yield curve=0: 2, 0.01: 3, 0.1: 4"}},
    {"Voce",
     {"Hardening=Voce",
      "Yield stress=2",
      "Saturation stress=4",
      "Saturation rate=30",
      "Hardening modulus=5"}},
    {"kinematic", {"Hardening=none", "Yield stress=2", "Kinematic modulus=80"}},
    {"Armstrong-Frederick",
     {"Hardening=none", "Yield stress=2", "Kinematic modulus=80", "Kinematic recovery=40"}},
    {"Voce and Armstrong-Frederick",
     {"Hardening=Voce",
      "Yield stress=2",
      "Saturation stress=3",
      "Saturation rate=30",
      "Kinematic modulus=80",
      "Kinematic recovery=40"}}};

  /** The material that a scene with these entries has. */
  inline MaterialParameters
  plastic_material(const std::string              &law,
                   const std::vector<std::string> &entries,
                   const double                    young_modulus = 1000.,
                   const double                    poisson_ratio = 0.3)
  {
    std::string text =
      "set Bodies = block\nsubsection Body block\nsubsection Geometry\nset Type = box\nend\nsubsection Material\n"
      "set Law = " +
      law + "\nset Young modulus = " + std::to_string(young_modulus) +
      "\nset Poisson ratio = " + std::to_string(poisson_ratio) + "\nsubsection Plasticity\n";
    for (const std::string &entry : entries)
      text += "set " + entry + "\n";
    return Scene(text + "end\nend\nend\n", "scene.prm", {}).bodies.front().material;
  }
} // namespace Touchstone

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
// Constants of materials that are refused, with the remedy.

#include "scene_support.h"

namespace
{
  /** One body of the law with these keys. */
  void
  try_material(const std::string &what, const std::string &keys, const std::string &body = "")
  {
    try_scene(what,
              "set Bodies = x\nsubsection Body x\n" + body +
                "subsection Geometry\nset Type = box\nend\nsubsection Material\n" + keys +
                "end\nend\n");
  }
} // namespace

int
main()
{
  const std::string rubber = "set Law = Mooney-Rivlin\n", ogden = "set Law = Ogden\n",
                    gent = "set Law = Gent\n", wood = "set Law = orthotropic\n",
                    prony   = "set Law = viscoelastic\nset Young modulus = 1\n",
                    elastic = "set Young modulus = 1\n",
                    moduli  = "set Young moduli = 10, 2, 1\nset Shear moduli = 1, 1, 1\n";
  try_material("rubber", rubber + "set C10 = 1\nset C01 = 0.2\n");
  try_material("Young's modulus of rubber", rubber + "set C10 = 1\nset Young modulus = 6\n");
  try_material("no constant", rubber);
  try_material("negative constant", rubber + "set C10 = 1\nset C01 = -0.1\n");
  try_material("no stiffness", rubber + "set C10 = 0\n");
  try_material("incompressible", rubber + "set C10 = 1\nset Poisson ratio = 0.5\n");
  try_material("two moduli, one exponent", ogden + "set Moduli = 1, 2\nset Exponents = 2\n");
  try_material("four terms", ogden + "set Moduli = 1, 1, 1, 1\nset Exponents = 1, 2, 3, 4\n");
  try_material("signs that differ", ogden + "set Moduli = 1, 1\nset Exponents = 2, -2\n");
  try_material("exponent zero", ogden + "set Moduli = 1\nset Exponents = 0\n");
  try_material("locked", gent + "set Shear modulus = 1\nset Locking stretch = 1\n");
  try_material("no shear", gent + "set Shear modulus = 0\nset Locking stretch = 3\n");
  try_material("wood", wood + moduli + "set Poisson ratios = 2, 0.3, 0.1\n");
  try_material("too large a ratio", wood + moduli + "set Poisson ratios = 2.3, 0, 0\n");
  try_material("negative energy", wood + moduli + "set Poisson ratios = 1.9, 1.9, 0.9\n");
  try_material("two numbers", wood + "set Young moduli = 10, 2\nset Shear moduli = 1, 1, 1\n");
  try_material("no modulus", wood + "set Young moduli = 10, 0, 1\nset Shear moduli = 1, 1, 1\n");
  try_material("no right angle", wood + moduli + "set Second direction = 1, 1, 0\n");
  try_material("no direction", wood + moduli + "set First direction = 0, 0, 0\n");
  try_material("isotropic ratio", wood + moduli + "set Poisson ratio = 0.3\n");
  try_material("prony", prony + "set Relaxation times = 1, 10\nset Shear ratios = 0.5, 0.4\n");
  try_material("nothing left",
               prony + "set Relaxation times = 1, 10\nset Shear ratios = 0.5, 0.5\n");
  try_material("ratio missing", prony + "set Relaxation times = 1, 10\nset Shear ratios = 0.5\n");
  try_material("bulk ratio missing",
               prony +
                 "set Relaxation times = 1, 10\nset Shear ratios = 0, 0\nset Bulk ratios = 1\n");
  try_material("time zero", prony + "set Relaxation times = 0\nset Shear ratios = 0.5\n");
  try_material("negative ratio", prony + "set Relaxation times = 1\nset Shear ratios = -0.5\n");
  const std::string begin       = "subsection Thermal expansion\n",
                    coefficient = "set Coefficient = 1e-5\n",
                    temperature = "set Temperature = 100*t\n";
  try_material("thermal", elastic + begin + coefficient + temperature + "end\n");
  try_material("no temperature", elastic + begin + coefficient + "end\n");
  try_material("no coefficient", elastic + begin + temperature + "end\n");
  try_material("no formula", elastic + begin + coefficient + "set Temperature = 100*s\n" + "end\n");
  try_material("incompatible modes",
               elastic + begin + coefficient + temperature + "end\n",
               "set Element = incompatible modes\n");
  return 0;
}

// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/abaqus_elements.h>
#include <touchstone/mesh/mesh_text.h>

#include <cctype>
#include <map>

namespace Touchstone
{
  namespace
  {
    /** Nodes of an element of this type, by the beginning of its name: variants with reduced
     * integration, mixed fields and the like have the same nodes. A digit may not follow, so that
     * C3D8 is not C3D80. Zero for others. */
    unsigned int
    nodes_of(const std::string &type, const std::map<std::string, unsigned int> &known)
    {
      for (const auto &[name, n] : known)
        if (type.compare(0, name.size(), name) == 0 &&
            (type.size() == name.size() ||
             !std::isdigit(static_cast<unsigned char>(type[name.size()]))))
          return n;
      return 0;
    }
  } // namespace



  AbaqusElement::AbaqusElement(const std::string &type)
    : of_cell(nodes_of(type, {{"C3D8", 8}, {"C3D20", 20}, {"C3D27", 27}}))
    , of_face(nodes_of(type,
                       {{"S4", 4},
                        {"S8", 8},
                        {"CPS4", 4},
                        {"CPS8", 8},
                        {"CPE4", 4},
                        {"CPE8", 8},
                        {"M3D4", 4},
                        {"M3D8", 8},
                        {"M3D9", 9},
                        {"SFM3D4", 4},
                        {"SFM3D8", 8},
                        {"R3D4", 4},
                        {"DS4", 4},
                        {"DS8", 8},
                        {"S9", 9}}))
    , triangular(nodes_of(type,
                          {{"S3", 3},
                           {"S6", 6},
                           {"STRI3", 3},
                           {"STRI65", 6},
                           {"CPS3", 3},
                           {"CPS6", 6},
                           {"CPE3", 3},
                           {"CPE6", 6},
                           {"M3D3", 3},
                           {"M3D6", 6},
                           {"SFM3D3", 3},
                           {"SFM3D6", 6},
                           {"R3D3", 3},
                           {"DS3", 3},
                           {"DS6", 6}}) > 0)
  {
    if (of_cell + of_face > 0 || triangular)
      return;
    // Solids of any kind and shape.
    for (const std::string solid :
         {"C3D", "DC3D", "DCC3D", "AC3D", "EC3D", "Q3D", "GK3D", "COH3D", "SC6", "SC8", "CSS8"})
      if (type.compare(0, solid.size(), solid) == 0)
        throw MeshFileError("It has elements of type " + type + ".");
    if (type.empty())
      throw MeshFileError("It has elements without a TYPE.");
  }
} // namespace Touchstone

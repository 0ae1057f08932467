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
  return 0;
}

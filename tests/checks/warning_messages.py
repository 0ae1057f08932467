# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the user should know of results is told in the log and in summary.json; a run whose mesh file
has changed is not resumed."""
# ctest: label = quick

import re
import shutil

from touchstone_test import check, checks, fail, finish, folder, launch, run, tests

lift_off = run("lift_off", checks / "warning_lift_off.prm")
text = "contact pair 'contact' had contact until t = 0.25 and has none at the end"
lift_off.says(text)
check(any(text in warning for warning in lift_off.summary["warnings"]),
      "no warning in summary.json")

# The mesh of a body is another one when the run is to go on.
(folder / "mesh").mkdir(exist_ok=True)
mesh = (tests / "meshes/two_blocks_v2.msh").read_text(encoding="utf-8")
(folder / "mesh/blocks.msh").write_text(mesh, encoding="utf-8")
(folder / "mesh/scene.prm").write_text("""set Bodies = block
subsection Body block
  set Boundary conditions = lid
  set Fixed               = base
  subsection Geometry
    set Type = file
    set File = blocks.msh
  end
  subsection Material
    set Young modulus = 1000
  end
  subsection Boundary lid
    set Displacement z = -0.01*t
  end
end
subsection Load stepping
  set Steps = 2
end
subsection Checkpoints
  set Steps between = 1
end
""", encoding="utf-8")
run("written", "mesh/scene.prm")
shutil.rmtree("written/checkpoint_000002")
moved = re.sub("^27 1 1 2$", "27 1 1.01 2", mesh, flags=re.M)
check(moved != mesh, "the mesh is not changed")
(folder / "mesh/blocks.msh").write_text(moved, encoding="utf-8")
resumed = launch("--results-only", "--resume", "--output", "written", "mesh/scene.prm")
if resumed.returncode == 0:
    fail("resumed with another mesh")
check("section 'Body block/Geometry', key 'File': the mesh file is not the one" in resumed.stdout,
      f"another message: {resumed.stdout}")
finish()

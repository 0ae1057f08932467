# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the user should know of results is told in the log and in summary.json; a run whose mesh file
has changed is not resumed."""
# ctest: label = quick

import shutil
import struct

from touchstone_test import check, checks, finish, folder, launch, run, tests
from fuzzing import further  # pylint: disable=wrong-import-order

lift_off = run("lift_off", checks / "warning_lift_off.prm")
text = "contact pair 'contact' had contact until t = 0.25 and has none at the end"
lift_off.says(text)
check(any(text in warning for warning in lift_off.summary["warnings"]),
      "no warning in summary.json")
lift_off.says("contact pair 'never' had no contact in any step")


def not_resumed(name, scene, file, changed, section):
    """A run is not resumed with a file that is another one, and is with the one that it had."""
    path = folder / name
    path.mkdir(exist_ok=True)
    before = (path / file).read_bytes()
    check(changed != before, f"{name}: the file is not changed")
    text = scene + """
subsection Load stepping
  set Steps = 2
end
subsection Checkpoints
  set Steps between = 1
end
"""
    (path / "scene.prm").write_text(text, encoding="utf-8")
    run(f"{name}/out", f"{name}/scene.prm")
    shutil.rmtree(f"{name}/out/checkpoint_000002")
    for data, refused in ((changed, True), (before, False)):
        (path / file).write_bytes(data)
        resumed = launch("--results-only", "--resume", "--output", f"{name}/out",
                         f"{name}/scene.prm")
        check((resumed.returncode != 0) == refused,
              f"{name}: exit code {resumed.returncode}\n{resumed.stdout}")
        if refused:
            check(f"section '{section}', key 'File': the mesh file is not the one"
                  in resumed.stdout, f"{name}, another message: {resumed.stdout}")


# The mesh of a body is another one when the run is to go on, or the surface of an obstacle.
BLOCK = """set Bodies = block
subsection Body block
  set Boundary conditions = {lid}
  set Fixed               = {base}
  subsection Geometry
    set Type = file
    set File = {file}
  end
  subsection Material
    set Young modulus = 1000
  end
  subsection Boundary {lid}
    set Displacement z = -0.01*t
  end
end
"""
meshes = {name: (tests / f"meshes/{name}").read_bytes() for name in
          ("two_blocks_v2.msh", "two_blocks_v4.msh", "two_blocks.inp")}
meshes |= {"binary.msh": further.gmsh_binary(), "ascii.vtu": further.vtu("ascii"),
           "base64.vtu": further.vtu("binary")}
for mesh, content in meshes.items():
    sides = {"base": "1", "lid": "2"} if "vtu" in mesh else {"base": "base", "lid": "lid"}
    # A blank at the end, or another coordinate.
    other = content.replace(b"0.5", b"0.51", 1)
    if other == content:
        other = content.replace(struct.pack("<d", 0.5), struct.pack("<d", 0.51), 1)
    (folder / mesh).mkdir(exist_ok=True)
    (folder / mesh / mesh).write_bytes(content)
    not_resumed(mesh, BLOCK.format(file=mesh, **sides), mesh,
                content + b"\n" if other == content else other, "Body block/Geometry")

plate = (tests / "meshes/plate.stl").read_bytes()
(folder / "stl").mkdir(exist_ok=True)
(folder / "stl/plate.stl").write_bytes(plate)
not_resumed("stl", (tests / "stl_plate.prm").read_text(encoding="utf-8").replace(
    "meshes/plate.stl", "plate.stl"), "plate.stl", plate.replace(b"3 3 0", b"3.01 3 0"),
            "Obstacle ground")
finish()

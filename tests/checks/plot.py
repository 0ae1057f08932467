# SPDX-License-Identifier: LGPL-2.1-or-later
"""contrib/plot: the curves that it takes from a run, with matplotlib its pictures and without it
what to install, and what it says of folders that are none of a run; the module that reads runs."""

import argparse
import importlib.machinery
import importlib.util
import math
import os
import shutil
import subprocess
import sys

from touchstone_test import STEPS, check, checks, finish, folder, run, source

SCENE = folder / "plot.prm"
SCENE.write_text(f"""
include {checks / "restart.prm"}
set Probes = top
subsection Probe top
  set Body     = block
  set Place    = boundary
  set Boundary = top
end
""", encoding="utf-8")

loader = importlib.machinery.SourceFileLoader("plot", str(source / "contrib/plot"))
plot = importlib.util.module_from_spec(importlib.util.spec_from_loader("plot", loader))
loader.exec_module(plot)

one = run("one", SCENE, {STEPS: 4}, vtu=1)
run("two", SCENE, {STEPS: 4}, ranks=2, vtu=1)
run("xdmf", SCENE, {STEPS: 4, "Output/Format": "xdmf"}, vtu=1)
failed = run("failed", SCENE, {"Newton/Maximum iterations": 1, "Load stepping/Maximum cuts": 0}, fails=True)


def curves(kind, name="one", **options):
    """Curves by their labels, and the names of the axes."""
    settings = {"column": None, "over": None, "axis": "x", "steps": None,
                "runs": [name], "units": "", "planes": {}, **options}
    found, *axes = plot.curves(kind, folder / name, argparse.Namespace(**settings))
    return {label: (list(x), list(y)) for label, x, y in found}, axes


force, axes = curves("force")
time, pressed = force["contact.force_z"]
check(axes == ["time", "force"] and time == [0.] + one.column("time"), f"{axes}")
check(pressed == [0.] + one.column("contact: force z") and pressed[-1] > 0, f"force {pressed}")
of_four = curves("force", runs=["one"] * 4)[0]
check(len(force) > 3 == len(of_four) and "contact.force_z" in of_four, f"curves of four runs {list(of_four)}")
over, axes = curves("force", over="top:displacement_z", column="contact.force_z")
check(list(over) == ["contact.force_z"] and axes[0] == "displacement_z [length]", f"{axes}")
check(math.isclose(over["contact.force_z"][0][-1], -0.037), f"{over}")
check("energy.strain" in curves("energy")[0], "energies")
check(curves("force", over="top:displacement_z", units="kN m s")[1] == ["displacement_z [m]", "force [kN]"], "units")
check(curves("pressure", units="N mm s")[1] == ["x [mm]", "contact pressure [N/mm^2]"], "units of a pressure")
newton, _ = curves("newton")
check(list(newton)[-1] == f"step 4, t = {time[-1]:g}", f"{list(newton)}")
check(len(curves("newton", runs=["one"] * 3)[0]) == 2, "solutions of each of three runs")
check(len(newton) == 4 and [len(y) for _, y in newton.values()] == one.column("Newton iterations"),
      f"{newton}")
for name in "one", "two":
    (label, (x, p)), = curves("pressure", name)[0].items()
    check(label.startswith("contact, "), f"the pair is called {label}")
    check(len(x) == 4 and x == sorted(x), f"line at {x}")
    check(max(p) == max(node.pressure for face in plot.faces(folder / name) for node in face) > 0,
          f"pressures {p}")


# Solutions of one step that a force takes, and attempts with a smaller step.
(folder / "log").write_text("""
Step 1/2   t = 1   clamp
          1   1.00e-01   0.00e+00        9        9   direct
          1   1.00e-02   0.00e+00        9        0   direct
Step 1/4   t = 0.5
          1   1.00e-03   0.00e+00        9        0   direct
""", encoding="utf-8")
check([name for name, _ in plot.attempts(folder)] == ["step 1, t = 1", "step 1, t = 1 (2)", "step 1, t = 0.5"],
      f"{plot.attempts(folder)}")


def grid(point, pressure, m, n):
    """Faces of a grid of m by n cells."""
    def node(i, j):
        return argparse.Namespace(position=point(i, j), pressure=pressure(i, j))

    return [[node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]
            for i in range(m) for j in range(n)]


# On a curved surface the line is a plane section of it, and so it is where no row of nodes lies in the
# plane: half a bore, and a ring about the axis.
bore = grid(lambda i, j: (2 * math.cos(i / 4), 2 * math.sin(i / 4), j), lambda i, j: 9 * (i == 4) + (j == 1), 12, 2)
for axis, count in ((0, 13), (1, 13), (2, 3)):
    check(sum(not math.isnan(x) for x, _ in plot.section(bore, axis)[0]) == count, f"section along {axis} of a bore")
ring = grid(lambda i, j: ((2 + i) * math.cos(j / 7), (2 + i) * math.sin(j / 7), 3),
            lambda i, j: 5 - i + (j == 4), 4, 11)
for axis in (0, 1):
    line = [p for p in plot.section(ring, axis)[0] if not math.isnan(p[0])]
    check(len(line) >= 5 and sorted(line, key=lambda p: p[0]) in (line, line[::-1]),
          f"section along {axis} of a ring {line}")
# A cap, whose pole has the largest pressure: the plane across the axis only touches it.
cap = grid(lambda i, j: (i - 2, j - 2, ((i - 2)**2 + (j - 2)**2) / 9), lambda i, j: 3 * (i == j == 2), 4, 4)
for axis, count in ((0, 5), (1, 5), (2, 5)):
    check(len(plot.section(cap, axis)[0]) == count, f"section along {axis} of a cap")
# Another run is compared in the plane of the first, if it meets the surface.
check(plot.section(cap, 0, (1, 1.))[1] == (1, 1.) and plot.section(cap, 0, (1, 9.))[1][1] == 0, "plane of another run")
check(len({node.position for face in plot.faces(folder / "two") for node in face}) == 16, "surface of two ranks")

# Tied pairs, which carry tension, are left out where there are others.
of_run, plot.pairs = plot.faces, lambda _: ["slides", "tied"]
for status, labels in ((1, ["slides"]), (3, ["slides", "tied"])):
    both = [[argparse.Namespace(position=(i, j, 0), pressure=1., pair=pair, status=3 if pair else status)
             for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))] for pair in (0, 1)]
    plot.faces = lambda _, both=both: both
    check([label.partition(",")[0] for label in curves("pressure")[0]] == labels, f"lines of pairs with status {status}")
plot.faces = of_run

# The module that reads runs.
touchstone = sys.modules["touchstone"]
two = touchstone.Run(folder / "two")
columns, units = two.statistics()
check(two.summary["converged"] and units["time"] == "time" and columns["time"] == time, f"{columns['time']}")
check(math.isclose(two.probe("top")[0]["displacement_z"][-1], -0.037), "probe")
check(two.times() == two.times("solution") == time, f"{two.times()}")
check(len(two.contact()) == len(two.contact(time[-1])) == 16, "nodes of the contact surface")
check(all(node.pressure == 0 for node in two.contact(0.)), "pressure at t = 0")
pieces = two.bodies()
check(len(pieces) == 2 and all(len(piece["displacement"]) == len(piece["position"]) == 3 * len(piece["von_mises"])
                               for piece in pieces), "bodies of two ranks")
check(max(abs(u) for piece in two.bodies(0.) for u in piece["displacement"]) == 0, "bodies at t = 0")
try:
    touchstone.Run(folder)
    check(False, "a folder of no run is read")
except FileNotFoundError as error:
    check("no summary.json" in str(error), str(error))

# A run that ends in its first step has the row of its start.
columns, _ = plot.table(failed.folder / "statistics.csv")
check(columns["time"] == [0.] and columns["energy.strain"] == [0.], f"table of a run that failed {columns}")

# Results in the format XDMF are the same, where h5py is installed.
if importlib.util.find_spec("h5py"):
    other = touchstone.Run(folder / "xdmf")
    check(other.times() == time and len(other.bodies()) == 1 and
          len(other.bodies()[0]["displacement"]) == sum(len(piece["displacement"]) for piece in pieces), "bodies of XDMF")
    both = [{tuple(round(x, 5) for x in node.position): node.pressure for node in result.contact()} for result in (other, two)]
    check(len(both[0]) == 16 and both[0].keys() == both[1].keys() and
          all(math.isclose(both[0][place], both[1][place], rel_tol=1e-5) for place in both[0]), f"contact surface {both}")
    lines = [next(iter(curves("pressure", name)[0].values())) for name in ("xdmf", "two")]
    check(all(math.isclose(a, b, rel_tol=1e-5) for one_list, other_list in zip(*lines)
              for a, b in zip(one_list, other_list)) and len(lines[0][0]) == 4, f"pressures of XDMF {lines}")

# Without VTK contrib/render.py says what to install.
blocked = folder / "blocked"
blocked.mkdir(exist_ok=True)
(blocked / "numpy.py").write_text("raise ImportError('blocked')\n", encoding="utf-8")
rendered = subprocess.run([sys.executable, source / "contrib/render.py", folder / "one", "one.png"],
                          env={"PYTHONPATH": str(blocked)}, capture_output=True, text=True, check=False)
check(rendered.returncode != 0 and "apt-get install python3-vtk9" in rendered.stderr, rendered.stderr)


def call(*arguments, **environment):
    return subprocess.run([sys.executable, source / "contrib/plot", *arguments], env={**os.environ, **environment},
                          capture_output=True, text=True, check=False)


done = call("one", "two", "--output", "pictures", "--over", "top")
if importlib.util.find_spec("matplotlib"):
    files = sorted(path.name for path in (folder / "pictures").iterdir())
    check(done.returncode == 0 and files == sorted(
        f"{kind}.{suffix}" for kind in plot.KINDS for suffix in ("png", "svg")),
          f"{files} {done.stderr}")
    check(all((folder / "pictures" / file).stat().st_size > 5000 for file in files), "empty pictures")
else:
    check(done.returncode == 1 and "apt-get install python3-matplotlib" in done.stderr, done.stderr)
check("no statistics.csv" in call("nothing").stderr, "a folder that is none of a run")
(folder / "empty").mkdir(exist_ok=True)
(folder / "empty/statistics.csv").write_text("", encoding="utf-8")
for arguments, text in ((("empty",), "empty/statistics.csv is empty"), (("one", "--column", "("), "'(' is no pattern")):
    done = call(*arguments)
    check(done.returncode != 0 and text in done.stderr and "Traceback" not in done.stderr, done.stderr)
# What cannot be read is named, and the other runs are drawn all the same.
(blocked / "numpy.py").unlink()
(blocked / "h5py.py").write_text("raise ImportError('blocked')\n", encoding="utf-8")
if importlib.util.find_spec("matplotlib"):
    shutil.rmtree("pictures")
    done = call("nothing", "one", "empty", "failed", "--output", "pictures")
    check(done.returncode == 1 and "nothing is not the folder of a run" in done.stderr and "is empty" in done.stderr and
          "failed" not in done.stderr and (folder / "pictures/force.png").is_file(), f"{done}")
    for kind, code in ((("--kind", "pressure"), 1), ((), 0)):
        done = call("xdmf", "one", *kind, "--output", "pictures", PYTHONPATH=os.pathsep.join([str(blocked), os.environ.get("PYTHONPATH", "")]))
        check(done.returncode == code and "xdmf: results in the format XDMF need h5py" in done.stderr and
              "pressure.png" in done.stdout, f"{done}")
check("no history probe_tip.csv" in call("one", "--over", "tip").stderr, "a probe that is not there")
finish()

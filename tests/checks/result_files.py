# SPDX-License-Identifier: LGPL-2.1-or-later
"""Result files: VTU series and statistics.csv begin with t = 0; the stress tensor is that of its
components; nodal reactions add up to the reactions of the boundaries; forces on the master side are those
on the slave side, and pressure times area adds up to the same; stresses of cells and quadrature points, not
smoothed; XDMF files go on after a restart; statistics.csv has the values
of 'statistics' under names of one word; probes have prescribed displacements and the stress of the
VTU files; on two ranks and after a restart as well."""

import csv
import math
import xml.etree.ElementTree as xml

from touchstone_test import STEPS, Run, check, checks, finish, folder, launch, prm, run, settings_options
from fuzzing import vtu  # pylint: disable=wrong-import-order
import touchstone  # pylint: disable=wrong-import-order

SCENE, SETTINGS = folder / "probes.prm", {STEPS: 4}
SCENE.write_text(f"""
include {checks / "restart.prm"}
set Probes = tip, path, top side
subsection Probe tip
  set Body  = block
  set Point = 1.1, 1.2, 1.001
end
subsection Probe path
  set Body      = block
  set Place     = line
  set Point     = 0.3, 0.2, 0.501
  set End point = 1.1, 1.2, 0.501
  set Points    = 5
end
subsection Probe top side
  set Body     = block
  set Place    = boundary
  set Boundary = top
end
""", encoding="utf-8")
PROBES = "probe_tip", "probe_path", "probe_top_side"


def table(path):
    """The rows of a CSV file, by the names of its columns without their units."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    check(all(len(row) == len(rows[0]) for row in rows), f"{path}: rows of different lengths")
    check(all(name and " " not in name for name in rows[0]), f"{path}: {rows[0]}")
    names = [name.partition("[")[0] for name in rows[0]]
    return [{name: float(text) if text else math.nan for name, text in zip(names, row)}
            for row in rows[1:]]


def times(series):
    """Times of a .pvd file."""
    return [float(d.get("timestep")) for d in xml.parse(series).iter("DataSet")]


def compare(result):
    """The two tables of a run."""
    rows, plain = table(result.folder / "statistics.csv"), result.rows()
    check(len(rows) == len(plain) + 1 and rows[0]["step"] == rows[0]["time"] == 0,
          f"{result}: {len(rows)} rows, the first {rows[0]}")
    for row, other in zip(rows[1:], plain):
        for title, value in other.items():
            name = title.replace(": ", ".").replace("/", ".").replace(" ", "_")
            check(row.get(name) == value, f"{result}: {name} is {row.get(name)}, not {value}")
    for name in ("solution", "contact"):
        check(times(result.folder / f"{name}.pvd") == [row["time"] for row in rows],
              f"{result}: times of {name}.pvd {times(result.folder / f'{name}.pvd')}")
    return rows


one = run("one", SCENE, SETTINGS, vtu=1)
rows = compare(one)
def near(what, a, b, tolerance=1e-6):
    """Two rows have the same numbers."""
    for name, value in a.items():
        check(name == "linear_iterations" or math.isnan(value) and math.isnan(b[name]) or
              math.isclose(value, b[name], rel_tol=tolerance, abs_tol=tolerance),
              f"{what}: {name} is {value} and {b[name]}")


two = run("two", SCENE, SETTINGS, ranks=2, vtu=1)
for a, b in zip(rows, compare(two)):
    near("two ranks", a, b)
probes = {name: table(one.folder / f"{name}.csv") for name in PROBES}
for name, history in probes.items():
    for a, b in zip(history, table(two.folder / f"{name}.csv")):
        near(f"{name} on two ranks", a, b)

# A run in two parts.
parts = {**SETTINGS, "Checkpoints/Steps between": 2}
run("parts", SCENE, {**parts, "Load stepping/End time": rows[2]["time"], STEPS: 2})
done = launch("--resume", "--output", "parts", *settings_options(parts), SCENE)
check(done.returncode == 0, done.stdout)
check(table(folder / "parts/statistics.csv") == rows, "the table of a run that was resumed")
for name, history in probes.items():
    check(table(folder / f"parts/{name}.csv") == history, f"{name} of a run that was resumed")

data = next(vtu.pieces(one.folder / "solution_0004.vtu"))
places, tensor = data["position"], data["stress"]
check(len(tensor) == 9 * (len(places) // 3) > 0, f"{len(tensor)} components of stress")
for name, entries in (("xx", (0,)), ("yy", (4,)), ("zz", (8,)), ("xy", (1, 3)), ("yz", (5, 7)),
                      ("xz", (2, 6))):
    for entry in entries:
        check(list(tensor[entry::9]) == list(data[f"stress_{name}"]), f"stress {name}")
# deal.II writes a node for each of its cells: each place once.
force = {tuple(places[3 * i:3 * i + 3]) + (data["body"][i],): data["reaction"][3 * i:3 * i + 3]
         for i in range(len(places) // 3)}
for d in range(3):
    summed = sum(value[d] for value in force.values())
    named = sum(value for name, value in rows[-1].items() if name.endswith("reaction_" + "xyz"[d]))
    size = max(abs(value[d]) for value in force.values())
    check(math.isclose(summed, named, rel_tol=1e-4, abs_tol=1e-4 * size),
          f"nodal reactions {summed}, those of boundaries {named}")
check(max(abs(x) for value in force.values() for x in value) > 0, "no reactions")

def summed(result, pair, *, scale=1e-5):
    """Forces and areas of slave nodes add up to those of the pair, hanging nodes included."""
    found, areas = {}, {}
    for file in sorted(result.folder.glob("contact_????*.vtu"))[-1:]:
        for arrays in vtu.pieces(file):
            for i, area in enumerate(arrays["area"]):
                place = tuple(arrays["position"][3 * i:3 * i + 3])
                areas[place] = area
                found[place] = arrays["force"][3 * i:3 * i + 3]
    size = max(abs(x) for x in result.force(pair))
    check(size > 0, f"{result}: no force")
    for d in range(3):
        total = sum(value[d] for value in found.values())
        check(abs(total - result.force(pair)[d]) <= scale * size,
              f"{result}: nodal forces {total}, that of the pair {result.force(pair)[d]}")
    check(sum(areas.values()) >= result.contact(pair, "area") * (1 - scale) > 0, f"{result}: areas")


def sides(result):
    """Area, pressure times area and force on either side, each node once, and nodes by pair."""
    both = []
    for name in ("contact", "master_contact"):
        nodes = {}
        files = sorted(result.folder.glob(f"{name}_[0-9]*.vtu"))
        newest = files[-1].name[:len(name) + 5]
        for file in (f for f in files if f.name.startswith(newest)):
            for arrays in vtu.pieces(file):
                for i, area in enumerate(arrays["area"]):
                    place = tuple(arrays["position"][3 * i:3 * i + 3]) + (arrays["pair"][i],)
                    nodes[place] = (area, area * arrays["pressure"][i], *arrays["force"][3 * i:3 * i + 3])
        both.append([sum(column) for column in zip(*nodes.values())])
    return both


def action_is_reaction(result):
    """Both sides have the same area and normal force, and opposite forces."""
    slave, master = sides(result)
    size = max(abs(x) for x in slave[2:])
    check(size > 0, f"{result}: no force")
    for a, b in zip(slave, [*master[:2], *(-x for x in master[2:])]):
        check(math.isclose(a, b, rel_tol=1e-5, abs_tol=1e-5 * size),
              f"{result}: slave side {slave}, master side {master}")


summed(one, "contact")
action_is_reaction(one)
# With hanging nodes on both sides.
hanging = run("hanging", prm / "hertz_sphere_adaptive.prm",
              {STEPS: 1, "Discretisation/Refinement factor": 0.5}, vtu=1)
summed(hanging, "contact")
action_is_reaction(hanging)
# Nodes of a side on several ranks; meshes that do not match, both pairings, friction and degree 2.
for name, settings in (
        ("averaged", {}), ("pointwise", {"Contact pair interface/Pairing": "pointwise"}),
        ("quadratic", {"Discretisation/Degree": 2})):
    action_is_reaction(run(name, prm / "patch_test.prm", settings, ranks=2, vtu=1))
# A slave that covers part of the master's faces: at the edge of the cover shape functions of degree 2 leave
# some nodes a negative area.
COVERED = folder / "covered.prm"
COVERED.write_text("""
set Bodies = low, high
set Contact pairs = c
subsection Body low
  set Fixed = bottom
  subsection Geometry
    set Type         = box
    set Upper corner = 2, 2, 1
    set Cells        = 3, 3, 2
  end
  subsection Material
    set Young modulus = 1000
  end
end
subsection Body high
  set Boundary conditions = top
  subsection Boundary top
    set Displacement x = 0.02
    set Displacement y = 0
    set Displacement z = -0.05
  end
  subsection Geometry
    set Type         = box
    set Lower corner = 0.52, 0.5, 1
    set Upper corner = 1.52, 1.5, 2
    set Cells        = 2, 2, 2
  end
  subsection Material
    set Young modulus = 1000
  end
end
subsection Contact pair c
  set Slave body        = high
  set Slave boundaries  = bottom
  set Master body       = low
  set Master boundaries = top
end
subsection Discretisation
  set Degree = 2
end
""", encoding="utf-8")
HANGING = {"Refinement/Estimator": "region", "Refinement/Region": "x+y-2", "Refinement/Cycles": 1,
           "Refinement/Cycles per step": 0}
for name, settings, ranks in (("covered", {}, 1), ("covered-2", {}, 2), ("covered-tied", {"Contact pair c/Behaviour": "tied"}, 1),
                              ("covered-pointwise", {"Contact pair c/Pairing": "pointwise"}, 1),
                              ("covered-hanging", HANGING, 1), ("covered-hanging-2", HANGING, 2)):
    covered = run(name, COVERED, settings, ranks=ranks, vtu=1)
    action_is_reaction(covered)
    check(min(area for file in covered.folder.glob("master_contact_0001*.vtu") for arrays in vtu.pieces(file)
              for area in arrays["area"]) >= 0, f"{covered}: negative areas")

# A folder that has the files of an earlier run, of more steps or of another number of ranks, has those of the last
# run alone; what the program does not write stays. A run that goes on leaves what is there from before.
again, foreign = folder / "again", ("solution_0001.vtu.old", "my_solution_0001.vtu", "contact_final.vtu")
for ranks, steps in ((1, 4), (2, 2), (1, 2)):
    done = launch("--output", again, *settings_options({STEPS: steps, "Output/VTU interval": 1}), SCENE, ranks=ranks)
    check(done.returncode == 0 and "Results in again: solution.pvd, contact.pvd, master_contact.pvd, statistics"
          in done.stdout.replace(str(again), "again"), done.stdout)
    series = touchstone.Run(again)
    named = {file.name for name in ("solution", "contact", "master_contact") for time in series.times(name)
             for file in touchstone.files_at(again, name, time)}
    pieces = {file.name for file in again.glob("*_????.*vtu") if file.suffix == ".vtu"} - set(foreign)
    check(pieces == named, f"{ranks} ranks: files that the series do not name {sorted(pieces ^ named)}")
    check(len(series.bodies()) == ranks and len(series.times()) == steps + 1, f"{ranks} ranks: {len(series.bodies())} pieces")
    forces = [sum(node.force[d] for node in series.contact()) for d in range(3)]
    check(math.dist(forces, Run("again", again, "").force("contact")) < 1e-5 * max(map(abs, forces)), f"{ranks} ranks: forces {forces}")
    for name in foreign:
        (again / name).write_text("mine", encoding="utf-8")
check(all((again / name).is_file() for name in foreign), "files of the user are gone")
# The reader takes what the series names, whatever else is there.
(again / "contact_0002.7.vtu").write_bytes((again / "contact_0001.vtu").read_bytes())
check(len(touchstone.files_at(again, "contact")) == 1, "a piece that no series names")
done = launch("--output", again, *settings_options({STEPS: 2, "Output/VTU interval": 0}), SCENE)
check("again: statistics, summary.json" in done.stdout and not list(again.glob("*.pvd")) and
      {path.name for path in again.glob("*.vtu*")} == set(foreign), f"{done.stdout} {sorted(again.glob('*.vtu*'))}")

# Stresses that are not smoothed: those of the cells average to those of their points.
rough = run("rough", prm / "patch_test.prm", {
    "Contact pair interface/Pairing": "pointwise", "Output/Unsmoothed values": "both"}, vtu=1)
cells = next(vtu.pieces(rough.folder / "solution_0001.vtu"))
cloud = next(vtu.pieces(rough.folder / "points_0001.vtu"))
check(times(rough.folder / "points.pvd") == [0, 1], "times of points.pvd")
n_cells = len(cells["body"]) // 8
check(len(cloud["body"]) == 8 * n_cells > 0, f"{len(cloud['body'])} points in {n_cells} cells")
for c in range(n_cells):
    for k in range(9):
        mean = sum(cloud["stress"][9 * (8 * c + q) + k] for q in range(8)) / 8
        check(math.isclose(mean, cells["cell_stress"][9 * 8 * c + k], rel_tol=1e-4, abs_tol=1e-3),
              f"cell {c}: stress {cells['cell_stress'][9 * 8 * c + k]}, mean of its points {mean}")
nodal, of_points = (max(data["von_mises"]) for data in (cells, cloud))
check(max(cells["cell_von_mises"]) > 1.02 * nodal > 0 and of_points > max(cells["cell_von_mises"]),
      f"von Mises: nodes {nodal}, cells {max(cells['cell_von_mises'])}, points {of_points}")

# XDMF: all steps from t = 0 on, also of a run in two parts, and nothing of the other format.
XDMF = {**parts, "Output/Format": "xdmf"}
run("xdmf", SCENE, {**XDMF, "Load stepping/End time": rows[2]["time"], STEPS: 2}, vtu=1)
done = launch("--resume", "--output", "xdmf", *settings_options(XDMF), SCENE)
check(done.returncode == 0, done.stdout)
for name in ("solution", "contact", "master_contact"):
    text = (folder / f"xdmf/{name}.xdmf").read_text(encoding="utf-8")
    found = [float(grid.get("Value")) for grid in xml.fromstring(text).iter("Time")]
    check(found == [row["time"] for row in rows], f"times of {name}.xdmf {found}")
    for step in range(len(rows)):
        check((folder / f"xdmf/{name}_{step:04}.h5").stat().st_size > 1000 and
              f"{name}_{step:04}.h5:/displacement" in text, f"{name}.xdmf, step {step}")
# Rests of single precision are added to the numbers, not fields of their own: of tensors, too.
raw = run("xdmf-cells", prm / "patch_test.prm", {"Output/Format": "xdmf", "Output/Unsmoothed values": "both"}, vtu=1)
for name, field in (("solution", "cell_stress_zz"), ("points", "stress_zz")):
    text = (raw.folder / f"{name}.xdmf").read_text(encoding="utf-8")
    check(f'Name="{field}"' in text and "(rest)" not in text, f"fields of {name}.xdmf")
check(not list((folder / "xdmf").glob("*.vtu")) and not list((folder / "xdmf").glob("*.part")),
      "other files beside those of XDMF")

# Prescribed at the tip, and in the mean over the side; no balance at t = 0.
for name, x, y in (("probe_tip", 1.1, 1.2), ("probe_top_side", 0.7, 0.7)):
    for row, other in zip(probes[name], rows):
        t = other["time"]
        near(name, dict(zip("txyz", (t, 0.05 * max(t - 0.5, 0) * (1 + y), 0.02 * t,
                                     -0.03 * min(t, 1) - 0.01 * x if t else 0))),
             dict(zip("txyz", (row["time"], *(row[f"displacement_{d}"] for d in "xyz")))), 1e-9)
check(all(math.isclose(row["area"], 0.8) for row in probes["probe_top_side"]), "area of the side")
check(all(math.isclose(row["s"], math.hypot(0.8, 1) * (i % 5) / 4, abs_tol=1e-12)
          for i, row in enumerate(probes["probe_path"])), "places along the line")
check(len(probes["probe_path"]) == 5 * len(rows), "rows of the line")
for row, place in ((probes["probe_tip"][-1], (1.1, 1.2, 1.001)),
                   (probes["probe_path"][-1], (1.1, 1.2, 0.501))):
    at = min(range(len(places) // 3), key=lambda i, place=place: math.dist(place, places[3 * i:3 * i + 3]) +
             (0 if data["body"][i] == 1 else 1))
    for i, name in ((0, "xx"), (4, "yy"), (8, "zz"), (1, "xy"), (5, "yz"), (2, "xz")):
        check(math.isclose(row[f"stress_{name}"], tensor[9 * at + i], rel_tol=1e-5, abs_tol=1e-5),
              f"stress {name} at {place}: {row[f'stress_{name}']}, not {tensor[9 * at + i]}")
    check(math.isclose(row["von_mises"], data["von_mises"][at], rel_tol=1e-5), "von Mises")
finish()

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The same mesh, materials, supports and loads in GetFEM (python3-getfem).

getfem_program.py, which says what GetFEM is asked for, runs as a program of its own with a
Python that has GetFEM. Differences that remain:
* Degree 1 is FEM_QK(3,1) with full integration, where the program has incompatible modes.
* Contact knows surfaces by their facets only, quadratic ones for degree 2.
* Small sliding projects in the reference state; large sliding follows the displaced
  surfaces, also where strain is small, as in the program.
"""

import functools
import json
import math
import pathlib
import subprocess
import sys

from . import exported, fields, measures, processes, surfaces

PROGRAM = pathlib.Path(__file__).resolve().parent / "getfem_program.py"
LAWS = ("linear elastic", "neo-Hookean")


@functools.cache
def interpreter():
    """A Python with GetFEM, or nothing: packages of the system are not seen by others."""
    for python in dict.fromkeys((sys.executable, "/usr/bin/python3")):
        try:
            done = subprocess.run([python, "-c", "import getfem, numpy, scipy"], check=False,
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        except OSError:
            continue
        if done.returncode == 0:
            return python
    return None


def installed():
    return interpreter() is not None


def version():
    return subprocess.run([interpreter(), "-c", "import getfem; print(getfem.getfem_env('version'))"],
                          check=True, capture_output=True, text=True).stdout.strip()


def slave_normals(pair, model):
    """Unit outward normals at the slave nodes, means over their faces."""
    sums = {}
    for face in pair["slave"]:
        for *_, value, normal in surfaces.face_points(face, model["nodes"], model["degree"]):
            for node, v in zip(face, value):
                sums[node] = [s + abs(v) * n for s, n in zip(sums.get(node, [0.0] * 3), normal)]
    return {node: [c / math.sqrt(sum(v * v for v in s)) for c in s] for node, s in sums.items()}


def tractions(pair, model, answer):
    """Pressure and shear along x of the master on the slave, by node. A multiplier with one
    component is the normal stress."""
    normals, result = slave_normals(pair, model), {}
    for node, *value in answer["contact"]:
        normal = normals[node]
        stress = [value[0] * n for n in normal] if len(value) == 1 else value
        pressure = -sum(s * n for s, n in zip(stress, normal))
        result[node] = (pressure, stress[0] + pressure * normal[0])
    return result


def contact_force(pair, model, answer):
    """Force of the master on the slave body, which supports and loads balance."""
    slave = next(b for b in model["bodies"] if any(pair["slave"][0][0] in c for c in b["cells"]))
    nodes = {n for cell in slave["cells"] for n in cell}
    force = [-sum(f[d + 1] for f in model["steps"][-1]["forces"] if f[0] in nodes)
             for d in range(3)]
    for support, reaction in answer["history"][-1]["reactions"].items():
        if support.split("/")[0] == slave["name"]:
            force = [f - r for f, r in zip(force, reaction)]
    return force


def errors(model, answer, multiplier):
    """The same errors as those of the program's summary."""
    kind = model["reference"]["type"]
    values = measures.reference_values(model["reference"]["values"])
    if kind == "none":
        return {}
    if kind == "uniform stress":
        return measures.uniform_stress(answer["stresses"], values)
    if kind not in measures.OF_CONTACT:
        raise exported.ModelError(f"there is no measure for the reference solution '{kind}'")
    pair, degree, nodes = model["pairs"][0], model["degree"], model["nodes"]
    known = tractions(pair, model, answer)
    shape = "all" if multiplier == degree else "corners"
    # Nodal measures take the nodes of the multiplier only.
    faces = [face if shape == "all" else [face[i] for i in fields.CORNERS[degree]]
             for face in pair["slave"]]
    areas = surfaces.node_areas(faces, nodes, multiplier)
    mu, highest = pair["friction_coefficient"], max(abs(p) for p, _ in known.values())
    points = []
    for node, area in areas.items():
        pressure, shear = known.get(node, (0.0, 0.0))
        active = pressure > 1e-3 * highest
        points.append(measures.Point(tuple(nodes[node]), area, pressure, shear, active,
                                     active and mu > 0 and abs(shear) < 0.999 * mu * pressure))
    of = {name: fields.Field(pair["slave"], nodes, degree,
                             {n: entry[i] for n, entry in known.items()}, shape)
          for i, name in enumerate(("pressure", "shear"))}
    return measures.OF_CONTACT[kind](points, contact_force(pair, model, answer), values, of)


def prepare(program, case, campaign, folder):
    """Export the model and write the job. @throws exported.ModelError"""
    model = exported.export(program, case, campaign, folder)
    pair = exported.only_pair(model, LAWS)
    choices = case.choices | {"face size": exported.face_size(pair, model), "iterations": 40,
                              "cuts": 4, "stresses": model["reference"]["type"] == "uniform stress"}
    (folder / "job.json").write_text(json.dumps({"model": model, "choices": choices}),
                                     encoding="utf-8")
    return model


def complaint(text):
    """What a run that failed said last."""
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    return lines[-1][:200] if lines else "no message"


def execute(program, case, campaign, folder, models):
    """Run the case once; see touchstone.execute(). @param models Those of earlier rounds."""
    words = [interpreter(), "-B", str(PROGRAM), "job.json", "result.json"]
    row = {"user_seconds": math.nan, "system_seconds": math.nan, "wall_seconds": math.nan,
           "memory_mb": math.nan, "reason": "", "command": words, "errors": {}}
    try:
        if case.folder not in models:
            models[case.folder] = prepare(program, case, campaign, folder)
        model = models[case.folder]
        (folder / "result.json").unlink(missing_ok=True)
        usage = processes.run(words, folder, folder / "terminal", campaign.time_limit)
        row |= {"user_seconds": usage.user_seconds, "system_seconds": usage.system_seconds,
                "wall_seconds": usage.wall_seconds, "memory_mb": usage.memory_mb,
                "reason": usage.failure()}
        if row["reason"]:
            if not usage.timed_out:
                text = (folder / "terminal").read_text(encoding="utf-8", errors="replace")
                row["reason"] += ": " + complaint(text)
            return row
        answer = json.loads((folder / "result.json").read_text(encoding="utf-8"))
        row |= {"nodes": answer["nodes"], "unknowns": answer["unknowns"] + answer["multipliers"],
                "steps": len(model["steps"]), "newton": answer["iterations"],
                "reason": answer["reason"]}
        if not row["reason"]:
            row["errors"] = (errors(model, answer, case.choices["multiplier"]) |
                             exported.quantities(campaign, answer["history"]))
    except exported.ModelError as error:
        row["reason"] = str(error)
    return row

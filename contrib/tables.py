#!/usr/bin/env python3
"""Run the scenes behind doc/benchmarks.md and print its tables.

Usage: contrib/tables.py [--program PROGRAM] [--output FOLDER] [TABLE]...

PROGRAM is build/touchstone unless told otherwise, FOLDER output/tables. The
tables are press_fit, convergence, two_tubes, solvers, hertz, patch_test and
solvers_large; without names all but the last, which takes long. Each run leaves
its own folder with its summary.json, and one that is there already is not
repeated. The command of each run is printed before it starts.
"""

import argparse
import json
import os
import pathlib
import shlex
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


class Runner:
    def __init__(self, program, folder):
        self.program = program
        self.folder = folder

    def run(self, name, scene, settings=(), ranks=1):
        """The summary of a run, from its folder if it is there already."""
        folder = self.folder / name
        command = ["mpirun", "-n", str(ranks)] if ranks > 1 else []
        command += [self.program, f"prm/{scene}.prm", "--output", str(folder)]
        # Rows are pointwise where a table does not name them.
        if scene in PAIRS and PAIRING.format(PAIRS[scene]) not in dict(settings):
            command += ["--set", PAIRING.format(PAIRS[scene]) + "=pointwise"]
        for key, value in settings:
            command += ["--set", f"{key}={value}"]
        summary = folder / "summary.json"
        if not summary.exists():
            print("$", shlex.join(command), file=sys.stderr, flush=True)
            environment = dict(os.environ, OPENBLAS_NUM_THREADS="1",
                               OMPI_ALLOW_RUN_AS_ROOT="1",
                               OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
            done = subprocess.run(command, cwd=ROOT, env=environment,
                                  stdout=subprocess.DEVNULL, check=False)
            if not summary.exists():
                sys.exit(f"{name}: exit code {done.returncode}, no {summary}")
        result = json.loads(summary.read_text(encoding="utf-8"))
        if not result["converged"]:
            print(f"{name}: not converged: {result['failure']}", file=sys.stderr)
        return result


def table(header, rows):
    print("| " + " | ".join(header) + " |")
    print("|" + "---|" * len(header))
    for row in rows:
        print("| " + " | ".join(str(cell) for cell in row) + " |")
    print()


def nodes(summary):
    return f"{summary['unknowns'] // 3:,}"


def error(summary, name):
    return f"{summary['errors'][name]:.1e}" if summary["converged"] else "not converged"


RADII = ("inner radius: 0.5, inner skin radius: 1.001, outer bore radius: 1.0, "
         "outer radius: 1.5, young modulus: 210000, poisson ratio: 0.3, ")
# Exact x component of the force on a quarter: pressure times radius times length.
FIT_FORCE = 54.109 * 1.0 * 0.25
INNER = "Body inner tube/Geometry/Cells"
OUTER = "Body outer tube/Geometry/Cells"
DEGREE = "Discretisation/Degree"
GEOMETRY = "Contact pair {}/Contact geometry"
PAIRING = "Contact pair {}/Pairing"
PAIRS = {"press_fit": "fit", "two_tubes": "cone", "hertz_sphere": "contact",
         "patch_test": "interface"}
SWAPPED_FIT = [("Contact pair fit/Slave body", "inner tube"),
               ("Contact pair fit/Slave boundaries", "outer"),
               ("Contact pair fit/Master body", "outer tube"),
               ("Contact pair fit/Master boundaries", "inner"),
               ("Reference solution/Values", RADII + "slave radius: 1.001")]
SWAPPED_CONE = [("Contact pair cone/Slave body", "inner tube"),
                ("Contact pair cone/Slave boundaries", "outer"),
                ("Contact pair cone/Master body", "outer tube"),
                ("Contact pair cone/Master boundaries", "inner")]


def press_fit(runner):
    three_quarters = [(OUTER, "12, 36, 4")]
    cases = [
        ("matching", "48 : 48", "bore of the outer tube", []),
        ("matching_swapped", "48 : 48", "skin of the inner tube", SWAPPED_FIT),
        ("non_matching", "48 : 36", "bore (coarse side)", three_quarters),
        ("non_matching_swapped", "48 : 36", "skin (fine side)",
         three_quarters + SWAPPED_FIT),
        ("non_matching_averaged", "48 : 36", "bore, averaged rows",
         three_quarters + [(PAIRING.format("fit"), "averaged")]),
        ("non_matching_averaged_swapped", "48 : 36", "skin, averaged rows",
         three_quarters + SWAPPED_FIT + [(PAIRING.format("fit"), "averaged")]),
        ("faceted", "48 : 36", "bore, faceted",
         three_quarters + [(GEOMETRY.format("fit"), "faceted")]),
        ("faceted_swapped", "48 : 36", "skin, faceted",
         three_quarters + SWAPPED_FIT + [(GEOMETRY.format("fit"), "faceted")]),
    ]
    rows = []
    for degree, meshes in ((1, []), (2, [(INNER, "3, 12, 1"), (OUTER, "3, 12, 1")])):
        for name, cells, slave, settings in cases:
            if degree == 2:
                if "faceted" in name:
                    continue
                settings = meshes + [s for s in settings if s[0] != OUTER]
                if "non_matching" in name:
                    settings.append((OUTER, "3, 9, 1"))
                    cells = "12 : 9"
                else:
                    cells = "12 : 12"
                settings.append((DEGREE, 2))
            s = runner.run(f"press_fit_q{degree}_{name}", "press_fit", settings)
            # Of a run that did not converge there is no result.
            fit = s["results"]["contact"].get("fit", {"active": "–", "force": [0]})
            rows.append([degree, cells, slave, nodes(s), fit["active"],
                         s["iterations"]["newton"],
                         f"{abs(abs(fit['force'][0]) / FIT_FORCE - 1):.1e}"
                         if s["converged"] else "not converged",
                         error(s, "contact_pressure_mean"),
                         error(s, "contact_pressure_max_deviation")])
    table(["degree", "cells over 90°, inner : outer", "slave", "nodes", "active", "Newton",
           "total force", "mean pressure", "largest deviation"], rows)


def convergence(runner):
    rows = []
    for degree, meshes in ((1, ("4, 12, 1", "8, 24, 2", "16, 48, 4", "32, 96, 8")),
                           (2, ("2, 6, 1", "4, 12, 1", "8, 24, 2"))):
        for cells in meshes:
            s = runner.run(f"convergence_q{degree}_{cells.split(',')[0]}", "press_fit",
                           [(DEGREE, degree), (INNER, cells), (OUTER, cells)])
            rows.append([degree, cells, nodes(s), error(s, "contact_pressure_mean"),
                         error(s, "contact_pressure_max_deviation")])
    table(["degree", "cells of each tube", "nodes", "mean pressure",
           "largest deviation"], rows)


def push_force(summary):
    return f"{-summary['results']['reactions']['inner tube']['end'][0]:.2f}"


def two_tubes(runner):
    rows = []
    for factor in (1, 2):
        for geometry, pairing in (("manifold", "pointwise"), ("faceted", "pointwise"),
                                  ("manifold", "averaged")):
            if pairing == "averaged" and factor > 1:
                continue  # takes long
            for slave, settings in (("outer tube", []), ("inner tube", SWAPPED_CONE)):
                name = f"two_tubes_{geometry}_{slave[:5]}_{factor}"
                s = runner.run(name + ("_averaged" if pairing == "averaged" else ""), "two_tubes",
                               [("Discretisation/Refinement factor", factor),
                                (GEOMETRY.format("cone"), geometry),
                                (PAIRING.format("cone"), pairing),
                                ("Linear solver/Type", "MUMPS" if factor == 1 else "Belos CG")]
                               + settings)
                cone = s["results"]["contact"]["cone"]
                rows.append([factor, pairing, geometry, slave, push_force(s), f"{cone['area']:.2f}",
                             f"{cone['max_pressure']:.1f}", s["steps"],
                             s["iterations"]["newton"]])
    table(["factor", "pairing", "contact geometry", "slave", "push force", "contact area",
           "max pressure", "steps", "Newton"], rows)


def solver_rows(runner, factor, cases):
    rows = []
    for enforcement, solver in cases:
        for ranks in (1, 2):
            name = f"solvers_{enforcement[:4]}_{solver[:5]}_{ranks}_{factor}".replace(" ", "")
            s = runner.run(name, "two_tubes",
                           [("Discretisation/Refinement factor", factor),
                            ("Contact/Enforcement", enforcement),
                            ("Linear solver/Type", solver)], ranks)
            seconds = s["seconds"]
            rows.append([factor, enforcement, solver, ranks, f"{s['unknowns']:,}",
                         s["iterations"]["newton"],
                         f"{s['iterations']['linear_mean']:.1f}" if "CG" in solver else "–",
                         f"{seconds['wall']:.1f}", f"{seconds['cpu']:.1f}",
                         f"{seconds['linear_solver']:.1f}", f"{s['peak_memory_mb']:,.0f}",
                         push_force(s)])
    return rows


SOLVER_HEADER = ["factor", "enforcement", "solver", "ranks", "unknowns", "Newton",
                 "CG mean", "wall s", "CPU s", "solver s", "memory MB", "push force"]


def solvers(runner):
    every = [("elimination", "MUMPS"), ("elimination", "Belos CG"),
             ("lagrange multipliers", "MUMPS")]
    table(SOLVER_HEADER, solver_rows(runner, 1, every) + solver_rows(runner, 2, every[:2]))


def solvers_large(runner):
    table(SOLVER_HEADER, solver_rows(runner, 4, [("elimination", "Belos CG")]))


def hertz(runner):
    rows = []
    for scene in ("hertz_sphere", "hertz_rigid_plane"):
        for factor in (0.5, 0.75, 1, 1.5, 2):
            if scene == "hertz_rigid_plane" and factor > 1:
                continue
            s = runner.run(f"{scene}_{factor}", scene,
                           [("Discretisation/Refinement factor", factor),
                            ("Linear solver/Type", "Belos CG")])
            seconds = s["seconds"]
            rows.append([scene, factor, nodes(s), s["results"]["contact"]["contact"]["active"],
                         s["iterations"]["newton"], f"{s['iterations']['linear_mean']:.0f}",
                         f"{seconds['wall']:.0f}",
                         error(s, "peak_pressure"), error(s, "contact_radius"),
                         error(s, "pressure_l2")])
    table(["scene", "factor", "nodes", "active", "Newton", "CG mean", "wall s",
           "peak_pressure", "contact_radius", "pressure_l2"], rows)


def patch_test(runner):
    swapped = [("Contact pair interface/Slave body", "upper"),
               ("Contact pair interface/Slave boundaries", "bottom"),
               ("Contact pair interface/Master body", "lower"),
               ("Contact pair interface/Master boundaries", "top")]
    matching = [("Body upper/Geometry/Cells", "6, 6, 3")]
    averaged = [(PAIRING.format("interface"), "averaged")]
    rows = []
    for name, what, settings in (("fine", "3 : 2, fine slave, pointwise", []),
                                 ("coarse", "3 : 2, coarse slave, pointwise", swapped),
                                 ("fine_averaged", "3 : 2, fine slave, averaged", averaged),
                                 ("coarse_averaged", "3 : 2, coarse slave, averaged",
                                  swapped + averaged),
                                 ("matching", "3 : 3, pointwise", matching)):
        s = runner.run(f"patch_test_{name}", "patch_test", settings)
        rows.append([what, nodes(s), error(s, "stress_max_deviation"),
                     error(s, "displacement_max")])
    table(["cells", "nodes", "stress_max_deviation", "displacement_max"], rows)


TABLES = {f.__name__: f for f in (press_fit, convergence, two_tubes, solvers, hertz,
                                  patch_test, solvers_large)}


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(ROOT / "build/touchstone"))
    parser.add_argument("--output", default=str(ROOT / "output/tables"), type=pathlib.Path)
    parser.add_argument("tables", nargs="*", metavar="TABLE")
    arguments = parser.parse_args()
    for name in arguments.tables:
        if name not in TABLES:
            sys.exit(f"there is no table '{name}'; there are {', '.join(TABLES)}")
    runner = Runner(arguments.program, arguments.output)
    for name in arguments.tables or [n for n in TABLES if n != "solvers_large"]:
        print(f"### {name}\n")
        TABLES[name](runner)


if __name__ == "__main__":
    main()

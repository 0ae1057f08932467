# SPDX-License-Identifier: LGPL-2.1-or-later
"""Helpers of the checks: run scenes, read their figures, compare them.

A check is a program NAME.py that ctest calls with PROGRAM PROJECT FOLDER and that ends with
finish(). Lines of it that begin with "# ctest:" are read by tests/CMakeLists.txt:

    # ctest: goldens = hard_mu_one, hard_mu_two.mpirun=2     scenes whose goldens run before
    # ctest: label = quick                                   instead of full

Needs Python 3.9 and nothing else.
"""

import contextlib
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True  # no folders __pycache__ among the sources
program, source, folder = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
sys.path[:0] = str(source / "contrib"), str(source / "tests")
import forked  # pylint: disable=wrong-import-position
from processors import processors  # pylint: disable=wrong-import-position
tests, checks, prm = source / "tests", source / "tests/checks", source / "prm"
folder.mkdir(parents=True, exist_ok=True)
os.chdir(folder)
os.environ.pop("TOUCHSTONE_OPTIONS", None)
os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.update(OPENBLAS_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1",
                  OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")

ENFORCEMENT, SOLVER, STEPS = "Contact/Enforcement", "Linear solver/Type", "Load stepping/Steps"
RESIDUAL, GAP = "Newton/Residual tolerance", "Newton/Gap tolerance"
FACTOR, DEGREE = "Discretisation/Refinement factor", "Discretisation/Degree"
MULTIPLIERS = {ENFORCEMENT: "lagrange multipliers"}
AUGMENTED = {ENFORCEMENT: "augmented lagrange"}
PENALTY = {ENFORCEMENT: "penalty"}
CG, GMRES, MUMPS, PETSC = ({SOLVER: name} for name in
                           ("Belos CG", "Belos GMRES", "MUMPS", "PETSc"))
EXACT_ENFORCEMENTS = "elimination", "lagrange multipliers", "augmented lagrange"
ENFORCEMENTS = (*EXACT_ENFORCEMENTS, "penalty")

_failures = []


def fail(message):
    """Note a failure; the check goes on."""
    print(f"FAILED: {message}", flush=True)
    _failures.append(message)


def check(condition, message):
    """The condition must hold; the message says what is wrong if it does not."""
    if not condition:
        fail(message)


def finish():
    """End the check, with exit code 1 if anything failed."""
    if _failures:
        sys.exit(f"{len(_failures)} check(s) failed")


def below(what, value, bound):
    """The value is a number, not negative, and less than the bound."""
    if 0 <= value < bound:
        print(f"{what}: {value:.6g}, bound {bound:g}", flush=True)
    else:
        fail(f"{what}: {value:.12g} is not below {bound:g}")


def relative(value, reference):
    """Relative difference."""
    return abs(value / reference - 1) if reference else math.nan


def settings_options(settings):
    """Settings of a dictionary as options of the program."""
    return [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]


def launch(*arguments, ranks=1, timeout=None):
    """Start the program; returns subprocess.CompletedProcess with all that it says in stdout."""
    with processors(ranks):
        if ranks == 1:
            return forked.run(program, arguments, timeout)
        return subprocess.run(["mpirun", "--oversubscribe", "-n", str(ranks), sys.executable, "-IS",
                               forked.__file__, program, *map(str, arguments)], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False, timeout=timeout)


def forking_program():
    """A script for tools of contrib that start the program: runs it as launch() does."""
    script = folder / "touchstone"
    script.write_text(f'#!/bin/sh\nexec "{sys.executable}" -IS "{forked.__file__}" "{program}" "$@"\n',
                      encoding="utf-8")
    script.chmod(0o755)
    return script


def session(leader):
    """Processes of a session: mpirun and ranks are in one, but not in one group of processes."""
    members = []
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):
            # Behind the name in parentheses: state, parent, group, session.
            if int(stat.read_text(encoding="utf-8").rpartition(")")[2].split()[3]) == leader:
                members.append(int(stat.parent.name))
    return members


class Run:
    """A run and what it wrote. Figures that are missing are not numbers."""

    def __init__(self, name, path, text, code=0):
        self.name, self.folder, self.text, self.code = name, pathlib.Path(path), text, code
        summary = self.folder / "summary.json"
        self.summary = json.loads(summary.read_text(encoding="utf-8")) if summary.is_file() else {}

    def __str__(self):
        return self.name

    def value(self, *keys):
        """One figure of summary.json."""
        value = self.summary
        try:
            for key in keys:
                value = value[key]
            return float(value)
        except (KeyError, IndexError, TypeError):
            return math.nan

    def vector(self, *keys):
        """Three figures of summary.json."""
        return [self.value(*keys, i) for i in range(3)]

    def contact(self, pair, figure):
        """A figure of a contact pair."""
        return self.value("results", "contact", pair, figure)

    def force(self, pair):
        """Contact force of a pair."""
        return self.vector("results", "contact", pair, "force")

    def reaction(self, body, boundary):
        """Reaction of a support."""
        return self.vector("results", "reactions", body, boundary)

    def error(self, name):
        """Error against the reference solution."""
        return self.value("errors", name)

    def iterations(self, name="newton"):
        """Number of iterations."""
        return self.value("iterations", name)

    def count(self, name):
        """What summary.json counts."""
        return self.value("counts", name)

    def solves(self):
        """Iterations of each linear solve, of the rows of the log; none of direct ones."""
        rows = (line.split() for line in self.log.splitlines())
        return [int(row[5]) for row in rows
                if len(row) == 6 and row[0].isdigit() and row[5].isdigit()]

    @property
    def log(self):
        """Text of the log."""
        return (self.folder / "log").read_text(encoding="utf-8")

    def says(self, text):
        """The log must contain the text."""
        check(text in self.log, f"{self}: the log does not say: {text}")

    def after(self, line, word=1):
        """A number of what was printed: word number @p word after the text @p line."""
        try:
            return float(self.text.split(line, 1)[1].split()[word - 1])
        except (IndexError, ValueError):
            return math.nan

    def rows(self):
        """Rows of the table 'statistics', by the titles of its columns."""
        return statistics(self.folder / "statistics")

    def probe(self, name):
        """Rows of a probe's history, by the names of its columns without units."""
        lines = (self.folder / f"probe_{name}.csv").read_text(encoding="utf-8").splitlines()
        names = [title.partition("[")[0] for title in lines[0].split(",")]
        return [dict(zip(names, map(float, line.split(",")))) for line in lines[1:]]

    def column(self, title):
        """A column of the statistics."""
        return [row.get(title, math.nan) for row in self.rows()] or [math.nan]

    def cuts(self):
        """Number of times that a step was cut."""
        return sum(self.column("cuts"))

    def contact_nodes(self, step=None):
        """Slave nodes of the contact surface of a step, or the last that was written
        (fuzzing/vtu.py)."""
        from fuzzing import vtu  # pylint: disable=import-outside-toplevel,import-error
        name = "contact_*.vtu" if step is None else f"contact_{step:04d}.vtu"
        return vtu.read(sorted(self.folder.glob(name))[-1])

    def figures(self):
        """Results, errors and iterations as {path: (kind, value)}. Of results and iterations the
        last key is the kind; contact forces and reactions are one kind."""
        figures = {}

        def collect(part, path, value, kind):
            if isinstance(value, dict):
                for key, entry in value.items():
                    collect(part, (*path, key), entry, kind or
                            ("force" if "reactions" in path else None))
            elif isinstance(value, list):
                for i, entry in enumerate(value):
                    collect(part, (*path, i), entry, kind or path[-1])
            else:
                figures[path] = (kind or path[-1], math.nan if value is None else float(value))

        for part, kind in (("results", None), ("errors", "error"), ("iterations", None)):
            collect(part, (part,), self.summary.get(part, {}), kind)
        return figures


def statistics(path):
    """Rows of a table of the program by the titles of its columns."""
    titles, rows = [], []
    for line in pathlib.Path(path).read_text(encoding="utf-8").splitlines():
        head = re.fullmatch(r"# \d+: (.*)", line)
        if head:
            titles.append(head[1])
        elif line.strip() and not line.startswith("#"):
            rows.append(dict(zip(titles, map(float, line.split()))))
    return rows


def run(name, scene, settings=None, ranks=1, fails=False, vtu=0):
    """Run a scene into the folder @p name and expect that it converges, or with @p fails that
    it does not. VTU files are written every @p vtu steps, None: as the scene says."""
    shutil.rmtree(name, ignore_errors=True)
    settings = dict(settings or {})
    if vtu is not None:
        settings["Output/VTU interval"] = vtu
    done = launch("--results-only", "--output", name, *settings_options(settings), scene,
                  ranks=ranks)
    result = Run(name, name, done.stdout, done.returncode)
    if fails and done.returncode == 0:
        fail(f"{name}: the run must fail")
    elif not fails and done.returncode != 0:
        fail(f"{name}: exit code {done.returncode}\n{done.stdout}")
        result.summary = {}
    return result


def golden(name, ranks=1):
    """What the run of the golden NAME.output or NAME.mpirun=RANKS.output left; named in a line
    "# ctest: goldens" of the check."""
    label = name if ranks == 1 else f"{name}.mpirun={ranks}"
    with open(sys.argv[0], encoding="utf-8") as file:
        declared = [entry.strip() for line in file if line.startswith("# ctest: goldens = ")
                    for entry in line.split("=", 1)[1].split(",")]
    if label not in declared:
        sys.exit(f"'{label}' is not declared in a line '# ctest: goldens = ...'")
    if len(sys.argv) < 5:  # not by ctest
        return run(label, tests / f"{name}.prm", None, ranks, vtu=None)
    path = pathlib.Path(sys.argv[4]) / label
    return Run(label, path / "results", (path / "output").read_text(encoding="utf-8"))


def contact_gives(result, allowed):
    """Contact of explicit dynamics gives no more than this part of the energy in any cycle."""
    energies = result.summary.get("motion", {}).get("energies", {})
    total = max(energies.get("initial", math.nan), energies.get("external", math.nan))
    below(f"{result}, energy that contact gives in a cycle",
          result.value("contact_work", "most_energy_given_in_a_cycle") / total, allowed)


def rounds_are_few(result, many, halved):
    """General contact needs more than five rounds in this part of the cycles at most, and so many are halved."""
    cycles = sum(result.column("cycles"))
    for name, key, bound in (("of more than five rounds", "cycles_with_more_than_five", many),
                             ("that are halved", "halvings", halved)):
        below(f"{result}, cycles {name}", result.value("general_contact", key) / cycles, bound)


# Figures that are round-off or chance, and iterations of solvers.
_NOT_COMPARED = {"max_penetration", "contact", "damped", "linear_total", "linear_mean"}


def checkpoints(path):
    """Complete checkpoints of a run, the newest first."""
    return sorted((p for p in pathlib.Path(path).glob("checkpoint_[0-9]*") if p.suffix != ".part"),
                  reverse=True)


def lose_last_checkpoint(path):
    """As if the run had died before it wrote its last checkpoint."""
    shutil.rmtree(checkpoints(path)[0])
    (pathlib.Path(path) / "summary.json").unlink()


def resume(name, path, scene, settings, ranks=1):
    """Go on from the newest checkpoint in a folder, without VTU files."""
    done = launch("--results-only", "--output", path, "--resume",
                  *settings_options({**settings, "Output/VTU interval": 0}), scene, ranks=ranks)
    check(done.returncode == 0, f"{name}, resumed: {done.stdout}")
    result = Run(f"{name}, resumed", path, done.stdout)
    result.says("goes on from checkpoint_")
    return result


def stopped_and_resumed(name, scene, settings, every, ranks=1):
    """A run into the folder NAME_kept with checkpoints every so many steps, that has lost the last one and
    goes on from the one before, on @p ranks."""
    settings = {**settings, "Checkpoints/Steps between": every}
    path = run(f"{name}_kept", scene, settings).folder
    lose_last_checkpoint(path)
    return resume(name, path, scene, settings, ranks)


def same(a, b, tolerance, newton=False, **factors):
    """The figures of @p a times the factors of their kinds are those of @p b. Forces and moments
    are compared to the largest of their kind, errors, which are relative, to one. Newton
    iterations count only if @p newton is given."""
    first = {path: (kind, value * factors.get(kind, 1)) for path, (kind, value) in
             a.figures().items()}
    second = b.figures()
    problems, worst, compared = [], 0.0, 0
    if set(first) != set(second):
        others = sorted("/".join(map(str, path)) for path in set(first) ^ set(second))
        problems.append(f"not the same figures: {', '.join(others)}")
    largest = {}
    for kind, value in first.values():
        largest[kind] = max(largest.get(kind, 0), abs(value))
    for path in sorted(set(first) & set(second), key=str):
        kind, x = second[path]
        if kind in _NOT_COMPARED or (kind == "newton" and not newton):
            continue
        compared += 1
        size = 1 if kind == "error" else largest[kind] if kind in ("force", "moment") else abs(x)
        difference = abs(first[path][1] - x)
        if not difference <= tolerance * size:
            problems.append(f"{'/'.join(map(str, path))}: {first[path][1]:.12g} and {x:.12g}")
        if size > 0:
            worst = max(worst, difference / size)
    if compared < 8:
        problems.append("hardly anything to compare")
    print(f"{a} and {b}: {compared} figures, largest difference {worst:.1e}, "
          f"allowed {tolerance:.1e}", flush=True)
    if problems:
        fail(f"{a} and {b} differ:\n  " + "\n  ".join(problems))

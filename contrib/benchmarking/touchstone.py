# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run this program and read its summary."""

import csv
import json

from . import processes


def command(program, case, campaign, folder):
    """The command of a run, which writes nothing but what the comparison needs."""
    ranks = case.choices.get("ranks", 1)
    result = ["mpirun", "-n", str(ranks)] if ranks > 1 else []
    result += [str(program), str(campaign.scene), "--results-only", "--output", str(folder)]
    for key, value in ({"Output/VTU interval": 0} | case.settings).items():
        result += ["--set", f"{key}={value}"]
    return result


class MissingResult(Exception):
    """A campaign asks for a result that the summary does not have."""


def dig(summary, path):
    """The value at a path of names and numbers. @throws MissingResult"""
    value = summary
    for step in path:
        try:
            value = value[step]
        except (KeyError, IndexError, TypeError) as error:
            raise MissingResult("summary.json has no " + "/".join(map(str, path))) from error
    return value


def reaction(folder, curve):
    """Pairs of time and reaction of the support of a curve, from statistics.csv."""
    with open(folder / "statistics.csv", encoding="utf-8", newline="") as file:
        rows = [{name.split("[")[0]: value for name, value in row.items()}
                for row in csv.DictReader(file)]
    column = f"{curve.support.replace('/', '.').replace(' ', '_')}.reaction_{'xyz'[curve.axis]}"
    if column not in rows[0]:
        raise MissingResult(f"statistics.csv has no {column}")
    return [(float(row["time"]), float(row[column])) for row in rows]


def execute(program, case, campaign, folder):
    """Run the case once. @return a dictionary of columns; 'reason' says what failed."""
    folder.mkdir(parents=True, exist_ok=True)
    summary_file = folder / "summary.json"
    summary_file.unlink(missing_ok=True)
    words = command(program, case, campaign, folder)
    log = folder / "terminal"
    usage = processes.run(words, campaign.scene.parent, log, campaign.time_limit)
    row = {"user_seconds": usage.user_seconds, "system_seconds": usage.system_seconds,
           "wall_seconds": usage.wall_seconds, "memory_mb": usage.memory_mb,
           "reason": usage.failure(), "command": words, "errors": {}}
    if not summary_file.exists():
        if usage.failure() and not usage.timed_out:
            lines = log.read_text(encoding="utf-8", errors="replace").strip().splitlines()
            row["reason"] += f": {lines[-1]}" if lines else ""
        return row
    summary = json.loads(summary_file.read_text(encoding="utf-8"))
    row |= {"nodes": summary["unknowns"] // 3, "unknowns": summary["unknowns"],
            "steps": summary["steps"], "newton": summary["iterations"]["newton"],
            "linear_mean": summary["iterations"]["linear_mean"],
            "memory_mb": summary["peak_memory_mb"]}
    if not summary["converged"]:
        row["reason"] = summary["failure"] or "not converged"
        return row
    row["errors"] = dict(summary["errors"])
    try:
        for name, quantity in campaign.quantities.items():
            row["errors"][name] = abs(dig(summary, quantity.path) / quantity.exact - 1)
        for name, curve in campaign.curves.items():
            row["errors"][name] = curve.error(reaction(folder, curve))
        row["columns"] = {name: dig(summary, path) for name, path in campaign.columns.items()}
    except (MissingResult, ValueError) as error:
        row["reason"] = str(error)
    return row

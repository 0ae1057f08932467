# SPDX-License-Identifier: LGPL-2.1-or-later
"""The page of contrib/scoreboard: versions, the least CPU seconds of each program for each
error, what failed and why."""

import shutil
import subprocess

from . import calculix, table, with_getfem
from .choices import NAMES


def _first_line(command):
    done = subprocess.run(command, check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True)
    lines = [line.strip() for line in done.stdout.splitlines() if line.strip()]
    return lines[0] if lines else "unknown"


def versions(program):
    """A line on what ran."""
    words = [_first_line([str(program), "--version"])]
    if calculix.installed():
        words.append("CalculiX " + _first_line(["ccx", "-v"]).rsplit(" ", 1)[-1] + " (SPOOLES)")
    if with_getfem.installed():
        words.append(f"GetFEM {with_getfem.version()} (MUMPS)")
    return "; ".join(words) + f"; {_processor()}; one thread each."


def _processor():
    if shutil.which("lscpu"):
        for line in _first_lines(["lscpu"]):
            if line.startswith("Model name:"):
                return line.split(":", 1)[1].strip()
    return "unknown processor"


def _first_lines(command):
    return subprocess.run(command, check=False, stdout=subprocess.PIPE, text=True,
                          env={"LC_ALL": "C", "PATH": "/usr/bin:/bin"}).stdout.splitlines()


def smallest(rows, error):
    """The row of the smallest error, or nothing."""
    good = [r for r in rows if r["status"] == "converged" and r[error] == r[error]]
    return min(good, key=lambda r: r[error], default=None)


def cell(rows, error, tolerance):
    """CPU seconds and setting, or how near the program came."""
    if not rows:
        return "not run"
    row = table.best(rows, error, tolerance)
    if row:
        return f"**{row['user_seconds']:.2f} s** {setting(row)}"
    row = smallest(rows, error)
    if row is None:
        return "no result: " + rows[0]["reason"].replace("|", "/")
    return f"– ({100 * row[error]:.2g} % in {row['user_seconds']:.1f} s)"


def setting(row):
    """The contender without the name of its program, and its mesh."""
    name = row["contender"].removeprefix(NAMES[row["program"]] + ", ")
    return f"{name}, mesh {row['mesh']}"


def best_table(results):
    """@param results Pairs of campaign and rows."""
    header = ["case", "error", "within"] + list(NAMES.values())
    body = []
    for campaign, rows in results:
        for error in campaign.errors[:2]:
            for tolerance in campaign.tolerances:
                first = tolerance == campaign.tolerances[0]
                body.append([campaign.name.replace("_", " ") if first else "",
                             error.replace("_", " ") if first else "", f"{100 * tolerance:g} %"] +
                            [cell([r for r in rows if r["program"] == p], error, tolerance)
                             for p in NAMES])
    return table.markdown_lines(header, body)


def failures(results):
    """What did not end well, with its message."""
    body = [[campaign.name.replace("_", " "), row["contender"], row["mesh"],
             f"{row['user_seconds']:.1f}", row["reason"].replace("|", "/")]
            for campaign, rows in results for row in rows if row["status"] == "failed"]
    return table.markdown_lines(["case", "contender", "mesh", "CPU s", "message"], body)


def page(results, program):
    text = f"# Scoreboard\n\n{versions(program)}\n\n{best_table(results)}\n"
    text += "**s**: the least CPU seconds of a run whose error, and that of the same settings on\n"
    text += "all finer meshes, is within the bound; – (smallest error of all runs).\n"
    text += f"\n## Runs that failed\n\n{failures(results)}"
    for campaign, rows in results:
        text += f"\n## {campaign.title}\n\n{table.markdown(campaign, rows)}\n"
        for error in campaign.errors[:2]:
            stem = f"{campaign.name}/{campaign.name}_{error}.svg"
            text += f"![Error {error} against CPU seconds]({stem})\n"
    return text

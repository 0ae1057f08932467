# SPDX-License-Identifier: LGPL-2.1-or-later
"""Work-precision diagrams: error against CPU seconds, both logarithmic, with gnuplot."""

import shutil
import subprocess

from . import table

COLOURS = ("#1f4fa0", "#c03028", "#2a8f4a", "#c07a10", "#7a3fa0", "#208f9f", "#8a5a33", "#606060")
DASHES = {"touchstone": 1, "calculix": 2, "getfem": 3}
# Errors below are round-off and would only stretch the axis.
FLOOR = 1e-7


def installed():
    return shutil.which("gnuplot")


def _quoted(text):
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"').replace("_", " ") + '"'


def script(campaign, rows, error, stem):
    """The commands that draw one diagram as SVG and PNG; None without any point."""
    plots, data = [], []
    for number, (contender, line) in enumerate(table.lines_of(rows).items()):
        points = [(row["user_seconds"], max(row[error], FLOOR)) for row in line
                  if row["status"] == "converged" and row[error] == row[error]
                  and row[error] != "" and row["user_seconds"] > 0]
        if not points:
            continue
        # Dashed or dotted and with hollow symbols: another program.
        dashes = DASHES[line[0]["program"]]
        symbols = (5, 7, 9, 11, 13) if dashes == 1 else (4, 6, 8, 10, 12)
        style = f"dt {dashes} pt {symbols[number % 5]}"
        plots.append(f"$D{number} using 1:2 with linespoints lw 2 ps 1 {style} "
                     f"lc rgb {_quoted(COLOURS[number % len(COLOURS)])} "
                     f"title {_quoted(contender)}")
        data.append(f"$D{number} << EOD\n" + "\n".join(f"{t} {e}" for t, e in points) + "\nEOD\n")
    if not plots:
        return None
    bounds = ", ".join(f"{t:g} with lines lw 1 dt 3 lc rgb '#a0a0a0' notitle"
                       for t in campaign.tolerances)
    height = 470 + 20 * len(plots)
    common = f"""set logscale xy
set format y "10^{{%L}}"
set xlabel "CPU seconds of a run, start and output included"
set ylabel {_quoted('error: ' + error)}
set title {_quoted(campaign.title)}
set grid lt 1 lw 0.5 lc rgb "#d8d8d8"
set key below left Left reverse maxcols 2 title " " font ",11"
set offsets graph 0.03, graph 0.03, graph 0.03, graph 0.03
"""
    draw = "plot " + ", \\\n  ".join(plots + [bounds]) + "\n"
    return ("".join(data) +
            f'set terminal svg size 860,{height} font "DejaVu Sans,13" background "#ffffff"\n'
            f'set output "{stem}.svg"\n{common}{draw}unset output\n'
            f'set terminal pngcairo size 860,{height} font "DejaVu Sans,11"\n'
            f'set output "{stem}.png"\n{draw}')


def draw(campaign, rows, folder):
    """Draw a diagram for each error. @return names of the files."""
    files = []
    for error in campaign.errors:
        stem = f"{campaign.name}_{error}"
        text = script(campaign, rows, error, stem)
        if text is None:
            continue
        (folder / f"{stem}.gnuplot").write_text(text, encoding="utf-8")
        subprocess.run(["gnuplot", f"{stem}.gnuplot"], cwd=folder, check=True)
        files += [f"{stem}.svg", f"{stem}.png"]
    return files

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Time of the candidates of general contact against the number of faces, with nothing renewed: two plates of one-point
cells that slide past each other without touching (doc/general_contact.md, section 9).

Usage: python3 contrib/candidate_scaling.py PROGRAM FOLDER [CELLS ...]     (36 71 142 283: 5,472 to 322,620 faces)

Of the second of two output intervals the program says how long a cycle takes and which part of that is contact. The
part hardly depends on what else the machine does."""

import json
import pathlib
import re
import subprocess
import sys
from math import log

PROGRAM, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
SIZES = [int(word) for word in sys.argv[3:]] or [36, 71, 142, 283]
GAP, SPEED = 0.02, 0.004


def body(name, lower, speed, cells):
    """A plate."""
    return f"""subsection Body {name}
  set Element = one point
  set Initial velocity x = {speed}
  subsection Geometry
    set Type = box
    set Lower corner = 0, 0, {lower}
    set Upper corner = {cells}, {cells}, {lower + 1}
    set Cells = {cells}, {cells}, 1
  end
  subsection Material
    set Law = neo-Hookean
    set Young modulus = 1000
    set Poisson ratio = 0.3
    set Density = 1
  end
end
"""


def measured(cells):
    """Time of contact in a cycle, cycles of the second interval, candidates and searches."""
    path = FOLDER / "plates.prm"
    path.write_text(f"""set Bodies = lower, upper
set Contact pairs = all
{body("lower", -1 - GAP, -SPEED / 2, cells)}{body("upper", 0, SPEED / 2, cells)}subsection Time integration
  set Scheme = central_differences
end
subsection Load stepping
  set End time = 4
  set Steps = 2
end
""", encoding="utf-8")
    subprocess.run([PROGRAM, "--output", FOLDER / "out", "--set", "Output/VTU interval=0", path], check=True,
                   stdout=subprocess.DEVNULL)
    found = re.findall(r"(\d+) cycles of .*?, ([\d.e+]+) ns a cell and cycle, (?:(\d+) % of it contact)?",
                       (FOLDER / "out/log").read_text(encoding="utf-8"))
    n, each, share = (float(word or 0) for word in found[-1])
    general = json.loads((FOLDER / "out/summary.json").read_text(encoding="utf-8"))["general_contact"]
    return 1e-9 * each * 2 * cells * cells * share / 100, n, share, general["most_candidates"], general["searches"]


FOLDER.mkdir(parents=True, exist_ok=True)
before = None
for size in SIZES:
    time, n_cycles, part, candidates, searches = measured(size)
    faces = 4 * size * size + 8 * size
    growth = f", N^{log(time / before[1]) / log(faces / before[0]):.2f}" if before and time > 0 else ""
    print(f"{faces} faces, {candidates} candidates, {searches} searches, {n_cycles:.0f} cycles, contact {part:.0f} %: "
          f"{1e6 * time:.0f} us a cycle, {1e9 * time / candidates:.1f} ns a candidate, "
          f"{1e9 * time / faces:.1f} ns a face{growth}", flush=True)
    before = faces, time

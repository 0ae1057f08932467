# SPDX-License-Identifier: LGPL-2.1-or-later
"""One run of the program, and what it wrote."""

import dataclasses
import json
import pathlib
import re

from benchmarking import processes

from . import text, vtu

# What a message of the program never has: texts of libraries and of the operating system.
RAW = re.compile(r"dealii|deal\.II\b.*(Exc[A-Z]|exception)|An error occurred in (line|file)|terminate called|"
                 r"std::|what\(\)|boost|Belos::|Teuchos|Ifpack|Epetra|MPI_ERR|[Ss]tacktrace|"
                 r"Segmentation|signal \d|bad_alloc|broke down: |nan iterations|vector::|"
                 r"Additional information", re.S)


@dataclasses.dataclass
class Result:
    """Of a run; tables are empty if it wrote none."""
    exit_code: int
    timed_out: bool
    seconds: float
    terminal: str
    summary: dict = dataclasses.field(default_factory=dict)
    rows: list = dataclasses.field(default_factory=list)  # of 'statistics', by column name
    nodes: list = dataclasses.field(default_factory=list)  # of the last contact surfaces

    def converged(self):
        return self.exit_code == 0 and not self.timed_out

    def reason(self):
        """Why it did not converge, in one line."""
        if self.timed_out:
            return "time limit"
        lines = [line for line in self.terminal.splitlines()
                 if re.search("Not converged|Input error|broke down|rror", line)]
        last = self.terminal.strip().splitlines()[-1:] or [""]
        return (lines or last)[-1].strip()

    def vector(self, row, name):
        return tuple(row[f"{name} {a}"] for a in "xyz")

    def force(self, row, pair):
        return self.vector(row, f"{pair}: force")

    def reaction(self, row, body):
        """Sum over the supports of a body."""
        total = [0.0] * 3
        for name, value in row.items():
            match = re.fullmatch(rf"{re.escape(body)}/.*: reaction ([xyz])", name)
            if match:
                total["xyz".index(match[1])] += value
        return tuple(total)


def statistics(path):
    """Rows of the table by the names of its head."""
    names, rows = [], []
    if path.is_file():
        for line in path.read_text(encoding="utf-8").splitlines():
            head = re.fullmatch(r"# \d+: (.*)", line)
            if head:
                names.append(head[1])
            elif line.strip():
                rows.append(dict(zip(names, map(float, line.split()))))
    return rows


def read(folder, exit_code, timed_out, seconds):
    """What is in the folder of a run, with what it printed in 'terminal'."""
    terminal = (folder / "terminal").read_text(encoding="utf-8", errors="replace")
    result = Result(exit_code, timed_out, seconds, terminal, rows=statistics(folder / "statistics"))
    summary = folder / "summary.json"
    if summary.is_file():
        result.summary = json.loads(summary.read_text(encoding="utf-8"))
    pictures = sorted(folder.glob("contact_*.vtu"))
    if pictures and result.converged():  # others may be written in part
        result.nodes = vtu.read(pictures[-1])
    return result


def run(program, scene, folder, settings=(), ranks=1, time_limit=60):
    """Write the scene into @p folder and run it there; @p settings are "Section/Key=value"."""
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.iterdir():
        if old.is_file():
            old.unlink()
    (folder / "scene.prm").write_text(text.write(scene), encoding="utf-8")
    command = (["mpirun", "-n", str(ranks)] if ranks > 1 else []) + \
        [str(program), "scene.prm", "--output", ".", "--set", "Output/VTU interval=100000"]
    for setting in settings:
        command += ["--set", setting]
    usage = processes.run(command, folder, folder / "terminal", time_limit)
    return read(folder, usage.exit_code, usage.timed_out, usage.wall_seconds)


def folder_of(parent, name):
    return pathlib.Path(parent) / re.sub(r"[^A-Za-z0-9]+", "_", name)

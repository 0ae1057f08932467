# SPDX-License-Identifier: LGPL-2.1-or-later
"""How the program answers to an input with a fault."""

import dataclasses
import pathlib
import random
import re

from benchmarking import processes

from . import mutations, runs

FORM = re.compile(r"Input error in .*'.*'.*: .*Remedy: .+", re.S)


@dataclasses.dataclass
class Answer:
    """To one mutation of one scene."""
    source: pathlib.Path
    mutation: mutations.Mutation
    verdict: str
    said: str


def shipped(root):
    """Scenes that are small, with their mesh files if they have one."""
    scenes = sorted((root / "prm").glob("*.prm")) + sorted((root / "prm/benchmarks").glob("*.prm")) + \
        sorted((root / "tests").glob("*.prm"))
    result = []
    for path in scenes:
        found = re.search(r"set File\s*=\s*(\S+)", path.read_text(encoding="utf-8"))
        result.append((path, path.parent / found[1] if found else None))
    return result


def mutate(rng, scenes):
    """One mutation of a random scene. @return its source and the mutation"""
    meshed = [s for s in scenes if s[1] is not None and s[1].is_file()]
    if rng.random() < 0.25:
        path, mesh = rng.choice(meshed)
        text = path.read_text(encoding="utf-8")
        # Only the first file of the scene is changed.
        return path, mesh, mutations.mesh(rng, text, mesh.read_bytes())
    path, mesh = rng.choice(scenes)
    return path, mesh, rng.choice(mutations.OF_SCENES)(rng, path.read_text(encoding="utf-8"))


def _execute(program, folder, mode, time_limit):
    command = [str(program), "scene.prm", "--output", "results"] + mode
    return processes.run(command, folder, folder / "terminal", time_limit)


def answer(program, path, mesh, mutation, folder, time_limit):
    """Validate, and where nothing is found wrong run for a short time."""
    folder.mkdir(parents=True, exist_ok=True)
    scene = mutation.scene
    if mesh is not None:
        own = folder / mesh.name
        own.write_bytes(mesh.read_bytes() if mutation.mesh is None else mutation.mesh)
        scene = scene.replace(str(mesh.relative_to(path.parent)), mesh.name)
    (folder / "scene.prm").write_text(scene, encoding="utf-8", errors="replace")
    for mode in (["--validate"], ["--set", "Output/VTU interval=0"]):
        usage = _execute(program, folder, mode, time_limit)
        said = (folder / "terminal").read_text(encoding="utf-8", errors="replace").strip()
        verdict = judge(usage, said, mutation, mode == ["--validate"])
        if verdict:
            return Answer(path, mutation, verdict, said[-600:])
    return Answer(path, mutation, "accepted", said[-200:])


def judge(usage, said, mutation, validating):
    """A verdict, or nothing if this was a run without complaint."""
    if usage.timed_out:
        return "time limit of --validate" if validating else "accepted, runs on"
    raw = runs.RAW.search(said)
    if usage.exit_code < 0 or usage.exit_code > 3:
        return "crash"
    if raw:
        return f"raw text '{raw[0]}'"
    if usage.exit_code == 1:
        if not FORM.search(said):
            return "refused without section or remedy"
        return "refused" if validating else "refused, not by --validate"
    if usage.exit_code == 2:
        return "does not converge"
    if usage.exit_code:
        return f"exit code {usage.exit_code}"
    if not validating and re.search(r"\b-?(nan|inf)\b", said.split("Converged")[-1]):
        return "accepted, not a number"
    if not validating and mutation.wrong:
        return "accepted though wrong"
    return ""


def ask(program, root, count, seed, folder, time_limit):
    """Answers to @p count mutations, one after the other."""
    scenes = shipped(root)
    for index in range(count):
        rng = random.Random(f"inputs {seed}/{index}")
        path, mesh, mutation = mutate(rng, scenes)
        yield index, answer(program, path, mesh, mutation, folder / f"input_{index}", time_limit)

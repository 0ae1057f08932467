# SPDX-License-Identifier: LGPL-2.1-or-later
"""How the program answers to an input with a fault."""

import dataclasses
import random
import re

from benchmarking import processes

from . import further, mutations, runs

FORM = re.compile(r"Input error in .*'.*'.*: .*Remedy: .+", re.S)


@dataclasses.dataclass(frozen=True)
class Source:
    """A scene that is right, and its first mesh file if it has one."""
    name: str
    text: str
    # How the scene calls the mesh file, its name in the folder of the run, and what it has.
    called: str = ""
    mesh_name: str = ""
    mesh: bytes = None


@dataclasses.dataclass
class Answer:
    """To one mutation of one scene."""
    source: Source
    mutation: mutations.Mutation
    verdict: str
    said: str


def sources(root):
    """Shipped scenes that are small, and those of further.py."""
    paths = sorted((root / "prm").glob("*.prm")) + sorted((root / "prm/benchmarks").glob("*.prm")) + \
        sorted((root / "tests").glob("*.prm"))
    result = []
    for path in paths:
        text = path.read_text(encoding="utf-8")
        found = re.search(r"set File\s*=\s*(\S+)", text)
        if found and (path.parent / found[1]).is_file():
            mesh = path.parent / found[1]
            result.append(Source(path.name, text, found[1], mesh.name, mesh.read_bytes()))
        else:
            result.append(Source(path.name, text))
    for name, text, mesh in further.scenes():
        result.append(Source(name, text, mesh[0], *mesh) if mesh else Source(name, text))
    return result


def mutate(rng, scenes):
    """One mutation of a random scene. @return its source and the mutation"""
    if rng.random() < 0.25:
        source = rng.choice([s for s in scenes if s.mesh is not None])
        # Only the first file of the scene is changed.
        return source, mutations.mesh(rng, source.text, source.mesh)
    source = rng.choice(scenes)
    return source, rng.choice(mutations.OF_SCENES)(rng, source.text)


def _execute(program, folder, mode, time_limit):
    command = [str(program), "scene.prm", "--output", "results"] + mode
    return processes.run(command, folder, folder / "terminal", time_limit)


def answer(program, source, mutation, folder, time_limit):
    """Validate, and where nothing is found wrong run for a short time."""
    folder.mkdir(parents=True, exist_ok=True)
    scene = mutation.scene
    if source.mesh is not None:
        (folder / source.mesh_name).write_bytes(
            source.mesh if mutation.mesh is None else mutation.mesh)
        scene = scene.replace(source.called, source.mesh_name)
    (folder / "scene.prm").write_text(scene, encoding="utf-8", errors="replace")
    for mode in (["--validate"], ["--set", "Output/VTU interval=0"]):
        usage = _execute(program, folder, mode, time_limit)
        said = (folder / "terminal").read_text(encoding="utf-8", errors="replace").strip()
        verdict = judge(usage, said, mutation, mode == ["--validate"])
        if verdict:
            return Answer(source, mutation, verdict, said[-600:])
    return Answer(source, mutation, "accepted", said[-200:])


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
    scenes = sources(root)
    for index in range(count):
        rng = random.Random(f"inputs {seed}/{index}")
        source, mutation = mutate(rng, scenes)
        yield index, answer(program, source, mutation, folder / f"input_{index}", time_limit)

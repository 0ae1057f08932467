# SPDX-License-Identifier: LGPL-2.1-or-later
"""Campaign files: what is run. Their format is documented in contrib/benchmark --help."""

import csv
import dataclasses
import difflib
import itertools
import math
import pathlib
import re
import tomllib

from .choices import AXES, CHOICES, DEFAULTS, plural


class CampaignError(Exception):
    """A campaign file that cannot be used: the message names file, key and remedy."""


TOP = ("title", "scene", "errors", "repeat", "time_limit", "settings", "meshes", "contender",
       "quick", "quantities", "curves", "tolerances", "columns")
QUICK = ("meshes", "repeat", "contenders")
CONTENDER = ("name", "program", "meshes", "settings", "tension")


@dataclasses.dataclass
class Quantity:
    """A result whose relative difference from a known value is an error."""
    path: list
    exact: float


@dataclasses.dataclass
class Curve:
    """A reaction over time that is compared with a known one, in the square mean."""
    support: str
    axis: int
    # Time and value.
    known: list

    def error(self, computed):
        """@param computed Pairs of time and value, in order; linear between them.
        @throws ValueError if they end before the known ones"""
        error = 0.0
        for time, value in self.known:
            after = next((k for k, (t, _) in enumerate(computed) if t >= time - 1e-6), None)
            if after is None:
                raise ValueError(f"there is no value at time {time:g}")
            (t0, v0), (t1, v1) = computed[max(after - 1, 0)], computed[after]
            part = min((time - t0) / (t1 - t0), 1.0) if t1 > t0 else 1.0
            error += (v0 + part * (v1 - v0) - value) ** 2
        return math.sqrt(error / sum(v * v for _, v in self.known))


@dataclasses.dataclass
class Case:
    """One point of a diagram: a contender on a mesh."""
    line: str
    mesh: str
    program: str
    choices: dict
    settings: dict
    tension: float = 0.0

    @property
    def name(self):
        """For folders and messages."""
        return f"{self.line}, {self.mesh}"

    @property
    def folder(self):
        return re.sub(r"[^A-Za-z0-9_.-]+", "_", self.name)


@dataclasses.dataclass
class Campaign:
    name: str
    title: str
    scene: pathlib.Path
    errors: list
    repeat: int
    time_limit: float
    quantities: dict
    tolerances: list
    columns: dict
    # Names, from coarse to fine.
    meshes: list
    cases: list
    curves: dict = dataclasses.field(default_factory=dict)


def _fail(path, text):
    raise CampaignError(f"{path}: {text}")


def _known(path, where, names, known):
    for name in names:
        if name not in known:
            near = difflib.get_close_matches(name, known, 1)
            hint = f", did you mean '{near[0]}'?" if near else ""
            _fail(path, f"{where} has no key '{name}'{hint} Known: {', '.join(known)}.")


def _typed(path, where, table, key, kind, default=None):
    """The value of @p key, which must be of a kind."""
    if key not in table:
        if default is None:
            _fail(path, f"{where} lacks the key '{key}'.")
        return default
    value = table[key]
    if not isinstance(value, kind) or isinstance(value, bool):
        names = " or ".join(k.__name__ for k in (kind if isinstance(kind, tuple) else (kind,)))
        _fail(path, f"{where}, key '{key}': {value!r} is no {names}.")
    return value


def _subsets(path, where, chosen, known):
    for name in chosen:
        if name not in known:
            _fail(path, f"{where}: there is no '{name}'. There are {', '.join(known)}.")


def scene_lists(scene):
    """Names of the bodies and contact pairs of a scene."""
    text = scene.read_text(encoding="utf-8")

    def names(key):
        match = re.search(rf"^set\s+{key}\s*=\s*(.*?)\s*$", text, re.MULTILINE)
        return [name.strip() for name in match[1].split(",")] if match else []

    return {"body": names("Bodies"), "pair": names("Contact pairs")}


def _axis_settings(axis, value, lists):
    """What the scene must set for this value of an axis."""
    key = AXES["touchstone"][axis]
    if key is None:
        return {}
    match = re.search(r"\{(\w+)\}", key)
    if not match:
        return {key: value}
    return {key.format(**{match[1]: name}): value for name in lists[match[1]]}


def _axes(path, where, contender, program):
    """The axes of a contender and their values, one or several."""
    result = {}
    for axis in AXES[program]:
        if axis in contender and plural(axis) in contender and plural(axis) != axis:
            _fail(path, f"{where}: give '{axis}' or '{plural(axis)}', not both.")
        value = contender.get(plural(axis), contender.get(axis))
        if value is None:
            continue
        values = value if isinstance(value, list) else [value]
        if not values:
            _fail(path, f"{where}, key '{plural(axis)}': the list is empty.")
        allowed = CHOICES.get(program, {}).get(axis)
        for v in values if allowed else ():
            if v not in allowed:
                _fail(path, f"{where}, key '{axis}': there is no '{v}'. There are "
                            f"{', '.join(map(str, allowed))}.")
        result[axis] = values
    return result


def _contender_cases(path, number, contender, meshes, lists, common):
    where = f"contender {number + 1}"
    program = contender.get("program", "touchstone")
    if program not in AXES:
        _fail(path, f"{where}: there is no program '{program}'. There are {', '.join(AXES)}.")
    names = list(CONTENDER) + list(AXES[program]) + [plural(a) for a in AXES[program]]
    _known(path, where, contender, list(dict.fromkeys(names)))
    name = _typed(path, where, contender, "name", str)
    settings = _typed(path, where, contender, "settings", dict, {})
    tension = _typed(path, where, contender, "tension", (int, float), 0.0)
    chosen = _typed(path, where, contender, "meshes", list, list(meshes))
    _subsets(path, f"{where}, key 'meshes'", chosen, meshes)
    axes = _axes(path, where, contender, program)
    if "node to surface" in axes.get("contact", ()) and tension <= 0:
        _fail(path, f"{where}: node-to-surface contact of CalculiX needs the key 'tension', the "
                    "stress of open contact at a large gap, e.g. 0.25 % of the largest pressure.")

    cases = []
    for combination in itertools.product(*axes.values()):
        choices = dict(zip(axes, combination))
        # A line of the diagram is named by what the contender varies.
        varied = [str(v) if isinstance(v, str) else f"{axis} {v}"
                  for axis, v in choices.items() if len(axes[axis]) > 1]
        line = ", ".join([name] + varied)
        choices = DEFAULTS.get(program, {}) | choices
        if program == "calculix":
            if (choices["degree"] == 2) != choices["element"].startswith("C3D20"):
                _fail(path, f"{where}: degree 2 goes with the elements C3D20 and C3D20R, "
                            "degree 1 with the others.")
        for mesh in chosen:
            of_axes = {}
            for axis in choices:
                if program == "touchstone" or axis == "degree":
                    of_axes |= _axis_settings(axis, choices[axis], lists)
            cases.append(Case(line, mesh, program, choices,
                              common | meshes[mesh] | settings | of_axes, tension))
    return cases


def _curves(path, table):
    """The known curves: columns of a CSV file beside the campaign."""
    result = {}
    for name, entry in _typed(path, "the campaign", table, "curves", dict, {}).items():
        where = f"curve '{name}'"
        _known(path, where, entry, ("support", "axis", "file", "column"))
        file = path.parent / _typed(path, where, entry, "file", str)
        column = _typed(path, where, entry, "column", str)
        try:
            with open(file, encoding="utf-8", newline="") as lines:
                rows = csv.DictReader(line for line in lines if not line.startswith("#"))
                known = [(float(row["time"]), float(row[column])) for row in rows]
        except (OSError, KeyError, ValueError) as error:
            _fail(path, f"{where}: '{file}' has no columns 'time' and '{column}': {error}")
        result[name] = Curve(_typed(path, where, entry, "support", str),
                             _typed(path, where, entry, "axis", int), known)
    return result


def load(path, root, quick=False):
    """Read a campaign.

    @param root  Folder to which the scene's name is relative.
    @param quick Take what the table 'quick' allows.
    @throws CampaignError
    """
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        raise CampaignError(f"{path}: cannot be read: {error}") from error
    except tomllib.TOMLDecodeError as error:
        raise CampaignError(f"{path}: no TOML: {error}") from error
    _known(path, "the campaign", table, TOP)
    scene = root / _typed(path, "the campaign", table, "scene", str)
    if not scene.is_file():
        _fail(path, f"there is no scene '{scene}'.")
    meshes = _typed(path, "the campaign", table, "meshes", dict)
    if not meshes or not all(isinstance(m, dict) for m in meshes.values()):
        _fail(path, "the table 'meshes' must hold a table of settings for each mesh.")
    quantities = {}
    for name, entry in _typed(path, "the campaign", table, "quantities", dict, {}).items():
        _known(path, f"quantity '{name}'", entry, ("path", "exact"))
        quantities[name] = Quantity(_typed(path, name, entry, "path", list),
                                    _typed(path, name, entry, "exact", (int, float)))

    rapid = _typed(path, "the campaign", table, "quick", dict, {})
    _known(path, "the table 'quick'", rapid, QUICK)
    _subsets(path, "the table 'quick', key 'meshes'", rapid.get("meshes", []), meshes)
    lists = scene_lists(scene)
    contenders = _typed(path, "the campaign", table, "contender", list)
    names = [c.get("name") for c in contenders]
    _subsets(path, "the table 'quick', key 'contenders'", rapid.get("contenders", []), names)
    cases = []
    for number, contender in enumerate(contenders):
        own = _contender_cases(path, number, contender, meshes, lists,
                               _typed(path, "the campaign", table, "settings", dict, {}))
        if not quick or contender["name"] in rapid.get("contenders", names):
            cases += own
    if quick:
        cases = [case for case in cases if case.mesh in rapid.get("meshes", meshes)]
    twice = {case.folder for case in cases}
    if len(twice) < len(cases):
        _fail(path, "two contenders have the same name and choices; give them other names.")
    return Campaign(
        name=path.stem, title=_typed(path, "the campaign", table, "title", str), scene=scene,
        errors=_typed(path, "the campaign", table, "errors", list),
        repeat=rapid.get("repeat", 1) if quick
        else _typed(path, "the campaign", table, "repeat", int, 3),
        time_limit=_typed(path, "the campaign", table, "time_limit", (int, float), 600),
        quantities=quantities,
        tolerances=_typed(path, "the campaign", table, "tolerances", list, [0.05, 0.01, 0.001]),
        columns=_typed(path, "the campaign", table, "columns", dict, {}), meshes=list(meshes),
        cases=cases, curves=_curves(path, table))

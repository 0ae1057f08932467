# SPDX-License-Identifier: LGPL-2.1-or-later
"""The discrete problem of a scene (--export-model), which other programs are given, and what
they answer in the terms of summary.json."""

import json
import math

from . import processes, surfaces, touchstone


class ModelError(Exception):
    """The scene has something that a translation does not know."""


def export(program, case, campaign, folder):
    """Nodes, cells, supports, loads and contact surfaces. @throws ModelError"""
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / "model.json"
    words = [str(program), str(campaign.scene), "--export-model", str(file)]
    for key, value in case.settings.items():
        words += ["--set", f"{key}={value}"]
    usage = processes.run(words, campaign.scene.parent, folder / "export", campaign.time_limit)
    if usage.failure():
        text = (folder / "export").read_text(encoding="utf-8", errors="replace").strip()
        raise ModelError(f"export: {usage.failure()}: {text}")
    return json.loads(file.read_text(encoding="utf-8"))


def only_pair(model, laws):
    """The contact pair of a model that can be translated. @throws ModelError"""
    if len(model["pairs"]) != 1 or not model["pairs"][0]["master"]:
        raise ModelError("only scenes with one contact pair of two bodies can be translated")
    pair = model["pairs"][0]
    if pair["behaviour"] not in ("frictionless", "coulomb"):
        raise ModelError(f"contact that is '{pair['behaviour']}' is not translated")
    for body in model["bodies"]:
        if body["law"] not in laws:
            raise ModelError(f"the material law '{body['law']}' is not translated")
    return pair


def face_size(pair, model):
    """Root of the mean area of a slave face."""
    areas = surfaces.node_areas(pair["slave"], model["nodes"], model["degree"])
    return math.sqrt(sum(areas.values()) / len(pair["slave"]))


def summary(history):
    """Reactions at the end of the run, where summary.json has them."""
    reactions = {}
    for support, force in history[-1]["reactions"].items():
        body, boundary = support.split("/", 1)
        reactions.setdefault(body, {})[boundary] = force
    return {"results": {"reactions": reactions}}


def quantities(campaign, history):
    """Errors of the campaign's quantities and curves from the reactions of all steps, a list of
    {"time": t, "reactions": {"body/boundary": [x, y, z]}}. @throws ModelError"""
    try:
        result = {name: abs(touchstone.dig(summary(history), q.path) / q.exact - 1)
                  for name, q in campaign.quantities.items()}
        return result | {name: curve.error([(h["time"], h["reactions"][curve.support][curve.axis])
                                            for h in history])
                         for name, curve in campaign.curves.items()}
    except (KeyError, ValueError, touchstone.MissingResult) as error:
        raise ModelError(f"no such result: {error}") from error

# SPDX-License-Identifier: LGPL-2.1-or-later
"""The simplest scene in which the same is found."""

import dataclasses

from . import campaign


def _without_pair(scene):
    """Without one pair, and the body or obstacle that nothing else touches then."""
    for i in range(len(scene.pairs) if len(scene.pairs) > 1 else 0):
        pairs = scene.pairs[:i] + scene.pairs[i + 1:]
        touched = {name for p in pairs for name in (p.slave, p.master)}
        yield dataclasses.replace(
            scene, pairs=pairs, bodies=tuple(b for b in scene.bodies if b.name in touched),
            obstacles=tuple(o for o in scene.obstacles if o.name in touched))


def _simpler_pairs(scene):
    for i, pair in enumerate(scene.pairs):
        simpler = [dataclasses.replace(pair, behaviour="frictionless", coefficient=0.0)]
        simpler += [dataclasses.replace(pair, settings=pair.settings[:j] + pair.settings[j + 1:])
                    for j in range(len(pair.settings))]
        for new in simpler:
            if new != pair:
                yield dataclasses.replace(scene, pairs=scene.pairs[:i] + (new,) +
                                          scene.pairs[i + 1:])


def _simpler_bodies(scene):
    for i, body in enumerate(scene.bodies):
        young = {"Young modulus": body.moduli["Young modulus"]}
        elastic = dataclasses.replace(body, moduli=young,
                                      material={"Law": "linear elastic", "Poisson ratio": "0.3"})
        geometry, simpler = body.geometry, [elastic]
        for name, value in (("grading", (1, 1, 1)), ("rotation", (0, 0, 0))):
            if isinstance(getattr(geometry, name, None), tuple):
                simpler.append(dataclasses.replace(
                    body, geometry=dataclasses.replace(geometry, **{name: value})))
        if hasattr(geometry, "cells"):
            for j, n in enumerate(geometry.cells):
                if n > 1:
                    cells = geometry.cells[:j] + (n - 1,) + geometry.cells[j + 1:]
                    simpler.append(dataclasses.replace(
                        body, geometry=dataclasses.replace(geometry, cells=cells)))
        for new in simpler:
            if new != body:
                yield dataclasses.replace(scene, bodies=scene.bodies[:i] + (new,) +
                                          scene.bodies[i + 1:])


def _simpler_run(scene):
    if scene.settings:
        yield dataclasses.replace(scene, settings=())
    if scene.end_time > 1:
        yield dataclasses.replace(scene, end_time=scene.end_time - 1,
                                  steps=scene.steps * (scene.end_time - 1) // scene.end_time)
    if scene.steps > scene.end_time:
        yield dataclasses.replace(scene, steps=scene.steps - 1)


def simpler(scene):
    """Scenes with one thing less, the largest things first."""
    for kind in (_without_pair, _simpler_run, _simpler_pairs, _simpler_bodies):
        yield from kind(scene)


def in_units_of_one(scene):
    """With lengths and moduli near one."""
    length = 10 / scene.size() if not 0.1 < scene.size() < 100 else 1.0
    young = scene.bodies[0].moduli["Young modulus"]
    return dataclasses.replace(scene.rescaled(length, 1000 / young), length=1.0, stress=1.0)


def shrink(verdict, program, folder, time_limit, runs=60):
    """Simplify a scene as long as the first kind of finding remains. @return a verdict"""
    kind = verdict.kinds()[0]
    names = {name for name, f in verdict.findings if f.kind == kind}
    variants = () if "default" in names else \
        [v for v in campaign.VARIANTS if v.name in names][:1]

    def again(scene):
        return campaign.judge_scene(scene, verdict.index, variants, program, folder, time_limit)

    best, progress = verdict, True
    candidates = [in_units_of_one(verdict.scene)]
    while progress and runs > 0:
        progress = False
        for scene in candidates or simpler(best.scene):
            runs -= 1
            new = again(scene)
            if kind in new.kinds():
                best, progress = new, True
                break
            if runs <= 0:
                break
        progress, candidates = progress or bool(candidates), []
    return best

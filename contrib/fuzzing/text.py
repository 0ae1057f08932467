# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of a scene, as the program reads it."""

from .geometry import AXES, number, numbers


def _section(name, lines):
    return [f"subsection {name}"] + ["  " + line for line in lines] + ["end"]


def _set(keys):
    width = max((len(k) for k in keys), default=0)
    return [f"set {k:{width}} = {v}" for k, v in keys.items() if v != ""]


def _body(body):
    lines = _set({"Fixed": ", ".join(body.fixed), "Symmetry": ", ".join(body.symmetry),
                  "Boundary conditions": ", ".join(b for b, _ in body.conditions)})
    for boundary, condition in body.conditions:
        lines += _section(f"Boundary {boundary}", _set(condition.keys()))
    lines += _section("Geometry", _set(body.geometry.keys()))
    moduli = {k: number(v) for k, v in body.moduli.items()}
    plastic = {k: moduli.pop(k) for k in ("Yield stress", "Hardening modulus") if k in moduli}
    material = _set(body.material | moduli)
    if plastic:
        material += _section("Plasticity", _set({"Hardening": "linear"} | plastic))
    return _section(f"Body {body.name}", lines + _section("Material", material))


def _obstacle(obstacle):
    keys = {"Shape": obstacle.shape, "Point": numbers(obstacle.point)}
    if obstacle.shape != "sphere":
        keys["Direction"] = numbers(obstacle.direction)
    if obstacle.shape != "plane":
        keys |= {"Radius": number(obstacle.radius), "Side": obstacle.side}
    keys |= {f"Motion {a}": str(f) for a, f in zip(AXES, obstacle.motion) if f is not None}
    return _section(f"Obstacle {obstacle.name}", _set(keys))


def _pair(pair, scene):
    keys = {"Slave body": pair.slave, "Slave boundaries": ", ".join(pair.slave_boundaries)}
    if pair.master in [o.name for o in scene.obstacles]:
        keys["Obstacle"] = pair.master
    else:
        keys |= {"Master body": pair.master,
                 "Master boundaries": ", ".join(pair.master_boundaries)}
    keys |= dict(pair.settings) | {"Behaviour": pair.behaviour}
    lines = _set(keys)
    if pair.behaviour != "frictionless":
        key = "Coefficient" if pair.behaviour == "coulomb" else "Shear strength"
        lines += _section("Friction", _set({key: number(pair.coefficient)}))
    return _section(f"Contact pair {pair.name}", lines)


def _load_stepping(scene):
    if not scene.ends:
        return _set({"End time": number(scene.end_time), "Steps": str(scene.steps)})
    lines = _set({"Phases": ", ".join(f"to {i}" for i in range(len(scene.ends)))})
    for i, end in enumerate(scene.ends):
        lines += _section(f"Phase to {i}", _set({"End time": repr(end)}))
    return lines


def write(scene, head=()):
    """The scene file; lines of @p head become comments on top."""
    parts = [[f"# {line}".rstrip() for line in head]]
    parts.append(_set({"Title": scene.title, "Bodies": ", ".join(b.name for b in scene.bodies),
                       "Obstacles": ", ".join(o.name for o in scene.obstacles),
                       "Contact pairs": ", ".join(p.name for p in scene.pairs)}))
    parts += [_body(b) for b in scene.bodies]
    parts += [_obstacle(o) for o in scene.obstacles]
    parts += [_pair(p, scene) for p in scene.pairs]
    parts.append(_section("Load stepping", _load_stepping(scene)))
    sections = {}
    for key, value in scene.settings:
        section, name = key.split("/")
        sections.setdefault(section, {})[name] = value
    parts += [_section(name, _set(keys)) for name, keys in sections.items()]
    return "\n\n".join("\n".join(part) for part in parts if part) + "\n"

# SPDX-License-Identifier: LGPL-2.1-or-later
"""A tightened bolt that turns by 90 degrees is moved rigidly: its tension and its strain energy stay
as they are. By force and by length, locked or not, of degree 1 and 2, with each enforcement, on two
ranks and after a restart. A law for small strain, for which such a turn is a strain, says so, or ends the run."""

from touchstone_test import (AUGMENTED, DEGREE, MULTIPLIERS, below, check, checks, finish, folder, relative,
                             run, same, stopped_and_resumed)

scene = checks / "turned_bolt.prm"
LINEAR = {f"Body {body}/Material/Law": "linear elastic" for body in ("lower", "upper")}
BY_LENGTH = {"Contact pair cut/Pretension force": "",
             "Contact pair cut/Pretension shortening": "0.2*min(t, 1)"}
NOT_LOCKED = {"Contact pair cut/Pretension until": ""}


def turned(name, settings=None, ranks=1):
    """Steps 3 to 8 turn what the first two have tightened."""
    result = run(name, scene, settings, ranks)
    pull, energy = result.column("cut: tension"), result.column("energy: strain")
    check(len(pull) == 8, f"{name}: {len(pull)} steps")
    for step in range(2, 8):
        below(f"{name}, step {step + 1}: tension", relative(pull[step], pull[1]), 1e-6)
        below(f"{name}, step {step + 1}: energy", relative(energy[step], energy[1]), 1e-6)
    # Across the cut there is nothing else: at the end the bolt lies along -y.
    force = [result.column(f"cut: force {axis}")[-1] / pull[1] for axis in "xyz"]
    below(f"{name}: direction of the force", abs(force[1] - 1) + abs(force[0]) + abs(force[2]), 1e-6)
    below(f"{name}: iterations in the last step", result.column("Newton iterations")[-1], 14)
    return result


one = turned("force")
below("tension", relative(one.column("cut: tension")[1], 80), 1e-7)
same(one, turned("force-2", ranks=2), 1e-7)
same(one, stopped_and_resumed("force", scene, {}, 4), 1e-9)
turned("not locked", NOT_LOCKED)
turned("length", BY_LENGTH)
for name, settings in (("multipliers", MULTIPLIERS), ("augmented", AUGMENTED)):
    below(f"{name}: tension", relative(turned(name, settings).column("cut: tension")[-1], 80), 1e-7)
for name, settings in (("force", {}), ("length", BY_LENGTH)):
    two = turned(f"degree 2, {name}", {DEGREE: 2, **settings})
    same(two, turned(f"degree 2, {name}, 2 ranks", {DEGREE: 2, **settings}, 2), 1e-7)


def told(result, bodies=("lower", "upper")):
    """Bodies whose law does not turn with them."""
    return [body for body in bodies for text in result.summary["warnings"]
            if f"body '{body}'" in text and "has turned by" in text]


def turn_by(angle):
    """Settings: both ends turn by so much."""
    return {f"Obstacle {end}/Rotate angle": f"{angle}*max(t - 1, 0)" for end in ("foot", "head")}


check(told(one) == [], f"neo-Hookean: {one.summary['warnings']}")
# By 87 degrees a ball of the random scenes had turned, with forces that mean nothing and a warning.
result = run("linear", scene, LINEAR, fails=True)
check("body 'lower'" in result.text and "has turned by 6" in result.text, f"linear: {result.text[-400:]}")
result = run("linear, 3 degrees", scene, {**LINEAR, **turn_by(3)})
check(told(result) == ["lower", "upper"], f"linear, 3 degrees: {result.summary['warnings']}")
result = run("linear, 1 degree", scene, {**LINEAR, **turn_by(1)})
check(told(result) == [], f"linear, 1 degree: {result.summary['warnings']}")
# A strip that is bent turns most at its tip.
for load, warned in ("5*t", ["strip"]), ("0.5*t", []):
    result = run(f"bent by {load}", checks.parent / "large_bending.prm",
                 {"Body strip/Material/Law": "linear elastic", "Body strip/Boundary right/Traction z": load})
    check(told(result, ["strip"]) == warned, f"{result}: {result.summary['warnings']}")
# Held at both ends its halves turn against each other, and it has not turned as a whole: nothing was said of that.
HELD = {f"Body strip/Boundary right/Displacement {axis}": "0" for axis in "xyz"}
for load, warned in ("20*t", ["strip"]), ("5*t", []):
    result = run(f"bent between by {load}", checks.parent / "large_bending.prm",
                 {"Body strip/Material/Law": "linear elastic", "Body strip/Boundary right/Traction z": "", **HELD,
                  "Body strip/Body force z": load})
    check(told(result, ["strip"]) == warned, f"{result}: {result.summary['warnings']}")

# A cube that begins turned by 60 degrees, and spins, in explicit dynamics: energy comes from its law, and no
# 'Courant factor' helps, which was the advice.
(folder / "spinning.prm").write_text("""set Bodies = cube
subsection Body cube
  set Initial displacement x = -0.5*x - sin(pi/3)*y
  set Initial displacement y = sin(pi/3)*x - 0.5*y
  set Initial velocity x     = -3*(sin(pi/3)*x + 0.5*y)
  set Initial velocity y     = 3*(0.5*x - sin(pi/3)*y)
  subsection Geometry
    set Type         = box
    set Lower corner = -0.5, -0.5, -0.5
    set Upper corner = 0.5, 0.5, 0.5
    set Cells        = 3, 3, 3
  end
  subsection Material
    set Young modulus = 1000
    set Poisson ratio = 0.3
    set Density       = 1
  end
end
subsection Time integration
  set Scheme = central_differences
end
subsection Load stepping
  set End time = 2
  set Steps    = 200
end
""", encoding="utf-8")
result = run("spinning", "spinning.prm", fails=True)
check("has turned by" in result.text, f"spinning: {result.text[-400:]}")
finish()

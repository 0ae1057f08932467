# SPDX-License-Identifier: LGPL-2.1-or-later
"""Thin bodies all sides of which are named: the far sides are near what touches the near ones, and
must not be taken for overlaps; nor those of thick ones, beside whose edges what moves past is behind planes of
their sides. Plates one on the other and bars that cross come to the forces that
they have if only the near sides are named. Before, plates had an initial overlap of both
thicknesses and ended with exit code 2, and bars pulled with exit code 0."""

from touchstone_test import MULTIPLIERS, STEPS, below, check, finish, folder, relative, run

HEAD = "set Bodies        = lower, upper\nset Contact pairs = c\n"
BODY = """subsection Body {name}
  {held}
  subsection Geometry
    set Lower corner = {lower[0]}, {lower[1]}, {lower[2]}
    set Upper corner = {upper[0]}, {upper[1]}, {upper[2]}
    set Cells        = {cells}
    set Rotation     = {rotation}
  end
  subsection Material
    set Law           = neo-Hookean
    set Young modulus = 1000
    set Poisson ratio = 0.3
  end
"""
DRIVEN = """  subsection Boundary {side}
    set Displacement x = 0
    set Displacement y = 0
    set Displacement z = -{drive} * t
  end
"""
PAIR = """subsection Contact pair c
  set Slave body        = upper
  set Slave boundaries  = {slave}
  set Master body       = lower
  set Master boundaries = {master}
end
subsection Load stepping
  set Steps = 2
end
"""


def body(name, lower, size, cells, rotation="0, 0, 0", drive=0.0, sides=("left", "right")):
    """A box; without a drive its sides are held."""
    held = ", ".join(sides)
    text = BODY.format(name=name, held=f"set Boundary conditions = {held}" if drive else f"set Fixed = {held}",
                       lower=lower, upper=[a + b for a, b in zip(lower, size)], cells=cells, rotation=rotation)
    if drive:
        text += "".join(DRIVEN.format(side=side, drive=drive) for side in sides)
    return text + "end\n"


def plates(gap, drive, thickness=0.05):
    size = (1, 1, thickness)
    return (HEAD + body("lower", (0, 0, 0), size, "4, 4, 1") +
            body("upper", (0, 0, thickness + gap), size, "3, 3, 1", drive=drive))


def bars(gap, drive, thickness=0.1):
    """Two square bars that stand on their edges and cross in the middle."""
    half = thickness / 2**0.5
    return (HEAD + body("lower", (0, 0, 0), (1, thickness, thickness), "3, 1, 1", "45, 0, 0") +
            body("upper", (0.5 - half, -0.5, 3 * half + gap), (thickness, 1, thickness), "1, 3, 1", "0, 45, 0",
                 drive, ("front", "back")))


def compared(name, text, slave, master, pairings):
    """Run a scene with the near sides and with more of them."""
    results = {}
    for sides in range(len(slave)):
        path = folder / f"{name}_{sides}.prm"
        path.write_text(text + PAIR.format(slave=", ".join(slave[:sides + 1]), master=", ".join(master[:sides + 1])),
                        encoding="utf-8")
        for pairing in pairings:
            results[pairing, sides] = run(f"{path.stem}_{pairing}", path, {"Contact pair c/Pairing": pairing})
    last = len(slave) - 1
    for pairing in pairings:
        near = results[pairing, 0].force("c")[2]
        check(near > 0., f"{name}, {pairing}: no force")
        for sides in range(1, last + 1):
            below(f"{name}, {pairing}, {sides} more sides: force",
                  max(abs(a - b) for a, b in zip(results[pairing, sides].force("c"), (0, 0, near))) / near, 1e-8)
    near = results[pairings[0], 0].force("c")[2]
    for other, settings, ranks in (("multipliers", MULTIPLIERS, 1), ("one_step", {STEPS: 1}, 1), ("two_ranks", {}, 2)):
        result = run(f"{name}_{other}", folder / f"{name}_{last}.prm",
                     {"Contact pair c/Pairing": pairings[0], **settings}, ranks)
        below(f"{name}, {other}: force", abs(result.force("c")[2] - near) / near, 1e-6)


compared("plates", plates(0.01, 0.02), ("bottom", "top"), ("top", "bottom"), ("averaged", "pointwise", "inside-outside"))
compared("all_sides", plates(0.01, 0.02), ("bottom", "top, front, back"), ("top", "bottom, front, back"), ("averaged",))
for name, gap, drive in (("bars", 0.002, 0.03), ("bars_overlap", -0.02, 0.008)):
    compared(name, bars(gap, drive), ("bottom, right", "top, left"), ("top, back", "bottom, front"),
             ("averaged", "pointwise"))

# Blocks that meet beside each other's edges, in explicit dynamics; sides between those that are named are not.
# With a search distance that does not reach the far sides nothing is to be told from them.
COLLISION = """set Bodies = a, b
set Contact pairs = c
subsection Body a
  set Initial velocity x = {velocity[0]}
  set Initial velocity y = {velocity[1]}
  set Initial velocity z = {velocity[2]}
  subsection Geometry
    set Lower corner = {corner[0]}, {corner[1]}, {corner[2]}
    set Upper corner = {corner[3]}, {corner[4]}, {corner[5]}
    set Cells        = 3, 3, 3
  end
  subsection Material
    set Young modulus = 1000
    set Poisson ratio = 0.3
    set Law           = neo-Hookean
    set Density       = 1
  end
end
subsection Body b
  set Initial velocity x = {other[0]}
  set Initial velocity y = {other[1]}
  set Initial velocity z = {other[2]}
  subsection Geometry
    set Upper corner = 1, 1.2, 1
    set Cells        = 2, 3, 2
  end
  subsection Material
    set Young modulus = 2000
    set Poisson ratio = 0.3
    set Law           = neo-Hookean
    set Density       = 2
  end
end
subsection Contact pair c
  set Slave body        = a
  set Slave boundaries  = {slave}
  set Master body       = b
  set Master boundaries = {master}
  set Pairing           = {pairing}
end
subsection Time integration
  set Scheme = central_differences
end
subsection Load stepping
  set End time = {end}
  set Steps    = {steps}
end
subsection Output
  set VTU interval = 0
end
"""
BESIDE = {"velocity": (1, 0, 0), "other": (0, 0, 0), "corner": (-1.02, -0.4, 0, -0.02, 0.6, 1), "slave": "right, front",
          "master": "left, back", "end": 0.2, "steps": 40}
SPINNING = {"velocity": ("1-0.8*y", "0.8*(x+0.5)", 0.1), "other": (-1, "-0.5*(z-0.2)", "0.5*(y-0.6)"),
            "corner": (-1.05, -0.4, -0.45, -0.05, 0.6, 0.55), "slave": "right, back, top, front, bottom",
            "master": "left, front, bottom, back, top", "end": 0.05, "steps": 50}
for name, scene, pairing in (("beside", BESIDE, "inside-outside"), ("beside", BESIDE, "pointwise"),
                             ("spinning", SPINNING, "pointwise"), ("spinning", SPINNING, "averaged")):
    (folder / f"{name}_{pairing}.prm").write_text(COLLISION.format(pairing=pairing, **scene), encoding="utf-8")
    far, near = (run(f"{name}_{pairing}_{distance:g}", folder / f"{name}_{pairing}.prm", {"Contact pair c/Search distance": distance})
                 for distance in (0, 0.1))
    below(f"{far}, deepest penetration", max(row["c: max penetration"] for row in far.rows()), 0.01)
    below(f"{far}, energy at the end", relative(far.rows()[-1]["energy: kinetic"], near.rows()[-1]["energy: kinetic"]), 1e-3)
finish()

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies that reach into each other or into themselves are told of, implicit and explicit, on any
number of ranks; bodies that touch, and those whose overlap is adjusted, are not."""
# ctest: label = quick

from touchstone_test import check, checks, finish, folder, launch, run, settings_options, tests

CELLS = [(0, 0), (1, 0), (2, 0), (0, 1), (2, 1), (0, 2), (2, 2)]  # of the clamp: x and z of their lower corners


def write_clamp(path):
    """A base of three cubes with a leg of two on each end, away from the other bodies."""
    numbers = {}

    def node(x, y, z):
        return numbers.setdefault((x, y, z), len(numbers) + 1)

    def square(tag, corners):
        return f"3 2 {tag} {tag} " + " ".join(str(node(*corner)) for corner in corners)

    def cube(x, z):
        corners = [(x + a, b, z + c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        return "5 2 1 1 " + " ".join(str(node(*corner)) for corner in corners)

    def side(tag, x):
        return square(tag, [(x, 0, 2), (x, 1, 2), (x, 1, 3), (x, 0, 3)])

    elements = [side(1, 0), side(2, 3)]
    elements += [square(3, [(x, 0, 0), (x + 1, 0, 0), (x + 1, 1, 0), (x, 1, 0)]) for x in range(3)]
    elements += [cube(*lower) for lower in CELLS]
    names = ['2 1 "left"', '2 2 "right"', '2 3 "base"', '3 1 "clamp"']
    nodes = [f"{n} {x + 10} {y} {z}" for (x, y, z), n in numbers.items()]
    with open(path, "w", encoding="utf-8") as file:
        file.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n")
        for title, lines in (("PhysicalNames", names), ("Nodes", nodes),
                             ("Elements", [f"{k + 1} {line}" for k, line in enumerate(elements)])):
            file.write("\n".join([f"${title}", str(len(lines)), *lines, f"$End{title}"]) + "\n")


def overlaps(result):
    """The warnings of a run that tell of overlaps."""
    return [text for text in result.summary["warnings"] if "reaches into" in text]


write_clamp(folder / "clamp.msh")
(folder / "overlap.prm").write_text((checks / "warning_overlap.prm").read_text(encoding="utf-8"),
                                    encoding="utf-8")
one = run("one", "overlap.prm")
found = overlaps(one)
for expected in "body 'block' reaches into body 'base'", "body 'clamp' reaches into itself":
    check(any(text.startswith(expected) for text in found), f"no warning: {expected}; {found}")
one.says("body 'clamp' reaches into itself")
two = run("two", "overlap.prm", ranks=2)
check(overlaps(two) == found, f"two ranks tell something else: {overlaps(two)}")
dynamic = run("explicit", "overlap.prm", {"Time integration/Scheme": "central_differences"})
check(len(overlaps(dynamic)) == len(found), f"explicit: {overlaps(dynamic)}")

# A twenty-fifth of a cell deep, and a tenth of it: what no pair names is told of from a twentieth on.
near = run("near", "overlap.prm", {"Load stepping/End time": 0.08})
check(not overlaps(near), f"a shallow overlap is told of: {overlaps(near)}")
deeper = run("deeper", "overlap.prm", {"Load stepping/End time": 0.2})
check(any("body 'block' reaches into body 'base'" in text and "no contact pair names" in text for text in overlaps(deeper)),
      f"an overlap of faces that no pair names: {overlaps(deeper)}")
# A block that turns over on the ground: only one of the boundaries that are named faces it, and the block passes
# through it beside the others. Before, nothing was said. It has turned too far for its law, too.
SLAVES = "Contact pair contact/Slave boundaries"
for name, boundaries in ("top_left", "top, left"), ("top_front", "top, front"):
    through = run(name, tests / "held_by_contact.prm", {SLAVES: boundaries}, fails=True)
    words = through.log
    check("contact pair 'contact': body 'block' reaches into the obstacle 'ground'" in words and
          "Name all that may touch it in 'Slave boundaries'" in words, f"{name}: {words}")
one = run("top_left_two_ranks", tests / "held_by_contact.prm", {SLAVES: "top, left"}, ranks=2, fails=True)
check("reaches into the obstacle 'ground'" in one.log, f"two ranks: {one.log[-400:]}")
upright = run("upright", tests / "held_by_contact.prm", {SLAVES: "bottom"})
check(not overlaps(upright), f"a block on the ground: {overlaps(upright)}")
# Only the sides of a block are named: it stands on their lower edges, and its lower side sinks in between them by a fifth
# of a cell; before, nothing was said. On a body as on an obstacle, and on two ranks.
SIDES = {SLAVES: "left, right, front, back", "Body block/Boundary top/Pressure": "50 * t"}
for ranks in 1, 2:
    sides = run(f"sides_{ranks}", tests / "held_by_contact.prm", SIDES, ranks)
    check(len(overlaps(sides)) == 1 and "reaches into the obstacle 'ground', by 0.053" in overlaps(sides)[0],
          f"only the sides are named: {sides.summary['warnings']}")
for ranks in 1, 2:
    sides = run(f"sides_on_body_{ranks}", tests / "held_by_a_body.prm", SIDES, ranks)
    check(any("with a face that no contact pair names" in text for text in overlaps(sides)),
          f"only the sides are named, on a body: {sides.summary['warnings']}")
# Corners of the master within slave faces, whose nodes are open by 0.08: the report before the first step tells of them.
for ranks in 1, 2:
    start = run(f"between_nodes_{ranks}", checks / "tube_across_trough.prm", {}, ranks)
    start.says("smallest gap -0.09717, between them, at (0, -0.566, 0): an initial overlap, taken as interference")
# Also where it is adjusted, or grows with time: before, this was a gap of 0.08.
for treatment, words in ("adjust", "adjusted to no gap"), ("ramp", "an interference that grows with time"):
    setting = {"Contact pair contact/Initial overlap": treatment}
    report = launch("--validate", *settings_options(setting), checks / "tube_across_trough.prm").stdout
    check(f"smallest gap -0.09717, between them, at (0, -0.566, 0): an initial overlap, {words}" in report,
          f"{treatment}: {report}")
finish()

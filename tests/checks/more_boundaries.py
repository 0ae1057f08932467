# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes of contrib/fuzz_scenes with all boundaries named that lie beside those which touch: forces are those of
the scene as it is. The end of a shaft covers a strip of the far end of a bore, whose facets have straight edges,
and was taken for an overlap as deep as the bore: fits with clearance had a force (exit code 0) or did not converge.
The side of a leg that stands on a base was taken for an overlap as deep as it is from the side of that (exit code 2).
Slave nodes of a fit that lie at the sharp edge of the master and do not face the end beyond it had rows with the
normal of the end: the axial force was three times what it is (exit code 0)."""

from touchstone_test import below, check, finish, folder, run

# pylint: disable=wrong-import-order,import-error
from fuzzing import generator, text


def compared(name, seed, index, bound, pairings=()):
    """@p bound Of differences, by the largest force; zero where nothing touches."""
    scene = generator.scene(seed, index)
    paths = []
    for kind, which in (("near", scene), ("more", scene.with_sides())):
        paths.append(folder / f"{name}_{kind}.prm")
        paths[-1].write_text(text.write(which, []), encoding="utf-8")
    for pairing in pairings or ("",):
        settings = {f"Contact pair {pair.name}/Pairing": pairing for pair in scene.pairs} if pairing else {}
        runs = [run(f"{path.stem}_{pairing or 'default'}", path, settings) for path in paths]
        forces = [[f for pair in scene.pairs for f in one.force(pair.name)] for one in runs]
        largest = max(map(abs, forces[0]))
        check((largest > 0) == (bound > 0), f"{runs[0]}: largest force {largest}")
        difference = max(abs(a - b) for a, b in zip(*forces))
        if bound:
            below(f"{runs[1]}, forces", difference / largest, bound)
        else:
            check(difference == 0, f"{runs[1]} has a force of {difference} without contact")


compared("shaft_in_bore", 1200, 31, 0, ("averaged", "pointwise"))
compared("flush_ends", 1200, 18, 0, ("averaged", "pointwise"))
compared("table", 1200, 9, 1e-3)
compared("cone", 1201, 5, 1e-8)
finish()

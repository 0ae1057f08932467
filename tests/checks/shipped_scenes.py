# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shipped scenes that no golden runs: a mesh of 20-node hexahedra by Gmsh itself, a seal under an STL tool that a
force moves, a bolt with pretension, a ring that touches itself; their figures follow from statics."""

from touchstone_test import below, check, finish, folder, launch, prm, relative, run

# A quarter of the lug's cross-section of 40 x 8 under 100 MPa; the volume of the curved mesh is exact to 1e-5.
lug = run("lug", prm / "lug.prm", {"Output/Unsmoothed values": "points"}, vtu=1000)
below("lug: force", relative(-lug.force("bearing")[0], 8000), 1e-8)
below("lug: balance at the cut", relative(-lug.reaction("lug", "cut")[1], lug.force("bearing")[1]), 1e-8)
check(lug.cuts() == 0, "lug: steps were cut")

seal = run("seal", prm / "seal.prm")
below("seal: force", relative(-seal.force("lip")[2], 60), 1e-6)
depth = [-z for z in seal.column("obstacle rib: displacement z")]
check(depth == sorted(depth) and depth[-1] > 1, f"seal: the rib goes to {depth}")

# The bolt takes a small part of the pull until the flanges part, and then all of it.
bolt = run("bolt", prm / "bolt_pretension.prm")
tension, pull = bolt.column("cut: tension"), [2000 * max(0, t - 1) for t in bolt.column("time")]
below("bolt: tension of the phase 'tighten'", relative(tension[0], 5000), 1e-7)
below("bolt: part of the first pull", abs(tension[1] - tension[0]) / pull[1], 0.1)
below("bolt: all of the last pull", relative(tension[-1], pull[-1]), 1e-6)
check(bolt.cuts() == 0 and abs(bolt.force("parting line")[2]) < 1e-6, f"bolt: {bolt.force('parting line')}")

ring = run("ring", prm / "self_contact.prm")
check(ring.contact("itself", "active") >= 20, "ring: it does not touch itself")
below("ring: balance", relative(ring.force("top")[2], -ring.force("bottom")[2]), 1e-6)

# What a run has written down can be run again from there: names of mesh and STL files are those of the scene.
for name in "lug", "seal":
    done = launch("--validate", folder / name / "parameters.prm")
    check(done.returncode == 0, f"{name}: parameters.prm of the run: {done.stdout}")
finish()

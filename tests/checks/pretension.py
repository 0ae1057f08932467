# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pretension of a bolt: the tension is that which is given, in balance with the sleeve; locked, the
bolt and the sleeve share a load until the joint opens, and then the bolt has all of it. With each
enforcement, from a shortening instead of a force, after a restart, with two bolts in one joint."""
# ctest: goldens = bolted_pretension, bolted_pretension.mpirun=2

import shutil

from touchstone_test import (AUGMENTED, CG, MULTIPLIERS, below, check, finish, folder, golden,
                             launch, relative, run, same, tests)

scene = tests / "bolted_pretension.prm"
joint = golden("bolted_pretension")
same(joint, golden("bolted_pretension", 2), 1e-7)
loads = [0, 0, 40, 80, 120]


def balance(result, bound=1e-7):
    """The bolt has what the sleeve gives and the load."""
    tension, sleeve = result.column("cut: tension"), result.column("joint: force z")
    check(len(tension) == 5, f"{result}: {len(tension)} steps")
    for pull, clamp, load in zip(tension, sleeve, loads):
        below(f"{result}: balance at load {load}", abs(pull + clamp - load) / 50, bound)
    return tension, sleeve


pull, clamp = balance(joint)
below("half of the tension", relative(pull[0], 25), 1e-7)
below("tension", relative(pull[1], 50), 1e-7)
columns = (joint.folder / "statistics.csv").read_text(encoding="utf-8").split("\n", 1)[0].split(",")
check({"cut.tension[force]", "cut.shortening[length]"} <= set(columns), f"units of {columns}")
# Locked: the length stays, the tension grows by a part of the load, and by all of it in the end.
length = joint.column("cut: shortening")
for later in length[2:]:
    check(later == length[1], f"the cut is not locked: {later} and {length[1]}")
check(50 < pull[2] < 50 + 40 and clamp[2] < 0, f"the joint at 40: {pull[2]}, {clamp[2]}")
below("the open joint carries nothing", abs(clamp[4]), 1e-9)
below("the bolt carries all", relative(pull[4], 120), 1e-7)
# Without the lock the tension stays, and more than that opens the joint.
same(run("locked by length", scene, {"Contact pair cut/Pretension force": "",
                                     "Contact pair cut/Pretension shortening":
                                     f"{length[1]!r}*min(t, 1)"}), joint, 1e-5)
for name, settings in (("multipliers", MULTIPLIERS), ("augmented", AUGMENTED), ("cg", CG)):
    balance(run(name, scene, settings), 1e-6)

# The sides of a cut that is shortened by two fifths of a cell lie in each other: no overlap.
drawn = run("drawn together", scene, {"Contact pair cut/Pretension force": "",
                                      "Contact pair cut/Pretension shortening": "0.2*min(t, 1)"})
check("reaches into" not in drawn.log, "the sides of a cut count as an overlap")

# From a checkpoint of the locked joint.
run("resumed", scene, {"Checkpoints/Steps between": 3})
shutil.rmtree("resumed/checkpoint_000002")
done = launch("--results-only", "--resume", "--output", "resumed",
              "--set", "Checkpoints/Steps between=3", "--set", "Output/VTU interval=0", scene)
check(done.returncode == 0, f"resumed: {done.stdout}")
check(open("resumed/statistics", encoding="utf-8").read() ==
      (run("again", scene).folder / "statistics").read_text(encoding="utf-8"),
      "resumed: other statistics")

# A second bolt behind the sleeve, tightened to another tension: each has its own.
text = scene.read_text(encoding="utf-8")
parts = {}
for name, end in (("Body lower", "subsection Body upper"), ("Body upper", "subsection Body plate"),
                  ("Contact pair cut", "subsection Contact pair head"),
                  ("Contact pair head", "subsection Contact pair joint")):
    part = text[text.index(f"subsection {name}"):text.index(end)]
    for old, new in (("lower", "lower 2"), ("upper", "upper 2"), ("pair cut", "pair cut 2"),
                     ("pair head", "pair head 2")):
        part = part.replace(f"Body {old}\n", f"Body {new}\n").replace(f" = {old}\n", f" = {new}\n")
        part = part.replace(f"Contact {old}\n", f"Contact {new}\n")
    parts[name] = part
moved = {"Body lower": ("set Type         = box\n    set Upper corner = 1, 1, 1",
                        "set Type         = box\n    set Lower corner = 3.5, 0, 0\n"
                        "    set Upper corner = 4.5, 1, 1"),
         "Body upper": ("0, 0, 1\n    set Upper corner = 1, 1, 2",
                        "3.5, 0, 1\n    set Upper corner = 4.5, 1, 2")}
for name, (old, new) in moved.items():
    check(old in parts[name], f"{name}: other corners")
    parts[name] = parts[name].replace(old, new)
parts["Contact pair cut"] = parts["Contact pair cut"].replace("50*min(t, 1)", "20*min(t, 1)")
text = text.replace("lower, upper, plate, sleeve", "lower, upper, plate, sleeve, lower 2, upper 2")
text = text.replace("cut, head, joint", "cut, head, joint, cut 2, head 2")
text = text.replace("3, 1, 3\n    set Cells        = 6, 2, 2", "4.5, 1, 3\n    set Cells        = 9, 2, 2")
(folder / "two.prm").write_text(text + "".join(parts.values()), encoding="utf-8")
two = run("two", folder / "two.prm")
for pair, wanted in (("cut", 50), ("cut 2", 20)):
    for time, pull in zip(two.column("time"), two.column(f"{pair}: tension")):
        if time <= 1:
            below(f"tension of {pair} at {time}", relative(pull, time * wanted), 1e-7)
for row in two.rows():
    load = 40 * max(0, row["time"] - 1)
    below(f"two bolts and a sleeve at load {load}",
          abs(row["cut: tension"] + row["cut 2: tension"] + row["joint: force z"] - load) / 70, 1e-7)
finish()

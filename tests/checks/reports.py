# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a user must be told about hard input."""
# ctest: goldens = tresca_at_supports, large_overlap, press_fit, held_by_contact
# ctest: goldens = gap_closed
# ctest: label = quick

from touchstone_test import check, checks, finish, golden, run

for scene, text in (
        ("tresca_at_supports", "3 contact row(s) dropped"),
        ("large_overlap", "an initial overlap larger than a face, taken as interference"),
        ("press_fit", "an initial overlap, taken as interference"),
        ("held_by_contact", "held by contact alone, stabilised: body 'block' can move in x or move "
                            "in y or turn about z"),
        ("gap_closed", "smallest gap 0.005")):
    golden(scene).says(text)
# Without contact nobody is advised to change it.
turned = run("turned", checks / "turned_on_springs.prm", fails=True)
turned.says("has turned by 26.2 degrees")
check("contact" not in turned.log.split("The last converged state", 1)[-1],
      "turned: advice on contact in a scene without")
finish()

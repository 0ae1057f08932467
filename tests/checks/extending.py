# SPDX-License-Identifier: LGPL-2.1-or-later
"""The table of doc/extending.md names every sample of contrib/skeletons with its number of lines, and
no other file; and every sample is compiled and run by a test."""
# ctest: label = quick

import re

from touchstone_test import check, finish, source, tests

page = (source / "doc/extending.md").read_text(encoding="utf-8")
samples = source / "contrib/skeletons"
files = [*samples.glob("*.cc"), samples / "outside/main.cc"]

# Without the license line and the empty one below it.
there = {str(file.relative_to(samples)): len(re.sub(
    r"\A// SPDX[^\n]*\n\n?", "", file.read_text(encoding="utf-8")).splitlines()) for file in files}
named = {name: int(lines) for name, lines in
         re.findall(r"^\| [^|]* \| `([a-z_/]*\.cc)` \| (\d*) \|.*\| 0 \|$", page, re.M)}
for name in sorted(there.keys() | named.keys()):
    check(there.get(name) == named.get(name), f"{name}: {named.get(name)} lines in "
          f"doc/extending.md, {there.get(name)} in contrib/skeletons")
check(len(there) > 3, "hardly any samples")

units = "".join(file.read_text(encoding="utf-8") for file in tests.glob("extending_*.cc"))
for file in samples.glob("*.cc"):
    check(f"skeletons/{file.name}" in units, f"no test compiles contrib/skeletons/{file.name}")
for name in set(re.findall(r"`([a-z_]*\.prm)`", page)):
    check((samples / name).is_file() or (source / "doc" / name).is_file(),
          f"doc/extending.md names {name}")
finish()

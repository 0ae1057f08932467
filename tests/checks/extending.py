"""Each sample of doc/extending.md is, line for line, the file of contrib/skeletons that the page
names before it, and no file is missing. The unit tests extending_* compile and run them."""
# ctest: label = quick

import difflib
import re

from touchstone_test import check, finish, source

samples, name, inside, lines = {}, None, False, []
for line in (source / "doc/extending.md").read_text(encoding="utf-8").splitlines():
    if line.startswith("```"):
        if inside and name:
            samples[name] = lines
        inside, lines = not inside, []
    elif inside:
        lines.append(line)
    elif line.strip():
        # A sample is the code after a line that ends with the name of its file.
        found = re.search(r"contrib/skeletons/([a-z_]+\.[a-z]+)`:$", line)
        name = found[1] if found else None

files = {path.name: path for path in (source / "contrib/skeletons").iterdir()}
for name, path in sorted(files.items()):
    check(name in samples, f"doc/extending.md does not show contrib/skeletons/{name}")
    difference = list(difflib.unified_diff(
        path.read_text(encoding="utf-8").splitlines(), samples.get(name, []),
        f"contrib/skeletons/{name}", "doc/extending.md", lineterm=""))
    check(not difference, "\n".join(difference))
for name in samples:
    check(name in files, f"doc/extending.md names {name}, which does not exist")
check(len(files) > 3, "hardly any samples")
finish()

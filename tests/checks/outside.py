# SPDX-License-Identifier: LGPL-2.1-or-later
"""The program of contrib/skeletons/outside, which has a main() of its own, is configured and built
with the installed library and run; and is configured and compiled with the sources by
add_subdirectory(). There the library would be compiled anew, several minutes: that is left out unless
TOUCHSTONE_OUTSIDE=full."""

import os
import re
import shutil
import subprocess

from touchstone_test import check, fail, finish, folder, prm, processors, program, source

sample = source / "contrib/skeletons/outside"


def step(what, *command):
    """Output of a command that must succeed; without it nothing else makes sense."""
    with processors():
        result = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True, check=False)
    if result.returncode != 0:
        fail(f"{what}: {' '.join(map(str, command))}\n{result.stdout[-3000:]}")
        finish()
    return result.stdout


for name in ("prefix", "installed", "subdirectory"):
    shutil.rmtree(name, ignore_errors=True)
step("install", "cmake", "--install", program.parent, "--prefix", folder / "prefix")
step("configure", "cmake", "-S", sample, "-B", "installed",
     f"-DCMAKE_PREFIX_PATH={folder / 'prefix'}", "-DCMAKE_BUILD_TYPE=Release")
step("build", "cmake", "--build", "installed")
output = step("run", "installed/outside", prm / "patch_test.prm")
check(re.search(r"^step 1, t = 1: largest displacement 0\.[0-9]*, largest pressure [0-9.]*$", output,
                re.M), f"unexpected output: {output}")
with open("bad.prm", "w", encoding="utf-8") as scene:
    scene.write("nonsense\n")
check(subprocess.run(["installed/outside", "bad.prm"], capture_output=True, check=False).returncode != 0,
      "a bad scene has exit code 0")

step("configure with the sources", "cmake", "-G", "Unix Makefiles", "-S", sample, "-B", "subdirectory",
     "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-fsyntax-only",
     f"-DTOUCHSTONE_SOURCE_DIR={source}", "-DTOUCHSTONE_UNITY=ON")
with open("subdirectory/CMakeCache.txt", encoding="utf-8") as cache:
    check("TOUCHSTONE_TESTS:BOOL=OFF" in cache.read(),
          "the tests are configured though the project is not at the top")
if os.environ.get("TOUCHSTONE_OUTSIDE") == "full":
    step("build with the sources", "cmake", "--build", "subdirectory", "-j2", "--target", "outside")
    check(step("run", "subdirectory/outside", prm / "patch_test.prm") == output,
          "another result with add_subdirectory")
else:
    # The sample alone, and no code: headers, flags and definitions must come with the target.
    step("compile with the sources", "cmake", "--build", "subdirectory", "--target", "main.cc.o")
finish()

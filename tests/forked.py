# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run the program on one rank without linking it anew.

Before the first line of main() the dynamic linker resolves 350,000 symbols of the 200 libraries behind deal.II
and Trilinos: a quarter of a second, most of a small run, and checks make some thousand. So a check loads the
code of the program once, as a library that is built beside it, and forks for each run.
"""

import ctypes
import functools
import os
import subprocess
import tempfile
import time


@functools.lru_cache(maxsize=None)
def _library(program):
    """The program as a library; None if there is none, or an older one than the program."""
    path = program.parent / "libtouchstone_main.so"
    present = path.is_file() and path.stat().st_mtime >= program.stat().st_mtime
    return ctypes.CDLL(str(path)) if present else None


def run(program, arguments, timeout=None):
    """subprocess.CompletedProcess of PROGRAM ARGUMENTS..., with all that it says in stdout."""
    words = [str(program), *map(str, arguments)]
    library = _library(program)
    if library is None:
        return subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              check=False, timeout=timeout)
    with tempfile.TemporaryFile(mode="w+", encoding="utf-8") as said:
        child = os.fork()
        if child == 0:
            os.dup2(said.fileno(), 1)
            os.dup2(said.fileno(), 2)
            argv = (ctypes.c_char_p * (len(words) + 1))(*map(os.fsencode, words), None)
            # exit() empties the buffers of C++; Python's own end is not for a copy of the process.
            ctypes.CDLL(None).exit(library.main(len(words), argv))
        code = _wait(child, timeout, words)
        said.seek(0)
        return subprocess.CompletedProcess(words, code, said.read())


def _wait(child, timeout, words):
    """Exit code of the process, which is killed if it takes longer than that."""
    if timeout is None:
        return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    end = time.monotonic() + timeout
    while True:
        done, status = os.waitpid(child, os.WNOHANG)
        if done:
            return os.waitstatus_to_exitcode(status)
        if time.monotonic() > end:
            os.kill(child, 9)
            os.waitpid(child, 0)
            raise subprocess.TimeoutExpired(words, timeout)
        time.sleep(0.02)

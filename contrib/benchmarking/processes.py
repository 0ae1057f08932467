# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run a program and say what it used."""

import dataclasses
import os
import signal
import subprocess
import threading
import time


@dataclasses.dataclass
class Usage:
    """Of a program and of all that it started and waited for."""
    exit_code: int
    timed_out: bool
    user_seconds: float
    system_seconds: float
    wall_seconds: float
    # Of the largest process, MB of 10^6 bytes.
    memory_mb: float

    def failure(self):
        """Why the run counts as failed, or nothing."""
        if self.timed_out:
            return f"time limit, after {self.wall_seconds:.0f} s"
        if self.exit_code < 0:
            return f"killed by {signal.Signals(-self.exit_code).name}"
        return f"exit code {self.exit_code}" if self.exit_code else ""


def run(command, folder, log, time_limit):
    """Run @p command in @p folder with one thread per rank; output goes to the file @p log.

    After @p time_limit seconds of wall clock it is stopped with all its children.
    """
    environment = dict(os.environ, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1",
                       OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                       OMPI_MCA_rmaps_base_oversubscribe="1", TOUCHSTONE_OPTIONS="")
    started = time.monotonic()
    timed_out = threading.Event()
    with open(log, "wb") as output:
        # A session of its own, so that mpirun's ranks can be stopped with it.
        try:
            process = subprocess.Popen(command, cwd=folder, env=environment, stdout=output,
                                       stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                                       start_new_session=True)
        except OSError as error:
            output.write(f"{error}\n".encode())
            return Usage(127, False, 0.0, 0.0, 0.0, 0.0)  # as a shell would say

        def stop():
            timed_out.set()
            try:
                os.killpg(process.pid, signal.SIGTERM)
            except ProcessLookupError:
                timed_out.clear()  # it has just ended by itself

        watch = threading.Timer(time_limit, stop)
        watch.start()
        try:
            # Popen.wait() would not tell what this one process used.
            _, status, used = os.wait4(process.pid, 0)
        except BaseException:
            os.killpg(process.pid, signal.SIGTERM)
            raise
        finally:
            watch.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
    return Usage(process.returncode, timed_out.is_set(), used.ru_utime, used.ru_stime,
                 time.monotonic() - started, used.ru_maxrss * 1024 / 1e6)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""forked.py PROGRAM ARGUMENTS...: run the program, or a rank of it, without linking it anew.

Before the first line of main() the dynamic linker resolves 350,000 symbols of the 200 libraries behind deal.II
and Trilinos: most of the time of a small run, and the tests make some thousand. So one process, the server,
loads the code of the program as a library that is built beside it, and forks for each run. The first test
that needs it starts it, and it ends when nobody has needed it for IDLE seconds. The run has the arguments,
environment, folder and files 0 to 2 of who asks for it. Who asks has its exit code or its signal; if who
asks is killed, so is the run: mpirun can start forked.py instead of the program.
"""

import contextlib
import hashlib
import marshal
import os
import socket
import struct
import sys
import time

IDLE = 60
# Environment variables that libraries read when they are loaded: each setting has a server of its own.
AT_LOAD = "GLIBC_TUNABLES", "OMP_", "OPENBLAS_"


def run(program, arguments, timeout=None):
    """subprocess.CompletedProcess of PROGRAM ARGUMENTS..., with all that it says in stdout."""
    import subprocess  # pylint: disable=import-outside-toplevel
    import tempfile  # pylint: disable=import-outside-toplevel
    words = [str(program), *map(str, arguments)]
    server = _server(words[0])
    if server is None:
        return subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              check=False, timeout=timeout)
    with tempfile.TemporaryFile(mode="w+", encoding="utf-8") as said, server:
        try:
            code = _exit_code(server, words, (0, said.fileno(), said.fileno()), timeout)
        except socket.timeout as error:
            raise subprocess.TimeoutExpired(words, timeout) from error
        said.seek(0)
        return subprocess.CompletedProcess(words, code, said.read())


def _exit_code(server, words, files, timeout=None):
    """Ask for a run and wait for its end."""
    request = marshal.dumps((words, os.getcwd(), dict(os.environ)))
    socket.send_fds(server, [struct.pack("=i", len(request)) + request], files)
    server.settimeout(timeout)
    answer = server.recv(4)
    if len(answer) < 4:
        raise RuntimeError("the server of forked.py has ended")
    return os.waitstatus_to_exitcode(*struct.unpack("=i", answer))


def _server(program):
    """A connection to the server of the program; None if there is no library, or an older one than the
    program, if a library is to come before those of the program, or on systems that cannot tell when a
    process has ended (Linux before 5.3, or Python before 3.9)."""
    library, core = (os.path.join(os.path.dirname(program), f"libtouchstone_{name}.so") for name in ("main", "core"))
    if "LD_PRELOAD" in os.environ or not os.path.isfile(library):
        return None
    try:
        os.close(os.pidfd_open(os.getpid()))
    except (AttributeError, OSError):
        return None
    built = [os.stat(path).st_mtime_ns for path in (library, program, core)]
    if built[0] < built[1]:
        return None
    settings = sorted(entry for entry in os.environ.items() if entry[0].startswith(AT_LOAD))
    key = hashlib.sha1(repr((library, built, settings)).encode()).hexdigest()
    name = f"\0touchstone-tests-{os.getuid()}-{key}"  # no file: a name that ends with its process
    with contextlib.suppress(ConnectionError):
        return _connected(name)
    # Of several that are started at the same time one has the name, and the others end.
    import subprocess  # pylint: disable=import-outside-toplevel
    subprocess.run(["setsid", "--fork", sys.executable, "-IS", __file__, "--serve", name[1:], library],
                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                   cwd="/", check=True)
    end = time.monotonic() + 120
    while time.monotonic() < end:
        with contextlib.suppress(ConnectionError):
            return _connected(name)
        time.sleep(0.01)
    return None


def _connected(name):
    """A connection to the server with this name, which must be of this user."""
    server = socket.socket(socket.AF_UNIX)
    try:
        server.connect(name)
        if _user(server) != os.getuid():
            raise PermissionError("another user has the name of the server of forked.py")
        if server.recv(1) != b"+":  # it was about to end
            raise ConnectionRefusedError
        return server
    except OSError:
        server.close()
        raise


def _user(connection):
    """Who is at the other end."""
    return struct.unpack("=iii", connection.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, 12))[1]


def _serve(name, path):
    """Load the library, and fork for who connects, until nobody has for IDLE seconds."""
    import ctypes  # pylint: disable=import-outside-toplevel
    import selectors  # pylint: disable=import-outside-toplevel
    listener = socket.socket(socket.AF_UNIX)
    try:
        listener.bind("\0" + name)
    except OSError:
        return
    listener.listen(256)
    library = ctypes.CDLL(path)
    events = selectors.DefaultSelector()
    events.register(listener, selectors.EVENT_READ)
    while found := events.select(None if len(events.get_map()) > 1 else IDLE):
        for key, _ in found:
            if key.fileobj is listener:
                client = listener.accept()[0]
                child = _forked(library, client, events) if _user(client) == os.getuid() else None
                if child is None:
                    client.close()
                    continue
                ended = os.pidfd_open(child)
                events.register(ended, selectors.EVENT_READ, (child, ended, client))
                events.register(client, selectors.EVENT_READ, (child, ended, client))
                continue
            child, ended, client = key.data
            if key.fileobj is client:  # which has nothing more to say: it is gone
                if client.fileno() < 0:  # and so is its run, which has ended in the same moment
                    continue
                with contextlib.suppress(ProcessLookupError):
                    os.kill(child, 9)
                events.unregister(client)
                continue
            with contextlib.suppress(OSError):
                client.sendall(struct.pack("=i", os.waitpid(child, 0)[1]))
            with contextlib.suppress(KeyError):
                events.unregister(client)
            events.unregister(ended)
            os.close(ended)
            client.close()


def _forked(library, client, events):
    """A process that runs what the client asks for; None if it ends without a request."""
    size, request, files = 4, b"", []
    with contextlib.suppress(ConnectionError):
        client.sendall(b"+")
        while len(request) < size:
            part, more, _, _ = socket.recv_fds(client, 65536, 3)
            if not part:
                break
            request += part
            files.extend(more)
            if size == 4 and len(request) >= 4:
                size = 4 + struct.unpack("=i", request[:4])[0]
    if len(request) < size:
        return None
    child = os.fork()
    if child:
        for file in files:
            os.close(file)
        return child
    try:
        _become(library, marshal.loads(request[4:]), files, events)
    finally:
        os._exit(126)


def _become(library, request, files, events):
    """Run the program in this process and end it."""
    import ctypes  # pylint: disable=import-outside-toplevel
    for target, file in enumerate(files):
        os.dup2(file, target)
        os.close(file)
    for key in list(events.get_map().values()):
        os.close(key.fd)
    events.close()
    words, path, environment = request
    os.chdir(path)
    os.environ.clear()
    os.environ.update(environment)
    argv = (ctypes.c_char_p * (len(words) + 1))(*map(os.fsencode, words), None)
    # exit() empties the buffers of C++; Python's own end is not for a copy of the process.
    ctypes.CDLL(None).exit(library.main(len(words), argv))


def _main():
    if sys.argv[1] == "--serve":
        _serve(*sys.argv[2:])
        return 0
    words = sys.argv[1:]
    server = _server(words[0])
    if server is None:
        os.execv(words[0], words)
    code = _exit_code(server, words, (0, 1, 2))
    if code < 0:
        os.kill(os.getpid(), -code)
    return code


if __name__ == "__main__":
    sys.exit(_main())

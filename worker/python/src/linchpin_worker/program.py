"""The command line of a worker."""

from __future__ import annotations

import argparse
import logging
import os
import queue
import signal
import stat
import sys
import threading
from collections.abc import Callable, Sequence

from .address import Address, ListenError
from .host import Host, Limits
from .server import Server
from .subsystem import Subsystem

LARGEST_MESSAGE = 1024
"""MiB that may be asked for, as of the program `linchpin`."""

EPILOG = """examples:
  python worker.py --listen 127.0.0.1:50051
  python worker.py --listen unix:/run/linchpin/mass1.sock
  python worker.py --listen 0.0.0.0:50051 --certificates certificates/workers/mass1

In a scene: command = ["python", "worker.py"]; the run appends --listen with an address of its own."""


def serve(*models: type[Subsystem], arguments: Sequence[str] | None = None) -> None:
    """Serves models as the program that Python was started with, until SIGTERM, Ctrl-C or the end of its input.

    `arguments` are those of the command line. The process ends with status 2 if they are wrong or if the worker cannot
    listen; wrong models raise `DescriptionError`.
    """
    limits = Limits()
    given = parser(limits).parse_args(arguments)
    logging.basicConfig(level=logging.INFO, format="%(levelname)s %(message)s", stream=sys.stderr)
    limits = Limits(instances=given.max_instances, lease=given.lease, message=given.max_message << 20)
    host = Host(*models, limits=limits)
    # A signal may arrive at any place of this thread, also while it begins to wait: the lock of an event could be its own.
    ends: queue.SimpleQueue[None] = queue.SimpleQueue()
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, lambda *_: ends.put(None))
    try:
        server = Server(host, given.listen, plain_text=given.plain_text, certificates=given.certificates, token=given.token)
    except ListenError as error:
        sys.exit(f"error: {error}")
    with server:
        if given.exit_with_stdin or (server.address.path and input_is_pipe()):
            threading.Thread(target=watch_input, args=(lambda: ends.put(None),), daemon=True).start()
        announce(server.url)
        ends.get()
    if any(thread.name.startswith("linchpin-worker_") for thread in threading.enumerate()):
        # A solver that is still computing would keep the interpreter from ending.
        sys.stderr.flush()
        os._exit(0)


def parser(limits: Limits) -> argparse.ArgumentParser:
    """The arguments of a worker."""
    own = argparse.ArgumentParser(epilog=EPILOG, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = own.add_argument
    where = "where to listen: IP:PORT (port 0: the system chooses) or unix:/PATH (default 127.0.0.1:0)"
    add("--listen", metavar="ADDRESS", type=readable(Address.of), default="127.0.0.1:0", help=where)
    folder = "folder with ca.crt, tls.crt and tls.key: only masters with a certificate are served, by TLS"
    reach = "permit an address that other machines can reach without certificates; nothing is encrypted, and anyone is served"
    either = own.add_mutually_exclusive_group()
    either.add_argument("--certificates", metavar="FOLDER", help=folder)
    either.add_argument("--plain-text", action="store_true", help=reach)
    secret = "file with a secret that masters must show, for an address that other users of this machine can reach"
    add("--token", metavar="FILE", help=f"{secret}; only its user may read it")
    most = f"most instances at a time (default {limits.instances})"
    add("--max-instances", metavar="N", type=readable(positive), default=limits.instances, help=most)
    largest = (
        f"largest message in MiB (default {limits.message >> 20}); exchanges have less by far, exported states may have more"
    )
    add("--max-message", metavar="MIB", type=readable(mebibytes), default=limits.message >> 20, help=largest)
    lease = f"time in s that an instance waits for another call when what held it has ended (default {limits.lease:g})"
    add("--lease", metavar="S", type=readable(seconds), default=limits.lease, help=lease)
    ends = "end when the standard input is closed; implied on a Unix socket if the input is a pipe, as from a master"
    add("--exit-with-stdin", action="store_true", help=ends)
    return own


def readable(read: Callable[[str], object]) -> Callable[[str], object]:
    """`read` with its errors as those of the command line."""

    def checked(text: str) -> object:
        try:
            return read(text)
        except ValueError as error:
            raise argparse.ArgumentTypeError(str(error)) from error

    return checked


def positive(text: str) -> int:
    """A number of instances."""
    if not text.isdecimal() or int(text) < 1:
        raise ValueError(f'"{text}" must be a whole number of at least 1')
    return int(text)


def mebibytes(text: str) -> int:
    """The size of a message."""
    if not text.isdecimal() or not 1 <= int(text) <= LARGEST_MESSAGE:
        raise ValueError(f'"{text}" must be a whole number of MiB from 1 to {LARGEST_MESSAGE}')
    return int(text)


def seconds(text: str) -> float:
    """The length of a lease."""
    if not 0.0 <= float(text) <= 1e6:
        raise ValueError(f'"{text}" must be a number of seconds from 0 to 1e6')
    return float(text)


def input_is_pipe() -> bool:
    """Whether the standard input is a pipe; there may be none."""
    return sys.stdin is not None and stat.S_ISFIFO(os.fstat(sys.stdin.fileno()).st_mode)


def watch_input(closed: Callable[[], None]) -> None:
    """Reads the standard input to its end, as of a master that started this worker and wants it to end."""
    while sys.stdin is not None and os.read(sys.stdin.fileno(), 64):
        pass
    closed()


def announce(address: str) -> None:
    """Says where the worker listens. Whoever started it may have closed its output; that is no reason to stop."""
    try:
        print(f"listening on {address}", flush=True)
    except BrokenPipeError:
        logging.getLogger("linchpin_worker").info("the standard output is closed")

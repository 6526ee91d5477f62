"""What keeps instances alive: exchange streams, and the connections of calls."""

from __future__ import annotations

import pathlib
from collections.abc import Callable
from dataclasses import dataclass, field
from time import monotonic

ESTABLISHED = "01"
"""State of a TCP connection in the tables of Linux; of those that end there are others."""
UNIX_CONNECTED = "03"
"""Likewise for Unix sockets."""


@dataclass(eq=False)
class Hold:
    """A stream or a connection. `is_open` is asked until it says no; a stream is ended by `end`."""

    is_stream: bool
    peer: str = ""
    is_open: Callable[[], bool] = lambda: True
    _ended: float | None = field(default=None, init=False)

    def end(self) -> None:
        """Says that it has ended."""
        if self._ended is None:
            self._ended = monotonic()

    def ended(self) -> float | None:
        """When it was found to have ended, as `time.monotonic()`; None while it is open."""
        if self._ended is None and not self.is_open():
            self.end()
        return self._ended


def connection(peer: str, own_socket: str) -> Hold:
    """The connection over which `peer` calls, as gRPC names it; `own_socket` is the path of the worker's Unix socket.

    gRPC for Python does not tell when a connection ends, so the tables of the system are asked. Connections over a Unix
    socket cannot be told apart: any open one counts. Where there are no such tables, connections count as open.
    """
    if peer.startswith("unix:"):
        return Hold(False, peer, lambda: unix_is_open(own_socket))
    return Hold(False, peer, lambda: tcp_is_open(peer))


def unix_is_open(path: str) -> bool:
    """Whether anybody is connected to the socket at `path`."""
    table = pathlib.Path("/proc/net/unix")
    if not table.is_file():
        return True
    rows = (line.split() for line in table.read_text().splitlines())
    return any(len(row) > 7 and row[5] == UNIX_CONNECTED and row[7] == path for row in rows)


def tcp_is_open(peer: str) -> bool:
    """Whether there is a connection to `peer`, such as "ipv4:127.0.0.1:40000" or "ipv6:%5B::1%5D:40000"."""
    version, _, address = peer.partition(":")
    table = pathlib.Path("/proc/net/tcp" if version == "ipv4" else "/proc/net/tcp6")
    tables = [table, pathlib.Path("/proc/net/tcp6")]
    if not table.is_file():
        return True
    port = f"{int(address.rpartition(':')[2]):04X}"
    rows = (line.split() for own in tables if own.is_file() for line in own.read_text().splitlines()[1:])
    return any(row[3] == ESTABLISHED and row[2].endswith(f":{port}") for row in rows)

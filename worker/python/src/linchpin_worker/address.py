"""Where a worker listens."""

from __future__ import annotations

import errno
import ipaddress
import os
import pathlib
import socket
import stat
from dataclasses import dataclass

LONGEST_PATH = 107
"""Longest path of a Unix socket in bytes."""


class ListenError(Exception):
    """A worker cannot listen; the text says where and what to do."""


@dataclass(frozen=True)
class Address:
    """`IP:PORT`, where port 0 lets the system choose, or `unix:/PATH`. `host` is empty for a Unix socket."""

    host: str
    port: int
    path: str

    @classmethod
    def of(cls, text: str) -> Address:
        """Reads an address; `ValueError` if it is none."""
        if text.startswith("unix:/"):
            return cls("", 0, text.removeprefix("unix:"))
        host, _, port = text.rpartition(":")
        try:
            ip = ipaddress.ip_address(host.removeprefix("[").removesuffix("]"))
            if (ip.version == 6) == host.startswith("[") and port.isdecimal() and int(port) < 1 << 16:
                return cls(host, int(port), "")
        except ValueError:
            pass
        raise ValueError(f'"{text}" is no address to listen on; write IP:PORT (as 127.0.0.1:50051) or unix:/PATH')

    @property
    def is_local(self) -> bool:
        """Whether only this machine can reach it."""
        return not self.host or ipaddress.ip_address(self.host.strip("[]")).is_loopback

    def __str__(self) -> str:
        """As a master writes it in a scene."""
        return f"http://{self.host}:{self.port}" if self.host else f"unix:{self.path}"

    def target(self) -> str:
        """As gRPC takes it."""
        return f"{self.host}:{self.port}" if self.host else f"unix:{self.path}"

    def check(self, plain_text: bool, is_tls: bool = False) -> None:
        """Refuses an address that this worker must not or cannot listen on, and clears the socket of one that is gone."""
        if not (self.is_local or plain_text or is_tls):
            reach = f"{self} can be reached from other machines, which plain text is not for"
            ways = "give --certificates FOLDER (linchpin certificates makes it), listen on 127.0.0.1"
            raise ListenError(f"{reach}: {ways}, or permit it with --plain-text where the network keeps strangers away")
        if is_tls and not self.host:
            reason = "who may connect is decided by the permissions of the socket and its folder"
            raise ListenError(f"{self} takes no certificates: {reason}; leave --certificates away, or listen on IP:PORT")
        if self.host:
            _check_port(self)
        else:
            _check_path(self.path)


def _check_port(address: Address) -> None:
    family = socket.AF_INET6 if address.host.startswith("[") else socket.AF_INET
    with socket.socket(family) as probe:
        # As servers do: a port whose last connections are only just closed is free.
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((address.host.strip("[]"), address.port))
        except OSError as error:
            if error.errno == errno.EADDRINUSE:
                text = f"{address} is in use; choose another port, or port 0 to let the system choose"
                raise ListenError(text) from error
            raise ListenError(f"cannot listen on {address}: {error.strerror}") from error


def _check_path(path: str) -> None:
    file = pathlib.Path(path)
    if len(os.fsencode(path)) > LONGEST_PATH:
        limit = f"{path} has more than {LONGEST_PATH} bytes, the most for a socket"
        raise ListenError(f"{limit}; choose a shorter path")
    if not file.parent.is_dir():
        raise ListenError(f"there is no folder {file.parent}; make the folder, or choose another path")
    if not os.path.lexists(path):
        return
    if not stat.S_ISSOCK(file.lstat().st_mode):
        raise ListenError(f"{path} is no socket, and it is not overwritten; choose another path")
    with socket.socket(socket.AF_UNIX) as probe:
        try:
            probe.connect(path)
        except ConnectionRefusedError:
            file.unlink()
            return
        raise ListenError(f"unix:{path} is in use; choose another path")

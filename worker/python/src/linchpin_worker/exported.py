"""States that leave their process: whole, of the right model, and of a writer that can be read."""

from __future__ import annotations

import zlib

from ._contract import worker_pb2 as pb
from .failures import misuse
from .version import PROGRAM, own_version

FIELD = "state"


def writer() -> str:
    """Program and version that write a state here."""
    return f"{PROGRAM} {own_version()}"


def sealed(model: str, state: bytes) -> pb.ExportedState:
    """A state of `model` as it is sent."""
    return pb.ExportedState(model=model, writer=writer(), state=state, checksum=zlib.crc32(state))


def opened(model: str, request: pb.ImportStateRequest) -> bytes:
    """The bytes of a state that has come, if it is whole and a state of `model` that was written by `writer()`."""
    if not request.HasField("state"):
        raise misuse(FIELD, "there is no state; send one of ExportState")
    came = request.state
    for what, expected, found in (("of model", model, came.model), ("written by", writer(), came.writer)):
        if expected != found:
            text = f'this state is {what} "{found}", it must be {what} "{expected}"'
            raise misuse(FIELD, f"{text}: export it from such an instance")
    checksum = zlib.crc32(came.state)
    if checksum != came.checksum:
        text = f"this state of {len(came.state)} bytes is damaged: its checksum is {checksum:#010x}"
        raise misuse(FIELD, f"{text} instead of {came.checksum:#010x}; use another copy of it")
    return came.state

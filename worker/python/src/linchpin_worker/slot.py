"""The place of one instance: who may call it, and how long it waits for that."""

from __future__ import annotations

import threading
from collections.abc import Callable
from time import monotonic
from typing import TypeVar

from . import cancel
from ._contract import worker_pb2 as pb
from .failures import misuse
from .hold import Hold
from .instance import Instance

LEASES = 3
"""The first minor number whose masters know that an instance ends some time after what held it."""

Answer = TypeVar("Answer")


class Slot:
    """An instance with what decides about its end. Masters that know nothing of leases have none."""

    def __init__(self, request: pb.InitializeRequest, instance: Instance, lease: float, owner: bytes | None = None) -> None:
        self._request = request
        self._owner = owner
        self._instance = instance
        self._began = self._used = monotonic()
        self._lease = lease if request.protocol.minor >= LEASES else None
        self._calling = threading.Lock()
        self._holding = threading.Lock()
        self._holds: list[Hold] = []
        self._ended = threading.Event()

    def belongs_to(self, caller: bytes | None) -> bool:
        """Whether a caller may use it: the certificate that made it, or anyone where none was shown."""
        return self._owner is None or self._owner == caller

    def call(self, call: Callable[[Instance], Answer]) -> Answer:
        """Calls the instance, one call at a time."""
        with self._calling, cancel.within(self._ended.is_set):
            try:
                return call(self._instance)
            finally:
                self._used = monotonic()

    def end(self) -> None:
        """Cancels the call under way: the instance is no longer there."""
        self._ended.set()

    def initialized(self, request: pb.InitializeRequest) -> pb.InitializeReply:
        """The answer to Initialize, which may be repeated until the next call."""

        def told(instance: Instance) -> pb.InitializeReply:
            if not (instance.is_new and request == self._request):
                text = f"instance {request.instance:#x} exists already; choose another number"
                raise misuse("instance", text)
            return pb.InitializeReply(tolerance=instance.tolerance, lease=self._lease)

        return self.call(told)

    def hold(self, by: Hold) -> None:
        """Takes note of what holds the instance from now on: a stream alone, or all connections over which it is called."""
        with self._holding:
            if by.is_stream:
                self._holds = [by]
                return
            if any(own.is_stream and own.ended() is None for own in self._holds):
                return
            if not any(own.peer == by.peer and own.ended() is None for own in self._holds):
                self._holds = [own for own in self._holds if own.ended() is None] + [by]

    def is_idle(self, limit: float) -> bool:
        """Whether nothing has called it for so long. An instance that is computing is not idle."""
        return self._idle() >= limit

    def is_over(self) -> bool:
        """Whether its lease is over."""
        expires = self._expires()
        return expires is not None and expires <= 0.0

    def state(self) -> pb.InstanceState:
        """What is told of it."""
        with self._holding:
            is_held = any(hold.ended() is None for hold in self._holds)
        return pb.InstanceState(
            instance=self._request.instance,
            model=self._request.model,
            age=monotonic() - self._began,
            idle=self._idle(),
            held=is_held,
            expires=self._expires(),
        )

    def _idle(self) -> float:
        """s since its last call, 0 during one."""
        return 0.0 if self._calling.locked() else monotonic() - self._used

    def _expires(self) -> float | None:
        """s until the lease is over, which begins when all that held the instance has ended; None while it does not run."""
        if self._lease is None:
            return None
        with self._holding:
            ended = [hold.ended() for hold in self._holds]
        times = [time for time in ended if time is not None]
        if not times or len(times) < len(ended):
            return None
        return max(0.0, self._lease - min(self._idle(), monotonic() - max(times)))

"""Kept states of a solver."""

from __future__ import annotations

import pickle
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import count
from typing import Any

from .failures import fatal, misuse

IMMUTABLE = frozenset((float, int, bool, str, bytes, type(None)))


class State:
    """A state as `Subsystem.save` gave it, which nothing changes any more."""

    __slots__ = ("_is_pickled", "_kept")

    def __init__(self, saved: Any) -> None:
        is_plain = type(saved) in IMMUTABLE or (type(saved) is tuple and all(type(part) in IMMUTABLE for part in saved))
        self._is_pickled = not is_plain
        self._kept = saved if is_plain else pickle.dumps(saved, pickle.HIGHEST_PROTOCOL)

    def value(self) -> Any:
        """The state once more, of which the solver may do what it likes."""
        return pickle.loads(self._kept) if self._is_pickled else self._kept


@dataclass(frozen=True)
class Kept:
    """A state with its number: every state that a solver reaches has one, so it is known whether two steps begin alike."""

    number: int
    state: State


class Snapshots:
    """The states that a master asked to keep, by their numbers."""

    def __init__(self, most: int) -> None:
        self._kept: dict[int, Kept] = {}
        self._most = most
        self._numbers: Iterator[int] = count(1)

    def keep(self, state: Kept, replaces: int | None) -> int:
        """Keeps `state` in the place of an older one, if there is such, and returns its number."""
        if replaces is not None:
            self._kept.pop(replaces, None)
        if len(self._kept) >= self._most:
            limit = f"{len(self._kept)} snapshots are kept, which is the limit"
            raise fatal(f"{limit}; name one that can go in Snapshot.replaces")
        number = next(self._numbers)
        self._kept[number] = state
        return number

    def find(self, snapshot: int) -> Kept:
        """The state of a snapshot that is still kept."""
        if snapshot not in self._kept:
            kept = ", ".join(map(str, self._kept)) or "none"
            text = f"there is no snapshot {snapshot}; it was never taken or was replaced; kept: {kept}"
            raise misuse("snapshot", text)
        return self._kept[snapshot]

"""Ends of calls that nobody waits for any more."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

_calls = threading.local()


@contextmanager
def within(gone: Callable[[], bool]) -> Iterator[None]:
    """A call on this thread that is cancelled once `gone` says so."""
    before = asked()
    _calls.asked = (*before, gone)
    try:
        yield
    finally:
        _calls.asked = before


def is_cancelled() -> bool:
    """Whether the call under way on this thread is cancelled."""
    return any(gone() for gone in asked())


def asked() -> tuple[Callable[[], bool], ...]:
    """Who may cancel the call under way on this thread."""
    return getattr(_calls, "asked", ())

"""Calls of the program."""

from __future__ import annotations

import logging
import signal
import subprocess
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from .messages import Problem, read_messages, told

POLL = 0.1
"""Time between two looks at a run that is under way (s)."""

log = logging.getLogger("linchpin_cosim")


@dataclass(frozen=True)
class Outcome:
    """How a call ended."""

    exit_code: int
    problems: list[Problem]
    others: list[str]

    @property
    def message(self) -> str:
        """Its errors."""
        return told(self.problems, self.others)


def call(
    program: Path,
    arguments: Sequence[str],
    look: Callable[[], None] = lambda: None,
    stop: threading.Event | None = None,
) -> Outcome:
    """Calls the program and waits for its end; calls `look` from time to time.

    An exception, such as that of Ctrl-C, or `stop` ends the program in good order.
    """
    # In a session of its own it does not see a Ctrl-C of the terminal, which comes once, from here.
    process = subprocess.Popen(
        [program, *arguments],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        encoding="utf-8",
        errors="replace",
        start_new_session=True,
    )
    with process:
        try:
            while True:
                try:
                    _, said = process.communicate(timeout=POLL)
                    break
                except subprocess.TimeoutExpired:
                    look()
                    if stop is not None and stop.is_set():
                        process.send_signal(signal.SIGINT)
                        stop = None
        except BaseException:
            process.send_signal(signal.SIGINT)
            process.communicate()
            raise
    problems, others = read_messages(said)
    if process.returncode == 0:
        for line in others:
            log.warning("%s", line)
    return Outcome(process.returncode, problems, others)

"""How far a run is, read from the files that it writes."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

Progress: TypeAlias = bool | Callable[[float, float], None]
"""False: silent. True: a line on the error output. A function is called with the time reached and the end (s)."""

TAIL = 1 << 16
"""Bytes at the end of a table among which its last row is."""


class Watch:
    """Tells the progress of the run that writes to a folder."""

    def __init__(self, folder: Path, progress: Progress) -> None:
        self._folder = folder
        self._tell = _tell_line if progress is True else progress
        self._last: float | None = None

    def look(self) -> None:
        """Tells how far the run is, if that has changed."""
        if not callable(self._tell):
            return
        reached = _reached(self._folder)
        if reached is not None and reached[0] != self._last:
            self._last = reached[0]
            self._tell(*reached)

    def end(self) -> None:
        """Ends the line that was told."""
        self.look()
        if self._tell is _tell_line and self._last is not None:
            sys.stderr.write("\n")


def _tell_line(t: float, t_end: float) -> None:
    sys.stderr.write(f"\rt = {t:.6g} of {t_end:.6g} s")
    sys.stderr.flush()


def _reached(folder: Path) -> tuple[float, float] | None:
    """Time of the last row of the newest table in `folder`, and the end of its run."""
    tables = sorted(folder.rglob("results.csv"), key=lambda file: file.stat().st_mtime_ns)
    if not tables:
        return None
    with tables[-1].open("rb") as table:
        table.seek(max(0, table.seek(0, 2) - TAIL))
        whole, _, _ = table.read().rpartition(b"\n")
    try:
        t = float(whole.rpartition(b"\n")[2].partition(b",")[0])
        return t, float(json.loads(tables[-1].with_name("run.json").read_text(encoding="utf-8"))["t_end"])
    except (ValueError, OSError):
        # There is no row yet.
        return None

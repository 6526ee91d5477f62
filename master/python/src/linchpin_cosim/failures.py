"""What goes wrong, as exceptions and warnings."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .runs import Run


class LinchpinWarning(UserWarning):
    """A run came to its end, and its results are not to be trusted everywhere."""


class LinchpinError(Exception):
    """The program did not do what it was asked for. `exit_code` is that of the program."""

    def __init__(self, message: str, exit_code: int) -> None:
        super().__init__(message)
        self.exit_code = exit_code


class SceneError(LinchpinError):
    """The scene or a setting is wrong: nothing was run."""


class RunFailed(LinchpinError):
    """A run did not come to its end. `run` has what is kept of it; None if it ended before there was anything."""

    def __init__(self, message: str, exit_code: int, run: Run | None) -> None:
        super().__init__(message, exit_code)
        self.run = run


class ProgramNotFound(Exception):
    """There is no program `linchpin` where it was looked for."""

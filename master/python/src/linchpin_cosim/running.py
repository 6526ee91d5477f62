"""Runs of scenes."""

from __future__ import annotations

import os
import tempfile
import threading
import warnings
from collections.abc import Mapping
from pathlib import Path

from .call import call
from .failures import LinchpinWarning, RunFailed, SceneError
from .program import find_program
from .progress import Progress, Watch
from .runs import Run, read_run
from .settings import set_arguments

WRONG = 2
"""Exit code of the program where the scene or the command line is wrong."""


def run(
    scene: str | os.PathLike[str],
    *,
    set: Mapping[str, object] | None = None,
    out: str | os.PathLike[str] | None = None,
    in_process: bool = False,
    threads: bool = False,
    plots: bool = False,
    animate: bool = False,
    progress: Progress = False,
    program: str | os.PathLike[str] | None = None,
) -> Run:
    """Runs a scene file to its end and gives its results.

    `set` changes settings, as in `{"coupling.macro_step": 1e-3}`. The files are kept in the folder `out`, with pictures if
    `plots` and an animation if `animate` is True; without `out` they are removed. `in_process` runs built-in models in the
    master's process, with `threads` each on a thread of its own. `progress` is True for a line on the error output, or a
    function of the time reached and the end (s). `program` is the path of the program, see `find_program`.

    What the run warns of becomes a `LinchpinWarning`. Raises `SceneError` if the scene or a setting is wrong, `RunFailed`
    if the run does not come to its end.
    """
    if out is None and (plots or animate):
        raise ValueError("plots and animate write files; give the folder for them: out = ..")
    if threads and not in_process:
        raise ValueError("threads are those of built-in models in this process; give in_process = True as well")
    flags = {"--in-process": in_process, "--threads": threads, "--no-plots": not plots, "--animate": animate}
    arguments = [flag for flag, is_given in flags.items() if is_given] + set_arguments(set)
    done = finished_run(find_program(program), scene, arguments, out, progress)
    for text in done.warnings:
        warnings.warn(f"{done.scene}: {text}", LinchpinWarning, stacklevel=2)
    return done


def finished_run(
    program: Path,
    scene: str | os.PathLike[str],
    arguments: list[str],
    out: str | os.PathLike[str] | None = None,
    progress: Progress = False,
    stop: threading.Event | None = None,
) -> Run:
    """The run of a scene that came to its end; as `run`, without Python's warnings."""
    with tempfile.TemporaryDirectory(prefix="linchpin-") as made:
        folder = Path(made if out is None else out)
        watch = Watch(folder, progress)
        command = ["run", "--quiet", "--out", os.fspath(folder), *arguments, "--", os.fspath(scene)]
        outcome = call(program, command, watch.look, stop)
        watch.end()
        if outcome.exit_code == WRONG:
            raise SceneError(outcome.message, WRONG)
        kept = read_run(folder, is_kept=out is not None)
        if outcome.exit_code != 0 or kept is None:
            reason = outcome.message if outcome.problems or kept is None else kept.reason or outcome.message
            raise RunFailed(_of_kept_files(reason, made), outcome.exit_code, kept)
        return kept


def _of_kept_files(message: str, removed: str) -> str:
    """A message without its lines on files in a folder that is removed."""
    return "\n".join(line for line in message.splitlines() if removed not in line)

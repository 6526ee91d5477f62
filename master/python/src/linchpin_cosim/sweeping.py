"""Runs of a scene over lists of settings."""

from __future__ import annotations

import itertools
import os
import threading
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any, TypeAlias

import pandas as pd

from .failures import RunFailed, SceneError
from .program import find_program
from .running import finished_run
from .runs import Run
from .settings import set_arguments

Figure: TypeAlias = str | Callable[[Run], object]

FIGURES: Mapping[str, Figure] = {
    "macro_steps": "statistics.macro_steps",
    "integrations": "statistics.integrations",
    "poor": "statistics.verdicts.poor",
    "error": "statistics.estimated_errors.accumulated",
    "wall_time": "wall_time",
}
"""What is told of every run unless something else is asked for."""


def sweep(
    scene: str | os.PathLike[str],
    settings: Mapping[str, Sequence[object]],
    *,
    figures: Mapping[str, Figure] | None = None,
    set: Mapping[str, object] | None = None,
    in_process: bool = False,
    processes: int | None = None,
    program: str | os.PathLike[str] | None = None,
) -> pd.DataFrame:
    """Runs a scene for every combination of the settings, as `{"coupling.macro_step": [2e-3, 1e-3]}`; a row for each.

    The columns are the settings, `case` for a scene with cases, `status`, the `message` of a run that is not done, the number
    of its `warnings`, and the figures. The status is done, failed, interrupted, refused where a setting is wrong, or missing
    for a case behind one that failed. A figure is a function of the `Run`, or a place in run.json such as
    "statistics.integrations"; runs that are not done have none. At most `processes` runs are under way at a time, by default
    one for each core.

    Raises `SceneError` if every combination is refused.
    """
    found, keys = find_program(program), list(settings)
    processes = processes if processes is not None else os.cpu_count() or 1
    if processes < 1:
        raise ValueError(f"processes = {processes}: it must be at least 1")
    wanted = FIGURES if figures is None else figures
    flags = ["--in-process"] if in_process else []
    stop = threading.Event()

    def rows(values: Sequence[object]) -> list[dict[str, Any]] | SceneError:
        own = dict(zip(keys, values, strict=True))
        if stop.is_set():
            return []
        try:
            done = finished_run(found, scene, [*flags, *set_arguments({**(set or {}), **own})], stop=stop)
        except SceneError as error:
            return error
        except RunFailed as failed:
            if failed.run is None or not failed.run.cases:
                status = "failed" if failed.run is None else failed.run.status
                return [{**own, "status": status, "message": str(failed).partition("\n")[0]}]
            done = failed.run
        if done.cases:
            names = [case["case"] for case in done.info["cases"]]
            return [{**own, "case": name, **_row(done.cases.get(name), wanted)} for name in names]
        return [{**own, **_row(done, wanted)}]

    combinations = list(itertools.product(*settings.values()))
    with ThreadPoolExecutor(processes) as pool:
        try:
            answers = list(pool.map(rows, combinations))
        except BaseException:
            stop.set()
            raise
    refused = [answer for answer in answers if isinstance(answer, SceneError)]
    if refused and len(refused) == len(answers):
        raise refused[0]
    table: list[dict[str, Any]] = []
    for values, answer in zip(combinations, answers, strict=True):
        if isinstance(answer, SceneError):
            table.append(
                {**dict(zip(keys, values, strict=True)), "status": "refused", "message": str(answer).partition("\n")[0]}
            )
        else:
            table += answer
    has_cases = any("case" in row for row in table)
    columns = [*keys, *(["case"] if has_cases else []), "status", "message", "warnings", *wanted]
    return pd.DataFrame(table, columns=columns)


def _row(run: Run | None, figures: Mapping[str, Figure]) -> dict[str, Any]:
    if run is None:
        return {"status": "missing", "message": "a case before it failed"}
    if run.status != "done":
        return {"status": run.status, "message": (run.reason or "").partition("\n")[0]}
    told = {name: _figure(run, name, figure) for name, figure in figures.items()}
    return {"status": run.status, "message": "", "warnings": len(run.warnings), **told}


def _figure(run: Run, name: str, figure: Figure) -> object:
    if callable(figure):
        return figure(run)
    value: Any = run.info
    for part in figure.split("."):
        if value is None:
            return None
        if not isinstance(value, Mapping) or part not in value:
            known = ", ".join(value) if isinstance(value, Mapping) else "nothing"
            raise ValueError(f'figure "{name}": run.json has no {figure}; where {part} is looked for there is: {known}')
        value = value[part]
    return value

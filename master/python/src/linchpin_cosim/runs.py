"""What a run leaves."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pandas as pd


@dataclass(frozen=True)
class ErrorEstimate:
    """How large the errors of the macro steps are, as shares of the motion."""

    largest: float
    """The largest of a step."""
    of: str
    """The column that has it."""
    t: float
    """Where it is (s)."""
    accumulated: float
    """All together; a guide, as errors may cancel or grow."""


@dataclass(frozen=True, repr=False)
class Run:
    """A run, done or failed."""

    info: Mapping[str, Any]
    """run.json."""
    results: pd.DataFrame
    """A row for every macro point over `t` (s); `results.attrs["units"]` has the unit of every column.

    It is empty for a scene with cases, whose results are those of the `cases`.
    """
    folder: Path | None
    """Where the files are; None if they are not kept."""
    cases: Mapping[str, Run] = field(default_factory=dict)
    """The cases of the scene by name; empty for a scene without."""

    @property
    def scene(self) -> str:
        """Name of the scene."""
        return str(self.info["scene"])

    @property
    def status(self) -> str:
        """`done`, `failed` or `interrupted`."""
        return str(self.info["status"])

    @property
    def reason(self) -> str | None:
        """Why it did not come to its end."""
        reason = self.info["reason"]
        return None if reason is None else str(reason)

    @property
    def units(self) -> dict[str, str]:
        """The unit of every column, `t` included; `1` for a number without unit."""
        return {column["name"]: column["unit"] for column in self.info["columns"]}

    @property
    def descriptions(self) -> dict[str, str]:
        """What every column shows, in words, `t` included; empty where a worker does not tell."""
        return {column["name"]: column["description"] for column in self.info["columns"]}

    @property
    def statistics(self) -> Mapping[str, Any]:
        """Counts, times and largest residuals; of a failed run, up to where it stopped."""
        return self.info.get("statistics") or {}

    @property
    def warnings(self) -> list[str]:
        """Why the results are not to be trusted everywhere, those of all cases included."""
        own = list(self.info.get("warnings") or ())
        return own + [f'case "{name}": {text}' for name, case in self.cases.items() for text in case.warnings]

    @property
    def verdicts(self) -> dict[str, int]:
        """Number of macro steps by verdict: good, fair, poor, uncorrected."""
        return dict(self.statistics.get("verdicts") or {})

    @property
    def error_estimate(self) -> ErrorEstimate | None:
        """The estimated errors of the macro steps; None for methods that have none."""
        told = self.statistics.get("estimated_errors")
        return None if told is None else ErrorEstimate(**{name: told[name] for name in ErrorEstimate.__dataclass_fields__})

    def __repr__(self) -> str:
        """Scene, status and size."""
        size = f"{len(self.cases)} cases" if self.cases else f"{len(self.results)} macro points"
        return f"<Run of {self.scene}: {self.status}, {size}, {len(self.warnings)} warnings>"


def read_run(folder: Path, is_kept: bool) -> Run | None:
    """The run whose files are in `folder`; None if there is none."""
    file = folder / "run.json"
    if not file.is_file():
        return None
    info = json.loads(file.read_text(encoding="utf-8"))
    cases = {}
    for case in info.get("cases") or ():
        run = read_run(folder / case["folder"], is_kept)
        if run is not None:
            cases[case["case"]] = run
    return Run(info, _results(folder / "results.csv", info), folder if is_kept else None, cases)


def _results(file: Path, info: Mapping[str, Any]) -> pd.DataFrame:
    units = {column["name"]: column["unit"] for column in info["columns"]}
    if file.is_file() and file.stat().st_size > 0:
        # Not by the fast conversion of pandas, which may miss the last bit.
        table = pd.read_csv(file, dtype=str).astype(float)
    else:
        table = pd.DataFrame({name: pd.Series(dtype=float) for name in units or ("t",)})
    table = table.set_index("t")
    table.attrs["units"] = {name: units.get(name, "1") for name in ("t", *table.columns)}
    table.attrs["descriptions"] = {column["name"]: column["description"] for column in info["columns"]}
    return table

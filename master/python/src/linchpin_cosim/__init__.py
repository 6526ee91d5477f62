"""Runs, checks and sweeps scenes by the program `linchpin`.

import linchpin_cosim as lc

run = lc.run("scene.toml", set={"coupling.macro_step": 1e-3})
run.results["arm.tip_x"]          # a pandas DataFrame over time; units in run.results.attrs["units"]
"""

from .checking import check
from .failures import LinchpinError, LinchpinWarning, ProgramNotFound, RunFailed, SceneError
from .messages import Problem
from .plotting import plot
from .program import find_program
from .running import run
from .runs import ErrorEstimate, Run
from .sweeping import sweep

__all__ = [
    "ErrorEstimate",
    "LinchpinError",
    "LinchpinWarning",
    "Problem",
    "ProgramNotFound",
    "Run",
    "RunFailed",
    "SceneError",
    "check",
    "find_program",
    "plot",
    "run",
    "sweep",
]

"""Curves of a run."""

from __future__ import annotations

import fnmatch
from collections.abc import Sequence
from typing import Any

from .runs import Run

ASIDE = ("*.residual.*", "error_estimate", "step", "degree", "exchanged_degree", "rejected")
"""Columns that tell of the coupling and not of the motion; drawn only where they are asked for."""

WIDTH, HEIGHT = 7.0, 1.8
"""Of one panel, in inches."""


def plot(run: Run, variables: str | Sequence[str] | None = None) -> list[Any]:
    """Draws variables of a run over time by matplotlib, a panel for every unit, and gives the axes.

    `variables` are names of columns or patterns such as "*.tip_x"; without them all outputs and multipliers are drawn.
    """
    try:
        from matplotlib import pyplot
    except ImportError as error:
        raise ImportError("plot needs matplotlib; install it by: pip install 'linchpin-cosim[plot]'") from error
    panels: dict[str, list[str]] = {}
    for name in _chosen(run, variables):
        panels.setdefault(run.results.attrs["units"][name], []).append(name)
    size = (WIDTH, HEIGHT * len(panels) + 0.5)
    figure, grid = pyplot.subplots(len(panels), sharex=True, squeeze=False, figsize=size, layout="constrained")
    axes = list(grid[:, 0])
    for own, (unit, names) in zip(axes, panels.items(), strict=True):
        for name in names:
            own.plot(run.results.index, run.results[name], label=name, linewidth=1.0)
        own.set_ylabel(unit)
        own.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize="small", frameon=False)
    axes[-1].set_xlabel("t in s")
    figure.suptitle(run.scene)
    return axes


def _chosen(run: Run, variables: str | Sequence[str] | None) -> list[str]:
    columns = list(run.results.columns)
    if run.cases:
        raise ValueError(f"{run.scene} has cases; draw one of run.cases: {', '.join(run.cases)}")
    if variables is None:
        return [name for name in columns if not any(fnmatch.fnmatchcase(name, aside) for aside in ASIDE)]
    chosen: dict[str, None] = {}
    for pattern in [variables] if isinstance(variables, str) else variables:
        matching = [name for name in columns if fnmatch.fnmatchcase(name, pattern)]
        if not matching:
            raise ValueError(f'no column of {run.scene} matches "{pattern}"; there are: {", ".join(columns)}')
        chosen.update(dict.fromkeys(matching))
    return list(chosen)

"""Checks of scenes."""

from __future__ import annotations

import os
from collections.abc import Mapping

from .call import call
from .failures import LinchpinError
from .messages import Problem
from .program import find_program
from .settings import set_arguments


def check(
    scene: str | os.PathLike[str],
    *,
    set: Mapping[str, object] | None = None,
    program: str | os.PathLike[str] | None = None,
) -> list[Problem]:
    """The errors and warnings of a scene file, without starting anything; empty if there are none."""
    outcome = call(find_program(program), ["check", *set_arguments(set), "--", os.fspath(scene)])
    if outcome.exit_code != 0 and not any(problem.level == "error" for problem in outcome.problems):
        raise LinchpinError(outcome.message, outcome.exit_code)
    return outcome.problems

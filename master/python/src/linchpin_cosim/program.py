"""Where the program `linchpin` is."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

from .failures import ProgramNotFound

NAME = "linchpin"
VARIABLE = "LINCHPIN"
BUILT = Path("target", "release", NAME)


def find_program(program: str | os.PathLike[str] | None = None) -> Path:
    """The program: `program` if it is given, else what the variable LINCHPIN names, else `linchpin` on the PATH, else
    target/release/linchpin of the checkout that the current folder or this package stands in.
    """
    if program is not None:
        return _executable(program, f"program = {os.fspath(program)!r}")
    named = os.environ.get(VARIABLE)
    if named:
        return _executable(named, f"{VARIABLE} = {named!r}")
    found = shutil.which(NAME)
    if found:
        return Path(found).resolve()
    for place in (Path.cwd(), Path(__file__).resolve()):
        for folder in (place, *place.parents):
            if _is_executable(folder / BUILT):
                return folder / BUILT
    raise ProgramNotFound(
        f"there is no {NAME} on the PATH and no {BUILT} above {Path.cwd()}; build it with cargo build --release, or name it by "
        f"the argument program or the environment variable {VARIABLE}"
    )


def _executable(name: str | os.PathLike[str], place: str) -> Path:
    found = shutil.which(name)
    if found is None:
        raise ProgramNotFound(f"{place}: there is no such program; it must be the path of an executable {NAME}")
    return Path(found).resolve()


def _is_executable(path: Path) -> bool:
    return path.is_file() and os.access(path, os.X_OK)

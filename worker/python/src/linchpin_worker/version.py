"""Which version of this package it is."""

from importlib.metadata import PackageNotFoundError, version

PROGRAM = "linchpin-worker"


def own_version() -> str:
    """Version of this package; "unknown" where it is not installed but found by its path."""
    try:
        return version(PROGRAM)
    except PackageNotFoundError:
        return "unknown"

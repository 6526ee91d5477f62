"""Settings of a scene as the command line takes them."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence


def set_arguments(settings: Mapping[str, object] | None) -> list[str]:
    """The arguments that change settings of the scene, such as `{"coupling.macro_step": 1e-3}`."""
    arguments = []
    for key, value in (settings or {}).items():
        arguments += ["--set", f"{key}={toml(value, key)}"]
    return arguments


def toml(value: object, key: str) -> str:
    """A value as TOML writes it."""
    # Numbers and arrays of NumPy have their plain values.
    plain = value.tolist() if hasattr(value, "tolist") else value
    if isinstance(plain, bool):
        return "true" if plain else "false"
    if isinstance(plain, int | float):
        return repr(plain)
    if isinstance(plain, str):
        return json.dumps(plain, ensure_ascii=False)
    if isinstance(plain, Mapping):
        return "{ " + ", ".join(f"{json.dumps(str(name))} = {toml(own, key)}" for name, own in plain.items()) + " }"
    if isinstance(plain, Sequence):
        return "[" + ", ".join(toml(own, key) for own in plain) + "]"
    raise TypeError(
        f"the setting {key} = {value!r} is of the type {type(value).__name__}; it must be a number, a text, True or False, "
        "or a list or dictionary of these"
    )

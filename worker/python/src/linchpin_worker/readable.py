"""Numbers in messages for people."""

import math


def number(value: float) -> str:
    """A number as it is written in scenes and in messages of masters."""
    if math.isnan(value):
        return "NaN"
    return f"{value:.9g}"

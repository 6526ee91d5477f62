"""Macro steps as whole numbers of internal steps."""

import math
from collections.abc import Iterator

# A step that is longer than a whole number of internal ones by rounding alone has no part more.
ROUNDING = 1e-9


def equal_parts(step: float, dt: float) -> Iterator[tuple[float, float]]:
    """Divides a macro step of length `step` (s) into the fewest equal parts that are not longer than `dt` (s).

    Yields start (s after that of the macro step) and length (s) of each. A solver with fixed steps takes one for each.
    """
    if not (step > 0.0 and dt > 0.0 and math.isfinite(step / dt)):
        raise ValueError(f"equal parts of {step} s of at most {dt} s: both must be greater than 0")
    count = max(1, math.ceil(step / dt * (1.0 - ROUNDING)))
    for number in range(count):
        yield step * number / count, step / count

"""The solver behind an instance: its calls, what they tell, and where it stands."""

from __future__ import annotations

import logging
import math
from collections.abc import Callable, Mapping, Sequence
from itertools import count
from typing import TypeVar

from . import readable
from .cancel import is_cancelled
from .failures import StepFailed, fatal, recoverable
from .inputs import Inputs, Values
from .integrals import Integrals
from .interval import Interval
from .state import Kept, State
from .subsystem import Subsystem
from .variable import Variable

NOWHERE = -1
"""A number that no state has: where the solver stands while it cannot be said."""

Answer = TypeVar("Answer")
log = logging.getLogger("linchpin_worker")


class Solver:
    """A subsystem with the number of the state that it is in, and counts of what it did."""

    def __init__(self, subsystem: Subsystem, outputs: Sequence[Variable], integrated: Sequence[int] = ()) -> None:
        self._subsystem = subsystem
        self._names = [variable.name for variable in outputs]
        self.integrals = Integrals(self._names, integrated)
        if integrated:
            subsystem.integrals = self.integrals
        self._numbers = count(1)
        self._stands_at = 0
        self._last_step: tuple[Interval, int] | None = None
        self.integrations = 0
        self.derivatives = 0

    @property
    def internal_steps(self) -> int:
        """Internal steps since the start."""
        return self._subsystem.internal_steps

    def keep(self) -> Kept:
        """The present state."""
        return Kept(self._stands_at, self.save())

    def save(self) -> State:
        """The present state, for a step that is under way."""
        return guarded(None, lambda: State(self._subsystem.save()))

    def numbered(self, state: State) -> Kept:
        """A state that the solver did not reach itself."""
        return Kept(next(self._numbers), state)

    def go_to(self, kept: Kept) -> None:
        """Goes to a state, unless the solver is there."""
        if self._stands_at != kept.number:
            self.load(kept.state)
            self._stands_at = kept.number

    def load(self, state: State) -> None:
        """Goes to a state of a step that is under way."""
        self._stands_at = NOWHERE
        guarded(None, lambda: self._subsystem.load(state.value()))

    def step(self, interval: Interval, inputs: Inputs) -> None:
        """Steps, and counts it as an integration."""
        step = (interval, self._stands_at)
        self.integrations += 1
        self._last_step = None
        self.step_under_way(interval, inputs)
        # What a failed step left behind cannot be repeated.
        self._last_step = step
        self._stands_at = next(self._numbers)

    def step_perturbed(self, interval: Interval, inputs: Inputs) -> None:
        """Steps once more over the interval of the last step, if it began here; otherwise as `step`."""
        if self._last_step != (interval, self._stands_at):
            self.step(interval, inputs)
            return
        self.integrations += 1
        self.step_under_way(interval, inputs, is_repeated=True)
        self._stands_at = next(self._numbers)

    def step_under_way(self, interval: Interval, inputs: Inputs, is_repeated: bool = False) -> None:
        """Steps over a part of a step."""
        self._stands_at = NOWHERE
        self.integrals.begin(interval.length)
        method = self._subsystem.advance_perturbed if is_repeated else self._subsystem.advance
        guarded(interval, lambda: method(interval.start, interval.length, inputs))
        if is_cancelled():
            # It may have ended anywhere.
            raise fatal("the step was cancelled", interval.start, interval.length)

    def jump(self, interval: Interval, values: Values, impulses: Values) -> None:
        """Lets velocities jump at the end of `interval`, where the inputs are `values`."""
        self._stands_at = NOWHERE
        guarded(interval, lambda: self._subsystem.impulse(interval.end, values, impulses))

    def begin_cut(self) -> None:
        """A step that is cut is not repeated by one that is not."""
        self._last_step = None

    def arrive(self) -> None:
        """The state that a step has led to, part by part, is one to stay in."""
        self._stands_at = next(self._numbers)

    def outputs(self, interval: Interval, values: Values, wanted: Sequence[int]) -> list[float]:
        """The outputs numbered `wanted` at the end of `interval`, where the inputs are `values`."""
        told = guarded(interval, lambda: self._subsystem.outputs(interval.end, values))
        return self._numbers_of("outputs", told, wanted, interval)

    def derivative(self, interval: Interval, inputs: Inputs, direction: Inputs, wanted: Sequence[int]) -> list[float]:
        """Derivatives of the outputs numbered `wanted` at the end of `interval`."""
        if interval.length > 0.0:
            self.derivatives += 1
            if self._last_step != (interval, self._stands_at):
                self._last_step = None
        self._stands_at = NOWHERE
        self.integrals.begin(interval.length)
        told = guarded(interval, lambda: self._subsystem.derivative(interval.start, interval.length, inputs, direction))
        return self._numbers_of("derivative", told, wanted, interval)

    def integrals_over(self, interval: Interval) -> list[float]:
        """Integrals over the step, or the part of one, that was taken last, or derivatives of them."""
        if len(self.integrals) == 0:
            return []
        values = guarded(interval, self.integrals.told)
        if len(values) != len(self.integrals):
            rule = "end with integrals.set, or call integrals.add or add_along for each internal step"
            text = f"the step told {len(values)} integrals, {len(self.integrals)} are asked for; {rule}"
            raise fatal(text, interval.start, interval.length)
        for place, value in enumerate(values):
            if not math.isfinite(value):
                name = self.integrals.of(place)
                raise self._not_finite(f"an integral of {name}", name, value, interval)
        return values

    def _numbers_of(
        self, method: str, told: Sequence[float] | Mapping[str, float], wanted: Sequence[int], interval: Interval
    ) -> list[float]:
        names = self._names
        if isinstance(told, Mapping):
            missing = [names[place] for place in wanted if names[place] not in told]
            if missing:
                raise fatal(f"{method} gives no value of {', '.join(missing)}; given: {', '.join(told) or 'none'}")
            found = [told[names[place]] for place in wanted]
        elif len(told) == len(names):
            found = [told[place] for place in wanted]
        else:
            needed = f"the model has {len(names)} outputs: {', '.join(names)}"
            raise fatal(f"{method} gives {len(told)} values; {needed}")
        numbers = guarded(interval, lambda: [float(number) for number in found])
        if not all(map(math.isfinite, numbers)):
            place = next(place for place, number in enumerate(numbers) if not math.isfinite(number))
            name = names[wanted[place]]
            raise self._not_finite(name, name, numbers[place], interval)
        return numbers

    def _not_finite(self, what: str, name: str, number: float, interval: Interval) -> Exception:
        text = f"{what} = {readable.number(number)} at t = {readable.number(interval.end)} s: it must be finite"
        if interval.length > 0.0:
            return recoverable(text, interval.end, interval.length, name)
        return fatal(text, interval.end, 0.0, name)


def guarded(interval: Interval | None, call: Callable[[], Answer]) -> Answer:
    """The answer of the author's code; what it raises becomes a failure of the contract. `interval` is that of a step."""
    try:
        return call()
    except StepFailed as failed:
        if interval is None:
            raise fatal(str(failed)) from failed
        t = interval.start if failed.t is None else failed.t
        raise recoverable(f"{failed} at t = {readable.number(t)} s", t, interval.length) from failed
    except ArithmeticError as error:
        if interval is None:
            raise fatal(raised(error)) from error
        raise recoverable(raised(error), interval.start, interval.length) from error
    except (Exception, SystemExit) as error:
        log.exception("the solver raised an exception; it ends the run")
        if interval is None:
            raise fatal(raised(error)) from error
        raise fatal(raised(error), interval.start, interval.length) from error


def raised(error: BaseException) -> str:
    """What an exception of the solver says, in one line."""
    return f"the solver raised {type(error).__name__}: {str(error) or 'no message'}"

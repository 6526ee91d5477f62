"""A subsystem on its way: steps and looks ahead, and the states that it can go back to."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from enum import Enum
from typing import NamedTuple

from ._contract import worker_pb2 as pb
from .description import Description
from .encoding import Damaged, NotPortable, decode, encode
from .failures import fatal, misuse
from .impacts import NONE, GivenImpacts
from .inputs import Inputs
from .integrals import add_part
from .interval import Interval, Part, Strike, check_inside, check_integrals, parts
from .readable import number
from .signals import Signals, find
from .solver import Solver
from .state import Kept, State
from .subsystem import Subsystem

NOTHING_TO_TAKE_BACK = (
    "the committed state is not the end of an advance, so there is nothing to take back: one advance can be, not two; "
    "further back there are Snapshot and Restore"
)


class Base(Enum):
    """Which state a step starts from."""

    COMMITTED = "committed"
    ADVANCED = "advanced"


class Told(NamedTuple):
    """What a step that is cut tells, as far as it has come."""

    at_end: list[float]
    integrals: list[float]
    inside: list[float]

    def values(self) -> list[float]:
        """All of it, in the order of an answer."""
        return self.at_end + self.integrals + self.inside


class Motion:
    """A subsystem with its signals, and the state that it has for its master.

    The solver itself may stand elsewhere, at the end of a step that was only tried; every call goes back first.
    """

    def __init__(self, subsystem: Subsystem, signals: Signals, description: Description, request: pb.InitializeRequest) -> None:
        known = description.outputs
        integrated = find(known, request.integrated_outputs, "integrated_outputs")
        if integrated and not description.output_integrals:
            text = f"the model {description.name} does not offer integrals of outputs"
            rule = "leave integrated_outputs empty where the capabilities do not say output_integrals"
            raise misuse("integrated_outputs", f"{text}; {rule}")
        self._coupling = find(known, request.coupling_outputs, "coupling_outputs")
        self._all = self._coupling + find(known, request.recorded_outputs, "recorded_outputs")
        self._interior = find(known, request.interior_outputs, "interior_outputs")
        self._description = description
        self._signals = signals
        self._integrated = len(integrated)
        self._strikes: Sequence[Strike] = ()
        self.solver = Solver(subsystem, known, integrated)
        self.committed = self.solver.keep()
        self._advanced = self.committed
        self._previous: Kept | None = None

    def take(self, signals: Iterable[pb.Signal], integrals: int = 0, impacts: GivenImpacts = NONE) -> None:
        """Takes the signals of a request, how many integrals it wants, and its impacts for the steps that follow."""
        self._signals.set(signals)
        check_integrals(integrals)
        self._strikes = impacts.strikes(self._description, len(self._signals))
        self.solver.integrals.choose(integrals)

    def advance(self, interval: Interval, instants: Sequence[float], outputs: pb.OutputSet) -> list[float]:
        """Steps from the committed state, cut at `instants`; `commit` makes the end the committed state."""
        wanted = self._all if outputs == pb.OUTPUT_SET_ALL else self._coupling
        self._go_to(Base.COMMITTED)
        values = self._step(interval, wanted, instants)
        self._advanced = self.solver.keep()
        return values

    def sample(self, interval: Interval) -> list[float]:
        """All outputs after a shorter step than the advance, from where it started and under its signals."""
        self._go_to(Base.COMMITTED)
        # Integrals belong to the advance alone.
        return self._step(interval, self._all)[: len(self._all)]

    def commit(self) -> None:
        """Makes the end of the advance the committed state."""
        self._previous, self.committed = self.committed, self._advanced

    def take_back(self) -> Kept:
        """Makes the state that the last advance started from the committed one; answers with the one before."""
        if self._previous is None:
            raise misuse("go_back", NOTHING_TO_TAKE_BACK)
        taken_back, self.committed, self._previous = self.committed, self._previous, None
        return taken_back

    def stay(self, taken_back: Kept) -> None:
        """Undoes `take_back`, after which nothing was committed."""
        self._previous, self.committed = self.committed, taken_back

    def restore(self, kept: Kept) -> None:
        """Makes `kept` the committed state."""
        self.solver.go_to(kept)
        self.committed, self._previous = kept, None

    def export(self) -> bytes:
        """The committed state as bytes."""
        try:
            return encode(self.committed.state.value())
        except NotPortable as error:
            raise fatal(f'the state of model "{self._description.name}" cannot leave its process: {error}') from error

    def take_exported(self, encoded: bytes) -> None:
        """Makes a state that another instance has exported the committed one."""
        try:
            state = State(decode(encoded))
        except Damaged as damaged:
            raise misuse("state", f"these {len(encoded)} bytes are no state: {damaged}") from damaged
        self.restore(self.solver.numbered(state))

    def look_ahead(
        self, base: Base, interval: Interval, instants: Sequence[float], perturbed: Sequence[pb.Signal]
    ) -> tuple[list[float], list[pb.Outputs]]:
        """Coupling outputs at the end of `interval` and interior ones at `instants`, and again for every perturbed signal."""
        if self._is_cut(instants) and interval.length > 0.0:
            values, *others = self._look_ahead_cut(base, interval, instants, perturbed)
            self.solver.integrations += 1
            return values, [pb.Outputs(values=other) for other in others]
        self._go_to(base)
        values = self._step(interval, self._coupling)
        return values, self._look_ahead_uncut(base, interval, perturbed)

    def look_ahead_perturbed(
        self, base: Base, interval: Interval, instants: Sequence[float], perturbed: Sequence[pb.Signal]
    ) -> list[pb.Outputs]:
        """As `look_ahead`, with every perturbed signal in place of the present signal of its input only."""
        if self._is_cut(instants):
            # The first one is taken for its internal steps, which the others repeat.
            _, *others = self._look_ahead_cut(base, interval, instants, perturbed)
            return [pb.Outputs(values=other) for other in others]
        return self._look_ahead_uncut(base, interval, perturbed)

    def _look_ahead_uncut(self, base: Base, interval: Interval, perturbed: Sequence[pb.Signal]) -> list[pb.Outputs]:
        outputs = []
        for signal in perturbed:
            inputs = self._signals.replaced(signal, interval.length)
            self._go_to(base)
            if interval.length > 0.0:
                self.solver.step_perturbed(interval, inputs)
            outputs.append(pb.Outputs(values=self._told(interval, inputs, self._coupling)))
        return outputs

    def look_in_directions(
        self, base: Base, interval: Interval, instants: Sequence[float], directions: Sequence[pb.Signal]
    ) -> list[pb.Outputs]:
        """Derivatives of what `look_ahead` tells. Those at an instant are derivatives over the step that ends there."""
        outputs = self.derivatives(base, interval, directions, self._coupling, has_integrals=True)
        if interval.length > 0.0:
            check_inside("instants", "instant", instants, interval.length)
            counted = self.solver.derivatives
            for instant in instants:
                shorter = Interval(interval.start, instant)
                inside = self.derivatives(base, shorter, directions, self._interior)
                for whole, own in zip(outputs, inside, strict=True):
                    whole.values.extend(own.values)
            self.solver.derivatives = counted
        return outputs

    def derivatives(
        self,
        base: Base,
        interval: Interval,
        directions: Sequence[pb.Signal],
        wanted: Sequence[int],
        has_integrals: bool = False,
    ) -> list[pb.Outputs]:
        """Derivatives of the outputs numbered `wanted` at the end of `interval`, and of integrals, one for each direction."""
        if directions and not self._description.directional_derivatives:
            raise misuse("directions", "this model does not offer directional derivatives")
        outputs = []
        for signal in directions:
            direction = self._signals.direction(signal, interval.length)
            self._go_to(base)
            inputs = self._signals.inputs(interval.length)
            values = self.solver.derivative(interval, inputs, direction, wanted)
            if has_integrals and interval.length > 0.0:
                values += self.solver.integrals_over(interval)
            outputs.append(pb.Outputs(values=values))
        return outputs

    def evaluate(self, request: pb.EvaluateRequest) -> pb.EvaluateReply:
        """Outputs of the committed state by their names, and their derivatives in each direction."""
        if not math.isfinite(request.t):
            raise misuse("t", f"t = {number(request.t)}: it must be a finite number")
        wanted = find(self._description.outputs, request.outputs, "outputs")
        self.take(request.signals)
        self._go_to(Base.COMMITTED)
        now = Interval(request.t, 0.0)
        values = self._step(now, wanted)
        derivatives = self.derivatives(Base.COMMITTED, now, request.directions, wanted)
        return pb.EvaluateReply(outputs=pb.Outputs(values=values), derivatives=derivatives)

    def _go_to(self, base: Base) -> None:
        self.solver.go_to(self.committed if base is Base.COMMITTED else self._advanced)

    def _is_cut(self, instants: Sequence[float]) -> bool:
        return len(instants) > 0 or len(self._strikes) > 0

    def _step(self, interval: Interval, wanted: Sequence[int], instants: Sequence[float] = ()) -> list[float]:
        """What is told after a step from where the solver stands; one of length 0 evaluates."""
        if interval.length > 0.0 and self._is_cut(instants):
            return self._step_cut(interval, instants, wanted)
        inputs = self._signals.inputs(interval.length)
        if interval.length > 0.0:
            self.solver.step(interval, inputs)
        return self._told(interval, inputs, wanted)

    def _told(self, interval: Interval, inputs: Inputs, wanted: Sequence[int]) -> list[float]:
        """Outputs after a step or an evaluation, and the integrals over a step."""
        values = self.solver.outputs(interval, inputs.at_end, wanted)
        return values + self.solver.integrals_over(interval) if interval.length > 0.0 else values

    def _step_cut(self, interval: Interval, instants: Sequence[float], wanted: Sequence[int]) -> list[float]:
        """Outputs after a step that is cut, its integrals, then interior outputs at each of the `instants`."""
        check_inside("instants", "instant", instants, interval.length)
        self.solver.begin_cut()
        self.solver.integrations += 1
        inputs, told = self._signals.inputs(interval.length), self._nothing_told()
        for part in parts(interval.length, instants, self._strikes):
            self._part(interval, part, inputs, wanted, told)
        self.solver.arrive()
        return told.values()

    def _look_ahead_cut(
        self, base: Base, interval: Interval, instants: Sequence[float], perturbed: Sequence[pb.Signal]
    ) -> list[list[float]]:
        """The step as it is and with every perturbed signal, side by side from cut to cut.

        Between two cuts the perturbed ones repeat the internal steps of the one that is not, from states of their own.
        """
        check_inside("instants", "instant", instants, interval.length)
        length = interval.length
        inputs = [self._signals.inputs(length), *(self._signals.replaced(signal, length) for signal in perturbed)]
        self.solver.integrations += len(perturbed)
        self.solver.begin_cut()
        self._go_to(base)
        states = [self.solver.save()] * len(inputs)
        told = [self._nothing_told() for _ in inputs]
        for part in parts(length, instants, self._strikes):
            for place, own in enumerate(inputs):
                self.solver.load(states[place])
                self._part(interval, part, own, self._coupling, told[place], is_repeated=place > 0)
                if not part.is_last:
                    states[place] = self.solver.save()
        return [own.values() for own in told]

    def _nothing_told(self) -> Told:
        return Told([], [0.0] * len(self.solver.integrals), [])

    def _part(
        self, interval: Interval, part: Part, inputs: Inputs, wanted: Sequence[int], told: Told, is_repeated: bool = False
    ) -> None:
        """Steps over one part, and tells the outputs `wanted` at the end of the step or the interior ones before."""
        own = Interval(interval.start + part.start, part.end - part.start)
        # Strikes may be at the start, at the end or at one instant.
        if own.length > 0.0:
            self.solver.step_under_way(own, inputs.starting_at(part.start, own.length), is_repeated)
            of_part = self.solver.integrals_over(own)
            if of_part:
                shares = part.start / interval.length, part.end / interval.length
                add_part(*shares, of_part, told.integrals, self._integrated)
        at_part_end = Interval(interval.start, part.end)
        if part.strike is not None:
            if part.strike.impulses:
                self.solver.jump(at_part_end, inputs(part.end), self._signals.impulses(part.strike.impulses))
        elif part.is_last:
            told.at_end.extend(self.solver.outputs(at_part_end, inputs(part.end), wanted))
        else:
            told.inside.extend(self.solver.outputs(at_part_end, inputs(part.end), self._interior))

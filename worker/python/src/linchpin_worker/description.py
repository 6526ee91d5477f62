"""What a model is: its inputs, outputs, parameters, solvers and markers."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from ._contract import worker_pb2 as pb
from .marker import Marker
from .parameter import Parameter, Solver
from .polynomial import MAX_NODES
from .variable import Variable


class DescriptionError(ValueError):
    """A model contradicts itself; its author must change it."""


@dataclass(frozen=True)
class Description:
    """What masters are told about a model.

    `states` says which output is set by which parameter at the start, for masters that look at the state of a model.
    `exportable_snapshot`: another process can go on from what `save` gives, and all of it is of the types that the module
    `encoding` lists. `output_integrals`: steps tell integrals of outputs (`Subsystem.integrals`). `impulses`: velocities can
    jump within a step (`Subsystem.impulse`). `max_input_degree` is the highest degree of an input polynomial that the solver
    takes.
    """

    name: str
    text: str = ""
    inputs: Sequence[Variable] = ()
    outputs: Sequence[Variable] = ()
    parameters: Sequence[Parameter] = ()
    solvers: Sequence[Solver] = ()
    markers: Sequence[Marker] = ()
    states: Mapping[str, str] = field(default_factory=dict)
    max_input_degree: int = MAX_NODES - 1
    repeats_step_sequence: bool = False
    directional_derivatives: bool = False
    joint_loads: bool = False
    exportable_snapshot: bool = False
    output_integrals: bool = False
    impulses: bool = False

    def __post_init__(self) -> None:
        """Refuses a description that contradicts itself."""
        if not self.name:
            raise DescriptionError("a model needs a name")
        for what, names in (
            ("input", [own.name for own in self.inputs]),
            ("output", [own.name for own in self.outputs]),
            ("parameter", [own.name for own in self.parameters]),
            ("solver", [own.name for own in self.solvers]),
            ("marker", [own.name for own in self.markers]),
        ):
            self._refuse_twice(what, names)
        for marker in self.markers:
            self._check_marker(marker)
        for output, initial in self.states.items():
            self._known("states", output, "output", self.outputs)
            self._known("states", initial, "parameter", self.parameters)
        if not 0 <= self.max_input_degree < MAX_NODES:
            raise self._error(f"max_input_degree = {self.max_input_degree}: it must be from 0 to {MAX_NODES - 1}")
        for variable in self.inputs:
            if variable.default is not None and not math.isfinite(variable.default):
                raise self._error(f'the default of the input "{variable.name}" is {variable.default}; it must be finite')

    def message(self) -> pb.Model:
        """The description as the contract tells it."""
        return pb.Model(
            name=self.name,
            description=self.text,
            inputs=[own.message() for own in self.inputs],
            outputs=[own.message() for own in self.outputs],
            parameters=[own.message() for own in self.parameters],
            markers=[own.message() for own in self.markers],
            solvers=[own.message() for own in self.solvers],
            states=[pb.StateVariable(output=output, initial=initial) for output, initial in self.states.items()],
            capabilities=pb.Capabilities(
                exchange=True,
                repeats_step_sequence=self.repeats_step_sequence,
                max_input_degree=self.max_input_degree,
                joint_loads=self.joint_loads,
                directional_derivatives=self.directional_derivatives,
                interior_outputs=True,
                exportable_snapshot=self.exportable_snapshot,
                output_integrals=self.output_integrals,
                impulses=self.impulses,
            ),
        )

    def _check_marker(self, marker: Marker) -> None:
        place = f'marker "{marker.name}"'
        for what, names, allowed in marker.lists():
            if len(names) not in allowed:
                counts = ", ".join(map(str, allowed))
                raise self._error(f"{place}: {what} has the length {len(names)}; allowed for its kind are {counts}")
            known = ("input", self.inputs) if what == "load" else ("output", self.outputs)
            for name in names:
                self._known(f"{place}: {what}", name, *known)

    def _known(self, place: str, name: str, what: str, known: Iterable[Variable | Parameter]) -> None:
        names = [own.name for own in known]
        if name not in names:
            raise self._error(f'{place} names the {what} "{name}"; the model has: {", ".join(names) or "none"}')

    def _refuse_twice(self, what: str, names: Sequence[str]) -> None:
        for place, name in enumerate(names):
            if not name:
                raise self._error(f"{what} number {place} has no name")
            if name in names[:place]:
                raise self._error(f'two {what}s have the name "{name}"')

    def _error(self, text: str) -> DescriptionError:
        return DescriptionError(f'model "{self.name}": {text}')

"""What a solver author writes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

from .cancel import is_cancelled
from .description import Description, DescriptionError
from .inputs import Inputs, Values
from .integrals import Integrals
from .setup import Setup

NEEDED = ("advance", "outputs", "save", "load")


class Subsystem:
    """A model. Each of its instances is one solver run, whose methods are called one at a time.

    A subclass has a `description`, and gives `advance`, `outputs`, `save` and `load`. Its constructor takes the `Setup` of
    a new instance, and may raise `Refused`.
    """

    description: ClassVar[Description]
    """What masters are told about the model."""

    tolerance: float | None = None
    """Error tolerance of the solver in units of its outputs; None if it is exact up to rounding."""

    internal_steps: int = 0
    """Internal steps of the solver since the start, for the statistics; the solver counts them itself."""

    integrals: Integrals = Integrals((), ())
    """Integrals of outputs over the step under way, where the description says `output_integrals`.

    `advance`, `advance_perturbed` and, over a step, `derivative` tell all of them, those of the derivatives for the last; with
    `len(self.integrals)` = 0 nothing is asked for. They begin at 0 with every step and belong to no state.
    """

    def __init__(self, setup: Setup) -> None:
        """Makes an instance in its initial state."""

    def advance(self, t: float, step: float, u: Inputs) -> None:
        """Integrates from `t` over `step` (s) under the inputs `u(tau)`, with `tau` from 0 to `step`.

        Raises `StepFailed` if a smaller step may help. What a failed step leaves behind does not matter. A step that takes long
        asks `cancelled` now and then, and returns if so.
        """
        raise NotImplementedError

    @staticmethod
    def cancelled() -> bool:
        """Whether nobody waits for this step any more: its caller is gone, its instance is ended, or the worker shuts down.

        The step may then end at any place, by `return` or an exception. It has not been, for the instance and its master. To be
        asked on the thread that the method was called on; it takes some microseconds.
        """
        return is_cancelled()

    def outputs(self, t: float, u: Values) -> Sequence[float] | Mapping[str, float]:
        """All outputs of the present state at `t` (s), in the order of the description or by their names.

        What depends on an input at once, such as an acceleration, takes it from `u`, the inputs at `t`.
        """
        raise NotImplementedError

    def save(self) -> Any:
        """The whole state: bytes, a tuple of numbers, or anything that pickle takes.

        Where the description says `exportable_snapshot` it is made of None, bool, int, float, str, bytes, tuple, list, dict,
        and arrays and scalars of NumPy that are numbers or bool.

        Nothing that decides about a step may be missing. It is copied, so arrays that the solver changes in place may be
        given as they are.
        """
        raise NotImplementedError

    def load(self, state: Any) -> None:
        """Goes back to a state of `save`, so that the same step gives the same bits again."""
        raise NotImplementedError

    def advance_perturbed(self, t: float, step: float, u: Inputs) -> None:
        """As `advance`, for a step that was taken just before with inputs a little different, from the same state.

        The difference of the two results becomes a column of the coupling Jacobian. A solver that chooses its internal steps
        should repeat those of that step here, and say `repeats_step_sequence` in its description; for others the default,
        `advance`, is right.
        """
        self.advance(t, step, u)

    def derivative(self, t: float, step: float, u: Inputs, direction: Inputs) -> Sequence[float] | Mapping[str, float]:
        """Derivatives `d/de` at `e = 0` of all outputs at the end of a step under the inputs `u + e direction`.

        With `step` = 0 it is the direct feed-through: that of the outputs of the present state. The state that this leaves
        behind does not matter. Only where the description says `directional_derivatives`.
        """
        raise NotImplementedError

    def impulse(self, t: float, u: Values, impulses: Values) -> None:
        """Velocities jump at `t` (s) by what loads of the values `impulses`, added to the inputs `u`, add to accelerations.

        `impulses` has one for each input, 0 for those that are no loads; for a mass the jump is impulse over mass. Where it is
        not so plain, accelerations under `u.plus(impulses)` minus those under `u` are the jump. Positions stay, and constraints
        of the solver keep their velocities. Only where the description says `impulses`.
        """
        raise NotImplementedError

    @classmethod
    def described(cls, parameters: Mapping[str, object]) -> Description:
        """The description where it depends on parameters: here those of a scene, with defaults, not yet checked."""
        return cls.description


def check_model(model: type[Subsystem]) -> Description:
    """The description of a model that has all it needs; otherwise `DescriptionError`."""
    description = getattr(model, "description", None)
    if not isinstance(description, Description):
        raise DescriptionError(f"{model.__name__} has no description; give it one: description = Description(..)")
    needed = [*NEEDED]
    if description.directional_derivatives:
        needed.append("derivative")
    if description.impulses:
        needed.append("impulse")
    for method in needed:
        if getattr(model, method) is getattr(Subsystem, method):
            raise DescriptionError(f'model "{description.name}": {model.__name__} has no method {method}')
    return description

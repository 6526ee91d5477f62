"""What an instance is made from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ._contract import worker_pb2 as pb
from .description import Description
from .failures import Refused
from .parameter import complete, finite


@dataclass(frozen=True)
class Setup:
    """Parameters, solver and start time of a new instance, checked; what the scene leaves out has its default."""

    parameters: Mapping[str, object]
    """By name: float, str, bool or a list of floats, as the model declares them."""
    solver: str
    """Name of the solver asked for; empty if the model declares none."""
    options: Mapping[str, object]
    """Options of the solver by name, as the model declares them."""
    t_start: float
    """Time at which the instance starts (s)."""

    def __getitem__(self, name: str) -> float:
        """The parameter `name`, which is a number."""
        value = self.parameters[name]
        if not isinstance(value, float):
            raise TypeError(f"the parameter {name} is no number; take setup.parameters[{name!r}]")
        return value

    def numbers(self, *names: str) -> list[float]:
        """The parameters `names`, which are numbers."""
        return [self[name] for name in names]


def setup_of(description: Description, request: pb.InitializeRequest) -> Setup:
    """The setup that a request asks for; `Refused` if the model does not allow it."""
    parameters = complete("parameters", request.parameters, description.parameters)
    kinds = {solver.name: solver for solver in description.solvers}
    asked = request.solver.kind if request.HasField("solver") else next(iter(kinds), "")
    if asked in kinds:
        options = complete("solver", request.solver.options, kinds[asked].options)
    elif kinds or asked:
        raise Refused("solver.kind", f'this model has no solver "{asked}"; it has: {", ".join(kinds) or "none"}')
    else:
        options = complete("solver", request.solver.options, ())
    return Setup(parameters, asked, options, finite("t_start", request.t_start))

"""Inputs and outputs of a model."""

from __future__ import annotations

from dataclasses import dataclass

from ._contract import worker_pb2 as pb


@dataclass(frozen=True)
class Variable:
    """An input or an output, with its SI unit.

    `default` is for inputs: the value of one that no joint and no connection drives. Without it the input must be driven.
    """

    name: str
    unit: str = "1"
    description: str = ""
    default: float | None = None

    def message(self) -> pb.Variable:
        """The variable as the contract tells it."""
        return pb.Variable(name=self.name, unit=self.unit, description=self.description, default=self.default)

"""Places on a model where joints hold, and the names of their inputs and outputs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

from ._contract import worker_pb2 as pb
from .variable import Variable

Component: TypeAlias = tuple[str, str, str]


@dataclass(frozen=True)
class Form:
    """The components of all markers of one kind: the end of each name, its unit, what it is."""

    kind: pb.MarkerKind
    position: Sequence[Component]
    velocity: Sequence[Component]
    acceleration: Sequence[Component]
    load: Sequence[Component]
    points: tuple[int, int]
    """Lengths of a position without and with the orientation."""


PLANAR = Form(
    kind=pb.MARKER_KIND_PLANAR,
    position=(("x", "m", "position in x"), ("y", "m", "position in y"), ("angle", "rad", "angle from the x axis")),
    velocity=(("vx", "m/s", "velocity in x"), ("vy", "m/s", "velocity in y"), ("rate", "rad/s", "rate of the angle")),
    acceleration=(
        ("ax", "m/s^2", "acceleration in x under the present loads"),
        ("ay", "m/s^2", "acceleration in y under the present loads"),
        ("alpha", "rad/s^2", "angular acceleration under the present loads"),
    ),
    load=(("fx", "N", "force in x"), ("fy", "N", "force in y"), ("moment", "N m", "moment about the point")),
    points=(2, 3),
)


def _along_axes(name: str, unit: str, words: str) -> tuple[Component, ...]:
    return tuple((name.format(axis), unit, words.format(axis)) for axis in "xyz")


SPATIAL = Form(
    kind=pb.MARKER_KIND_SPATIAL,
    position=(
        *_along_axes("{}", "m", "position in {}"),
        ("qw", "1", "unit quaternion from body to space, real part"),
        *_along_axes("q{}", "1", "unit quaternion, {} part"),
    ),
    velocity=(
        *_along_axes("v{}", "m/s", "velocity in {}"),
        *_along_axes("omega_{}", "rad/s", "angular velocity about {} in space"),
    ),
    acceleration=(
        *_along_axes("a{}", "m/s^2", "acceleration in {} under the present loads"),
        *_along_axes("alpha_{}", "rad/s^2", "angular acceleration about {} in space under the present loads"),
    ),
    load=(
        *_along_axes("f{}", "N", "force in {}"),
        *_along_axes("moment_{}", "N m", "moment about the point, around {} in space"),
    ),
    points=(3, 7),
)


@dataclass(frozen=True)
class Marker:
    """A place where a joint can hold. The lists have names of outputs, `load` has names of inputs.

    `inputs` and `outputs` are the variables of these names where a helper has made the marker, for the lists of the model.
    """

    name: str
    kind: pb.MarkerKind
    position: Sequence[str] = ()
    velocity: Sequence[str] = ()
    acceleration: Sequence[str] = ()
    load: Sequence[str] = ()
    inputs: Sequence[Variable] = ()
    outputs: Sequence[Variable] = ()

    def message(self) -> pb.Marker:
        """The marker as the contract tells it."""
        return pb.Marker(
            name=self.name,
            kind=self.kind,
            position=self.position,
            velocity=self.velocity,
            acceleration=self.acceleration,
            load=self.load,
        )

    def lists(self) -> list[tuple[str, Sequence[str], tuple[int, ...]]]:
        """Each list with the lengths that the kind of the marker allows."""
        position: tuple[int, ...] = (1,)
        rates: tuple[int, ...] = (0, 1)
        if self.kind != pb.MARKER_KIND_SCALAR:
            form = PLANAR if self.kind == pb.MARKER_KIND_PLANAR else SPATIAL
            position = (0, *form.points)
            rates = (0, form.points[0], len(form.velocity))
        return [
            ("position", self.position, position),
            ("velocity", self.velocity, rates),
            ("acceleration", self.acceleration, rates),
            ("load", self.load, rates),
        ]


def scalar_marker(
    name: str, position: str, velocity: str | None = None, acceleration: str | None = None, load: str | None = None
) -> Marker:
    """A marker that moves along a fixed axis, of outputs and an input that the model lists under these names."""
    velocities, accelerations, loads = ([one] if one is not None else [] for one in (velocity, acceleration, load))
    return Marker(name, pb.MARKER_KIND_SCALAR, [position], velocities, accelerations, loads)


def planar_marker(
    name: str, *, orientation: bool = True, velocity: bool = True, acceleration: bool = True, load: bool = True
) -> Marker:
    """A marker in the plane, with outputs and inputs named after it.

    The order of its outputs: `x, y` (m) and `angle` (rad), then `vx, vy` and `rate`, then `ax, ay` and `alpha`, all in
    inertial axes. Its inputs: the force `fx, fy` (N) on the body and the `moment` (N m) about the marker. Every name begins
    with that of the marker and an underscore. Without `orientation` it is a point: no angle, and no moment.
    """
    return _marker(name, PLANAR, orientation, velocity, acceleration, load)


def spatial_marker(
    name: str, *, orientation: bool = True, velocity: bool = True, acceleration: bool = True, load: bool = True
) -> Marker:
    """A marker in space, with outputs and inputs named after it.

    The order of its outputs: `x, y, z` (m) and the unit quaternion `qw, qx, qy, qz` from the axes of the marker to inertial
    ones, then `vx, vy, vz` and `omega_x, omega_y, omega_z`, then `ax, ay, az` and `alpha_x, alpha_y, alpha_z`, all vectors
    in inertial axes. Its inputs: the force `fx, fy, fz` (N) on the body and the moment about the marker `moment_x, moment_y,
    moment_z` (N m). Every name begins with that of the marker and an underscore. Without `orientation` it is a point: no
    quaternion, no angular velocity and acceleration, and no moment.
    """
    return _marker(name, SPATIAL, orientation, velocity, acceleration, load)


def _marker(name: str, form: Form, orientation: bool, velocity: bool, acceleration: bool, load: bool) -> Marker:
    def variables(components: Sequence[Component], is_offered: bool, default: float | None = None) -> list[Variable]:
        kept = (components if orientation else components[: form.points[0]]) if is_offered else ()
        return [Variable(f"{name}_{end}", unit, f'marker "{name}": {words}', default) for end, unit, words in kept]

    position = variables(form.position, True)
    velocities, accelerations = variables(form.velocity, velocity), variables(form.acceleration, acceleration)
    loads = variables(form.load, load, default=0.0)
    names = ([variable.name for variable in own] for own in (position, velocities, accelerations, loads))
    return Marker(name, form.kind, *names, loads, [*position, *velocities, *accelerations])  # type: ignore[call-arg, arg-type]

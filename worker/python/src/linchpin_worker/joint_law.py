"""The load that the multiplier of a joint puts on the markers at its ends.

`r`: position of a marker (m), `T`: rotation from its axes to inertial ones, `p = r + T s` with the joint's point `s` in the
axes of the marker, `e = T axis`. Per unit of the multiplier, in inertial axes:

    law            condition           force on a, moment about marker a   on b
    atpoint        (p_a - p_b) . d     d,  T_a s_a x d                     -d,  -T_b s_b x d
    inplane        (p_a - p_b) . e_b   e_b,  T_a s_a x e_b                 -e_b,  -(p_a - r_b) x e_b
    perpendicular  e_a . e_b           0,  e_a x e_b                       0,  e_b x e_a

They are the derivatives of the condition with respect to a translation and a rotation of the marker.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from ._contract import worker_pb2 as pb
from .geometry import Matrix, Vector, cross, matrix_of_quaternion, turned

ZERO: Vector = (0.0, 0.0, 0.0)
IDENTITY: Matrix = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
UNIT_ROUNDING = 1e-9
"""Lengths off 1 by less than this are rounding."""

A, B = 0, 1
"""The ends of a joint."""


@dataclass(frozen=True)
class Pose:
    """Position (m) and rotation (from the marker's axes to inertial ones) of a marker."""

    position: Vector = ZERO
    rotation: Matrix = IDENTITY

    @classmethod
    def planar(cls, x: float, y: float, angle: float) -> Pose:
        """A marker in the plane; the angle (rad) turns about the third axis."""
        cos, sin = math.cos(angle), math.sin(angle)
        return cls((x, y, 0.0), ((cos, -sin, 0.0), (sin, cos, 0.0), (0.0, 0.0, 1.0)))

    @classmethod
    def spatial(cls, position: Sequence[float], quaternion: Sequence[float]) -> Pose:
        """A marker in space; the length of the quaternion `(w, x, y, z)` does not count."""
        x, y, z = position
        return cls((x, y, z), matrix_of_quaternion(quaternion))

    def point(self, of: Sequence[float]) -> Vector:
        """A point of the marker's axes in inertial ones: `r + T s`."""
        carried = turned(self.rotation, of)
        return tuple(a + b for a, b in zip(self.position, carried, strict=True))  # type: ignore[return-value]


@dataclass(frozen=True)
class Reads:
    """What a load depends on of a marker."""

    position: bool
    rotation: bool


class LawError(ValueError):
    """A message that is no law of a joint: `field` is what is wrong with it."""

    def __init__(self, field: str, reason: str) -> None:
        super().__init__(reason)
        self.field = field


@dataclass(frozen=True)
class JointLaw:
    """The law of one multiplier. `axes` and `points` (m) are those of the markers a and b, in their own axes.

    The direction of atpoint, in inertial axes, is the first axis. An axis that the law does not have is zero.
    """

    law: pb.JointLaw
    axes: tuple[Vector, Vector]
    points: tuple[Vector, Vector]

    @classmethod
    def of_message(cls, message: pb.JointLoad) -> JointLaw:
        """The law of a load; `LawError` where the message has none."""
        if message.law not in (pb.JOINT_LAW_ATPOINT, pb.JOINT_LAW_INPLANE, pb.JOINT_LAW_PERPENDICULAR):
            known = "known are 1 (atpoint), 2 (inplane) and 3 (perpendicular)"
            raise LawError("law", f"law {message.law} is unknown; {known}")
        if message.end not in (pb.JOINT_END_A, pb.JOINT_END_B):
            raise LawError("end", f"end {message.end} is unknown; known are 1 (a) and 2 (b)")
        axis_a = ZERO if message.law == pb.JOINT_LAW_INPLANE else _unit("axis_a", message.axis_a)
        axis_b = ZERO if message.law == pb.JOINT_LAW_ATPOINT else _unit("axis_b", message.axis_b)
        points = _vector("point_a", message.point_a), _vector("point_b", message.point_b)
        return cls(message.law, (axis_a, axis_b), points)

    def reads(self, end: int, of: int) -> Reads:
        """What the load on the marker at `end` depends on of the marker at `of`."""
        is_offset = self.points[of] != ZERO
        if self.law == pb.JOINT_LAW_ATPOINT:
            return Reads(False, end == of and is_offset)
        if self.law == pb.JOINT_LAW_PERPENDICULAR:
            return Reads(False, True)
        return Reads(end == B, of == B or is_offset)

    def acts(self, end: int) -> tuple[bool, bool]:
        """Whether the load on the marker at `end` has a force and a moment; otherwise they are zero."""
        if self.law == pb.JOINT_LAW_PERPENDICULAR:
            return False, True
        is_offset = self.points[end] != ZERO
        return True, is_offset or (self.law == pb.JOINT_LAW_INPLANE and end == B)

    def unit_wrench(self, end: int, poses: tuple[Pose, Pose]) -> tuple[Vector, Vector]:
        """Force and moment about the marker at `end` for a multiplier of 1, at the poses of markers a and b.

        Of these only what `reads` tells counts.
        """
        a, b = poses
        if self.law == pb.JOINT_LAW_PERPENDICULAR:
            other = 1 - end
            own_axis = turned(poses[end].rotation, self.axes[end])
            return ZERO, cross(own_axis, turned(poses[other].rotation, self.axes[other]))
        direction = self.axes[A] if self.law == pb.JOINT_LAW_ATPOINT else turned(b.rotation, self.axes[B])
        force = direction if end == A else (-direction[0], -direction[1], -direction[2])
        if self.law == pb.JOINT_LAW_INPLANE and end == B:
            point = a.point(self.points[A])
            arm = point[0] - b.position[0], point[1] - b.position[1], point[2] - b.position[2]
        else:
            arm = turned(poses[end].rotation, self.points[end])
        return force, cross(arm, force)


def _vector(field: str, values: Sequence[float]) -> Vector:
    if len(values) != 3 or not all(map(math.isfinite, values)):
        raise LawError(field, f"{field} must be three finite numbers")
    return values[0], values[1], values[2]


def _unit(field: str, values: Sequence[float]) -> Vector:
    vector = _vector(field, values)
    length = math.hypot(*vector)
    if abs(length - 1.0) > UNIT_ROUNDING:
        raise LawError(field, f"{field} has the length {length}; it must be a unit vector")
    return vector

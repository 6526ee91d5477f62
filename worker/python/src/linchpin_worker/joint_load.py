"""Joint loads: force and moment of a joint, evaluated inside the solver at the pose that its marker has there."""

from __future__ import annotations

from collections.abc import Mapping, MutableSequence, Sequence
from dataclasses import dataclass

from .geometry import matrix_of_quaternion, matrix_of_rotation_vector, product
from .joint_law import A, JointLaw, Pose


@dataclass(frozen=True)
class LoadedMarker:
    """A marker that takes joint loads: in the plane or in space, with the places of its load among the inputs."""

    name: str
    is_planar: bool
    position: int
    """Length of its position."""
    load: Sequence[int]

    def pose(self, position: Sequence[float]) -> Pose:
        """The pose of its position outputs: `x, y, angle` or `x, y, z, qw, qx, qy, qz`; the list may end early."""
        if len(position) != self.position:
            raise ValueError(
                f'the pose of the marker "{self.name}" has the length {len(position)}; its position has {self.position}'
            )
        if self.is_planar:
            x, y, angle = (*position, *[0.0] * (3 - len(position)))
            return Pose.planar(x, y, angle)
        if len(position) == 7:
            return Pose.spatial(position[:3], position[3:])
        x, y, z = (*position, *[0.0] * (3 - len(position)))
        return Pose((x, y, z))


@dataclass(frozen=True)
class Partner:
    """Places of the pose of the partner's marker among the input values; what the law does not read is empty.

    In the plane the rotation is an angle; in space it is a rotation vector in inertial axes, which follows on the unit
    quaternion `attitude`.
    """

    position: Sequence[int] = ()
    rotation: Sequence[int] = ()
    attitude: Sequence[int] = ()

    def pose(self, signals: Sequence[float]) -> Pose:
        """The pose at an instant; what is absent is at the origin and parallel to the inertial axes."""
        position, rotation, attitude = (
            [signals[place] for place in places] for places in (self.position, self.rotation, self.attitude)
        )
        x, y, z = (*position, *[0.0] * (3 - len(position)))
        if len(rotation) == 1:
            return Pose.planar(x, y, rotation[0])
        if rotation:
            turn = product(matrix_of_rotation_vector(rotation), matrix_of_quaternion(attitude))
            return Pose((x, y, z), turn)
        return Pose((x, y, z))


@dataclass(frozen=True)
class JointLoad:
    """The load of one multiplier on one marker. Places count the input values: the inputs, then the joint inputs."""

    marker: LoadedMarker
    law: JointLaw
    end: int
    multiplier: int
    partner: Partner

    def add(self, poses: Mapping[str, Sequence[float]], signals: Sequence[float], inputs: MutableSequence[float]) -> None:
        """Adds the load at an instant to the load inputs of the marker.

        `poses` has the position outputs of every marker, `signals` the values of inputs and joint inputs.
        """
        if self.marker.name not in poses:
            known = ", ".join(poses) or "none"
            raise ValueError(f'there is no pose of the marker "{self.marker.name}", which takes a joint load; given: {known}')
        own, partner = self.marker.pose(poses[self.marker.name]), self.partner.pose(signals)
        force, moment = self.law.unit_wrench(self.end, (own, partner) if self.end == A else (partner, own))
        components = (force[0], force[1], moment[2]) if self.marker.is_planar else (*force, *moment)
        for place, component in zip(self.marker.load, components, strict=False):
            inputs[place] += signals[self.multiplier] * component

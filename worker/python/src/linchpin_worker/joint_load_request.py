"""The joint loads of a request."""

from __future__ import annotations

from collections.abc import Sequence

from ._contract import worker_pb2 as pb
from .description import Description
from .failures import CallFailed, misuse
from .joint_law import A, B, JointLaw, LawError, Reads
from .joint_load import JointLoad, LoadedMarker, Partner
from .marker import PLANAR, SPATIAL, Form, Marker
from .signals import Signals, find


def joint_loads_of(description: Description, request: pb.InitializeRequest, signals: Signals) -> list[JointLoad]:
    """The joint loads that a request asks for, checked."""
    asked = [name for name in ("joint_loads", "joint_inputs") if len(getattr(request, name))]
    if asked and not description.joint_loads:
        raise misuse(
            asked[0],
            f'the model "{description.name}" evaluates no joint loads (its capabilities do not say joint_loads); '
            "drive the load inputs of its markers with the forces and moments of the joint instead",
        )
    messages = enumerate(request.joint_loads)
    return [Reader(number, message, description, signals).joint_load() for number, message in messages]


class Reader:
    """Reads one message of the list."""

    def __init__(self, number: int, message: pb.JointLoad, description: Description, signals: Signals) -> None:
        self._number = number
        self._message = message
        self._description = description
        self._signals = signals

    def joint_load(self) -> JointLoad:
        """The load, with places among the input values of the subsystem."""
        message = self._message
        try:
            law = JointLaw.of_message(message)
        except LawError as error:
            raise self._misuse(error.field, str(error)) from error
        end = A if message.end == pb.JOINT_END_A else B
        marker, form = self._marker()
        self._check_marker(marker, form, law.acts(end), law.reads(end, end))
        if form is PLANAR:
            self._check_plane()
        (multiplier,) = self._places("multiplier", [message.multiplier])
        field = self._field("marker")
        load = find(self._description.inputs, marker.load, field)
        loaded = LoadedMarker(marker.name, form is PLANAR, len(marker.position), load)
        return JointLoad(loaded, law, end, multiplier, self._partner(form, law.reads(end, 1 - end)))

    def _marker(self) -> tuple[Marker, Form]:
        name, markers = self._message.marker, {marker.name: marker for marker in self._description.markers}
        if name not in markers:
            raise self._misuse("marker", f'the model has no marker "{name}"; it has: {", ".join(markers) or "none"}')
        forms = [form for form in (PLANAR, SPATIAL) if form.kind == markers[name].kind]
        if not forms:
            text = f'the marker "{name}" is neither planar nor spatial; only those take joint loads'
            raise self._misuse("marker", text)
        return markers[name], forms[0]

    def _check_marker(self, marker: Marker, form: Form, acts: tuple[bool, bool], own: Reads) -> None:
        """The marker must offer the own pose that the load depends on, and take the load."""
        point, whole = form.points
        for is_needed, what, names, needed in (
            (own.position, "position", marker.position, point),
            (own.rotation, "position", marker.position, whole),
            (acts[0], "load", marker.load, point),
            (acts[1], "load", marker.load, len(form.load)),
        ):
            if is_needed and len(names) < needed:
                length = f'the list {what} of the marker "{marker.name}" has the length {len(names)}'
                raise self._misuse("marker", f"{length}; this load needs {needed}")

    def _check_plane(self) -> None:
        for field in ("point_a", "point_b", "axis_a", "axis_b"):
            vector = getattr(self._message, field)
            if len(vector) == 3 and vector[2] != 0.0:
                raise self._misuse(field, f"its third component is {vector[2]}; on a planar marker it must be 0")

    def _partner(self, form: Form, reads: Reads) -> Partner:
        position, angles, attitude = (2, 1, 0) if form is PLANAR else (3, 3, 4)
        return Partner(
            self._list("partner_position", position, reads.position),
            self._list("partner_rotation", angles, reads.rotation),
            self._list("partner_attitude", attitude, reads.rotation and attitude > 0),
        )

    def _list(self, field: str, count: int, is_read: bool) -> Sequence[int]:
        """`count` places if the load depends on them. If not, they may be missing."""
        given = getattr(self._message, field)
        if len(given) != count and (is_read or len(given) > 0):
            allowed = f"this load needs {count}" if is_read else f"{count} or none are allowed"
            if count == 0:
                allowed = "it must be empty on a planar marker"
            raise self._misuse(field, f"the list has the length {len(given)}; {allowed}")
        found = self._places(field, given)
        return found if is_read else ()

    def _places(self, field: str, signals: Sequence[int]) -> list[int]:
        """Places among the input values of the subsystem."""
        places = []
        for signal in signals:
            place = self._signals.input(signal)
            if place is None:
                count = len(self._signals)
                text = f"there is no signal {signal}: inputs and joint_inputs list {count} (counted from 0)"
                raise self._misuse(field, text)
            places.append(place)
        return places

    def _misuse(self, field: str, message: str) -> CallFailed:
        place = self._field(field)
        return misuse(place, f"{place}: {message}")

    def _field(self, name: str) -> str:
        return f"joint_loads[{self._number}].{name}"

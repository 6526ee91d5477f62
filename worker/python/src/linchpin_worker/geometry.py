"""Rotations and wrenches in the conventions of the contract.

A rotation turns from the axes of a body to inertial ones. Quaternions are unit ones in the order `(w, x, y, z)`; `q` and `-q`
are the same rotation, and of the two the one with `w >= 0` is given here.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

Vector = tuple[float, float, float]
Matrix = tuple[Vector, Vector, Vector]
"""Rows of a matrix."""

Rows = Sequence[Sequence[float]]


def cross(a: Sequence[float], b: Sequence[float]) -> Vector:
    """The cross product of two vectors in space."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def turned(rotation: Rows, vector: Sequence[float]) -> Vector:
    """A vector of the body's axes in inertial ones: `rotation` times `vector`."""
    x, y, z = vector
    a, b, c = rotation
    return a[0] * x + a[1] * y + a[2] * z, b[0] * x + b[1] * y + b[2] * z, c[0] * x + c[1] * y + c[2] * z


def product(a: Rows, b: Rows) -> Matrix:
    """The matrix `a b`: first the rotation `b`, then `a`."""
    columns = [turned(a, [row[column] for row in b]) for column in range(3)]
    x, y, z = columns
    return (x[0], y[0], z[0]), (x[1], y[1], z[1]), (x[2], y[2], z[2])


def matrix_of_quaternion(quaternion: Sequence[float]) -> Matrix:
    """The rotation matrix of a quaternion `(w, x, y, z)`, whose length does not count."""
    length = math.sqrt(sum(part * part for part in quaternion))
    w, x, y, z = (part / length for part in quaternion)
    return (
        (w * w + x * x - y * y - z * z, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)),
        (2.0 * (x * y + w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z - w * x)),
        (2.0 * (x * z - w * y), 2.0 * (y * z + w * x), w * w - x * x - y * y + z * z),
    )


def quaternion_of_matrix(rotation: Rows) -> tuple[float, float, float, float]:
    """The unit quaternion `(w, x, y, z)`, `w >= 0`, of a rotation matrix (rows, from body to inertial axes).

    It is taken from the largest of its four parts, so that it is accurate for every angle (Shepperd's method).
    """
    (a, b, c), (d, e, f), (g, h, i) = rotation
    # Four times the square of each part.
    squares = (1.0 + a + e + i, 1.0 + a - e - i, 1.0 - a + e - i, 1.0 - a - e + i)
    largest = squares.index(max(squares))
    parts = (
        (squares[0], h - f, c - g, d - b),
        (h - f, squares[1], b + d, c + g),
        (c - g, b + d, squares[2], f + h),
        (d - b, c + g, f + h, squares[3]),
    )[largest]
    length = math.sqrt(sum(part * part for part in parts))
    sign = -1.0 if parts[0] < 0.0 else 1.0
    w, x, y, z = (sign * part / length for part in parts)
    return w, x, y, z


def matrix_of_rotation_vector(vector: Sequence[float]) -> Matrix:
    """The rotation about the direction of `vector` by its length (rad)."""
    angle = math.sqrt(sum(part * part for part in vector))
    # The sine over the angle, whose limit at 0 is the half.
    factor = math.sin(0.5 * angle) / angle if angle > 0.0 else 0.5
    return matrix_of_quaternion((math.cos(0.5 * angle), *(factor * part for part in vector)))


def wrench_about(
    centre: Sequence[float], point: Sequence[float], force: Sequence[float], moment: Sequence[float]
) -> tuple[Vector, Vector]:
    """Force (N) and moment (N m) about `centre` of a force at `point` and a moment about `point`.

    Positions in m, all in inertial axes: `moment + (point - centre) x force`. Solvers that take loads at the centre of mass
    get them so from those of a marker.
    """
    arm = [p - c for p, c in zip(point, centre, strict=True)]
    added = cross(arm, force)
    return (force[0], force[1], force[2]), (moment[0] + added[0], moment[1] + added[1], moment[2] + added[2])


def moment_about(centre: Sequence[float], point: Sequence[float], force: Sequence[float], moment: float) -> float:
    """In the plane: the moment (N m) about `centre` of a force `(fx, fy)` at `point` and a moment about `point`."""
    return moment + (point[0] - centre[0]) * force[1] - (point[1] - centre[1]) * force[0]

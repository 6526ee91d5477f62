"""A beam of circular section, clamped at one end, in finite elements of scikit-fem: its lowest modes of bending."""

from dataclasses import dataclass

import numpy as np
import scipy.linalg
from skfem import Basis, BilinearForm, ElementLineHermite, MeshLine
from skfem.helpers import dd, ddot

from linchpin_worker import Parameter, Refused

PARAMETERS = [
    Parameter("length", "m", above=0.0),
    Parameter("radius", "m", above=0.0),
    Parameter("elasticity", "Pa", above=0.0),
    Parameter("density", "kg/m^3", above=0.0),
    Parameter("damping", default=0.0, least=0.0, description="share of the critical damping, of every mode"),
    Parameter("gravity", "m/s^2", default=9.81),
    Parameter("elements", default=8, least=1),
    Parameter("modes", default=2, least=1, description="number of modes in each direction"),
]


@BilinearForm
def bending(u, v, _):
    return ddot(dd(u), dd(v))


@BilinearForm
def inertia(u, v, _):
    return u * v


@dataclass
class Beam:
    """Modes of mass 1, with the points of the elements at which their integrals are taken."""

    squares: np.ndarray
    """Of the circular frequencies (1/s^2)."""
    tip: np.ndarray
    """The deflection of each mode at the tip."""
    points: np.ndarray
    """Distances from the clamped end (m)."""
    masses: np.ndarray
    """Of the points (kg)."""
    shapes: np.ndarray
    """The deflections of all points, a column for each mode."""


def beam(setup):
    """The beam that the parameters of a scene ask for."""
    length, radius, elasticity, density = setup.numbers("length", "radius", "elasticity", "density")
    elements, modes = int(setup["elements"]), int(setup["modes"])
    if modes > 2 * elements:
        raise Refused("parameters.modes", f"{modes} is more than the {2 * elements} that {elements} elements have", " = ")
    basis = Basis(MeshLine(np.linspace(0.0, length, elements + 1)), ElementLineHermite())
    free = basis.complement_dofs(basis.get_dofs(lambda x: x[0] == 0.0))
    section = np.pi * radius**2
    stiffness = elasticity * section * radius**2 / 4 * bending.assemble(basis).toarray()[np.ix_(free, free)]
    mass = density * section * inertia.assemble(basis).toarray()[np.ix_(free, free)]
    squares, vectors = scipy.linalg.eigh(stiffness, mass, subset_by_index=[0, modes - 1])
    # A mode has either sign; a state that leaves its process is only understood where all choose the same.
    vectors *= np.sign(vectors[-2])
    whole = np.zeros((basis.N, modes))
    whole[free] = vectors
    shapes = np.stack([np.ravel(basis.interpolate(vector)) for vector in whole.T], axis=1)
    # Of a node come first its deflection and then its slope; the tip is the last one.
    points, masses = np.ravel(basis.global_coordinates()), density * section * np.ravel(basis.dx)
    return Beam(squares, vectors[-2], points, masses, shapes)

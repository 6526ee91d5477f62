"""A beam of finite elements, made by scikit-fem: python beam_worker.py --listen ADDRESS.

It stands out from a wall in the direction of x and bends in y and z; its deflections are small, its length stays.
"""

import numpy as np
import scipy.linalg
from skfem import Basis, BilinearForm, ElementLineHermite, LinearForm, MeshLine
from skfem.helpers import dd, ddot

from linchpin_worker import Description, Parameter, Refused, Subsystem, serve, spatial_marker

TIP = spatial_marker("tip", orientation=False)

# Gauss's collocation method of order 6: its nodes, the integrals of its polynomials up to each node, its weights.
NODES = 0.5 + np.sqrt(0.15) * np.array([-1.0, 0.0, 1.0])
COLLOCATION = NODES[:, None] ** [1, 2, 3] / [1, 2, 3] @ np.linalg.inv(np.vander(NODES, increasing=True))
WEIGHTS = np.array([5.0, 8.0, 5.0]) / 18.0


@BilinearForm
def bending(u, v, _):
    return ddot(dd(u), dd(v))


@BilinearForm
def inertia(u, v, _):
    return u * v


@LinearForm
def area(v, _):
    return v


class Beam(Subsystem):
    """The state has the lowest modes of bending and their rates, as rows, in y and z, as columns."""

    description = Description(
        name="beam",
        text="elastic beam of circular section on a wall, by scikit-fem",
        inputs=TIP.inputs,
        outputs=TIP.outputs,
        parameters=[
            Parameter("length", "m", above=0.0),
            Parameter("radius", "m", above=0.0),
            Parameter("elasticity", "Pa", above=0.0),
            Parameter("density", "kg/m^3", above=0.0),
            Parameter("damping", default=0.0, least=0.0, description="share of the critical damping, of every mode"),
            Parameter("gravity", "m/s^2", default=9.81),
            Parameter("elements", default=8.0, least=1.0),
            Parameter("modes", default=2.0, least=1.0, description="number of modes in each direction"),
        ],
        markers=[TIP],
        repeats_step_sequence=True,
    )

    def __init__(self, setup):
        self.length, radius, elasticity, density = setup.numbers("length", "radius", "elasticity", "density")
        elements, modes = int(setup["elements"]), int(setup["modes"])
        if modes > 2 * elements:
            raise Refused("parameters.modes", f"{modes} is more than the {2 * elements} that {elements} elements have", " = ")
        basis = Basis(MeshLine(np.linspace(0.0, self.length, elements + 1)), ElementLineHermite())
        free = basis.complement_dofs(basis.get_dofs(lambda x: x[0] == 0.0))
        section = np.pi * radius**2
        stiffness = elasticity * section * radius**2 / 4 * bending.assemble(basis).toarray()[np.ix_(free, free)]
        mass = density * section * inertia.assemble(basis).toarray()[np.ix_(free, free)]
        squares, shapes = scipy.linalg.eigh(stiffness, mass, subset_by_index=[0, modes - 1])
        # Of a node come first its deflection and then its slope; the tip is the last one.
        self.tip = shapes[-2]
        weight = density * section * area.assemble(basis)[free] @ shapes
        self.matrix = np.zeros((2 * modes, 2 * modes))
        self.matrix[:modes, modes:] = np.eye(modes)
        self.matrix[modes:, :modes] = -np.diag(squares)
        self.matrix[modes:, modes:] = -2.0 * setup["damping"] * np.diag(np.sqrt(squares))
        self.pull = np.concatenate([np.zeros(modes), self.tip])
        self.weight = np.outer(np.concatenate([np.zeros(modes), weight]), [0.0, -setup["gravity"]])
        # A twentieth of the shortest period.
        self.dt = 0.1 * np.pi / np.sqrt(squares[-1])
        self.state = np.zeros((2 * modes, 2))

    def slope(self, state, u):
        return self.matrix @ state + np.outer(self.pull, [u.tip_fy, u.tip_fz]) + self.weight

    def advance(self, t, step, u):
        size = len(self.matrix)
        for _, h, loads in u.stages(self.dt, NODES):
            slopes = np.concatenate([self.slope(self.state, load) for load in loads])
            implicit = np.eye(3 * size) - h * np.kron(COLLOCATION, self.matrix)
            stages = np.linalg.solve(implicit, slopes).reshape(3, size, 2)
            self.state = self.state + h * np.tensordot(WEIGHTS, stages, axes=1)
            self.internal_steps += 1

    def outputs(self, t, u):
        (position, velocity), (_, acceleration) = (
            self.tip @ np.reshape(rows, (2, -1, 2)) for rows in (self.state, self.slope(self.state, u))
        )
        return [self.length, *position, 0.0, *velocity, 0.0, *acceleration]

    def save(self):
        return self.state

    def load(self, state):
        self.state = state


if __name__ == "__main__":
    serve(Beam)

"""A beam of finite elements, made by scikit-fem: python beam_worker.py --listen ADDRESS.

It stands out from a wall in the direction of x and bends in y and z; its deflections are small, its length stays.
"""

import numpy as np
from beam_elements import PARAMETERS, beam

from linchpin_worker import Description, Subsystem, serve, spatial_marker

TIP = spatial_marker("tip", orientation=False)

# Gauss's collocation method of order 6: its nodes, the integrals of its polynomials up to each node, its weights.
NODES = 0.5 + np.sqrt(0.15) * np.array([-1.0, 0.0, 1.0])
COLLOCATION = NODES[:, None] ** [1, 2, 3] / [1, 2, 3] @ np.linalg.inv(np.vander(NODES, increasing=True))
WEIGHTS = np.array([5.0, 8.0, 5.0]) / 18.0


class WallBeam(Subsystem):
    """The state has the lowest modes of bending and their rates, as rows, in y and z, as columns."""

    description = Description(
        name="beam",
        text="elastic beam of circular section on a wall, by scikit-fem",
        inputs=TIP.inputs,
        outputs=TIP.outputs,
        parameters=PARAMETERS,
        markers=[TIP],
        repeats_step_sequence=True,
        exportable_snapshot=True,
    )

    def __init__(self, setup):
        modal, self.length = beam(setup), setup["length"]
        self.tip, squares, modes = modal.tip, modal.squares, len(modal.squares)
        weight = modal.masses @ modal.shapes
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
    serve(WallBeam)

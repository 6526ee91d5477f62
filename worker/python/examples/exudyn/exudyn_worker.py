"""A body in space, integrated by Exudyn: python exudyn_worker.py --listen ADDRESS.

For a system of your own put its items in `build`, and name the places where joints hold in MARKERS.
"""

import exudyn as exu
import numpy as np
from exudyn.itemInterface import Force, MarkerBodyRigid, Torque
from exudyn.utilities import RigidBodyInertia

from linchpin_worker import Description, Parameter, Solver, StepFailed, Subsystem, quaternion_of_matrix, serve, spatial_marker

MARKERS = [spatial_marker("start"), spatial_marker("end")]
INERTIA = [Parameter("m", "kg", above=0.0), *(Parameter(f"j{axis}", "kg m^2", above=0.0) for axis in (1, 2, 3))]
STARTS = ("x0", "y0", "z0", "vx0", "vy0", "vz0", "omega1_0", "omega2_0", "omega3_0")
POINTS = [f"{marker.name}_{axis}" for marker in MARKERS for axis in "xyz"]
SEEN = [
    getattr(exu.OutputVariableType, name)
    for name in ("Position", "RotationMatrix", "Velocity", "AngularVelocity", "Acceleration", "AngularAcceleration")
]
OPTIONS = [Parameter("dt", "s", default=1e-3, above=0.0, description="longest internal step")]


class Body(Subsystem):
    """The state is the one that Exudyn keeps as the initial values of its next run."""

    description = Description(
        name="exudyn-body",
        text=f"Exudyn {exu.__version__}: free rigid body in space, with the parameters of the built-in spatial-body",
        inputs=[variable for marker in MARKERS for variable in marker.inputs],
        outputs=[variable for marker in MARKERS for variable in marker.outputs],
        parameters=[*INERTIA, Parameter("gravity", "m/s^2", default=9.81)]
        + [Parameter(name, default=0.0) for name in (*POINTS, *STARTS)],
        solvers=[Solver("RK67", options=OPTIONS), Solver("RK44", options=OPTIONS)],
        markers=MARKERS,
        repeats_step_sequence=True,
        exportable_snapshot=True,
    )

    def __init__(self, setup):
        # The system is removed with its container.
        self.container = exu.SystemContainer()
        self.system = self.container.AddSystem()
        self.build(setup)
        self.system.Assemble()
        self.solver, self.dt = getattr(exu.DynamicSolverType, setup.solver), setup.options["dt"]
        self.settings = exu.SimulationSettings()
        self.settings.solution.file.write = False
        self.settings.timeIntegration.verboseMode = 0

    def build(self, setup):
        """Makes the body, with a force and a moment at every marker."""
        position, velocity, omega = np.reshape(setup.numbers(*STARTS), (3, 3))
        mass, *moments = setup.numbers("m", "j1", "j2", "j3")
        self.body = self.system.CreateRigidBody(
            inertia=RigidBodyInertia(mass, np.diag(moments)),
            nodeType=exu.NodeType.RotationRotationVector,
            referencePosition=position,
            initialVelocity=velocity,
            initialAngularVelocity=omega,
            gravity=[0.0, 0.0, -setup["gravity"]],
        )
        self.points = np.reshape(setup.numbers(*POINTS), (-1, 3))
        for place, point in enumerate(self.points):
            marker = self.system.AddMarker(MarkerBodyRigid(bodyNumber=self.body, localPosition=point))
            for load, first in ((Force, 6 * place), (Torque, 6 * place + 3)):
                self.system.AddLoad(load(markerNumber=marker, loadVectorUserFunction=self.reader(first)))

    def reader(self, first):
        """What Exudyn calls at every stage: three of the loads at the time `t`."""
        return lambda system, t, vector: self.loads(t)[first : first + 3]

    def solve(self, start, end, steps, loads, is_kept):
        """Runs Exudyn over a time under `loads`, a function of the time."""
        time = self.settings.timeIntegration
        time.startTime, time.endTime, time.numberOfSteps, self.loads = start, end, steps, loads
        try:
            self.system.SolveDynamic(self.settings, solverType=self.solver, updateInitialValues=is_kept, showHints=False)
        except (RuntimeError, ValueError) as error:
            raise StepFailed(f"Exudyn: {error}", start) from error

    def advance(self, t, step, u):
        steps = len(list(u.stages(self.dt, nodes=())))
        self.solve(t, t + step, steps, lambda time: u(time - t), is_kept=True)
        self.internal_steps += steps

    def outputs(self, t, u):
        # A run of no length: the accelerations are those under the loads at `t`.
        self.solve(t, t, 1, lambda _: u, is_kept=False)
        told = []
        for point in self.points:
            position, rotation, *rates = (self.system.GetObjectOutputBody(self.body, kind, point) for kind in SEEN)
            told += [*position, *quaternion_of_matrix(np.reshape(rotation, (3, 3))), *np.ravel(rates)]
        return told

    def save(self):
        return self.system.systemData.GetSystemState(exu.ConfigurationType.Initial)

    def load(self, state):
        self.system.systemData.SetSystemState(state, configuration=exu.ConfigurationType.Initial)


if __name__ == "__main__":
    serve(Body)

"""Any model of MuJoCo as a worker: python mujoco_worker.py MODEL.xml --listen ADDRESS.

Every site on a moving body is a spatial marker, every hinge and slide has its position and velocity as outputs and as
parameters. Choose integrator="RK4" in the MJCF: it has order 4, the default of MuJoCo order 1.
"""

import copy
import pathlib
import sys
import threading

import mujoco
import numpy as np

from linchpin_worker import Description, Parameter, Subsystem, Variable, quaternion_of_matrix, serve, spatial_marker

NO_PASSIVE_FORCES = mujoco.mjtDisableBit.mjDSBL_SPRING | mujoco.mjtDisableBit.mjDSBL_DAMPER

STATE = mujoco.mjtState.mjSTATE_INTEGRATION
"""All that decides about a step; the start values of the constraint solver, which are those of the last step, included."""

UNITS = {int(mujoco.mjtJoint.mjJNT_HINGE): ("rad", "rad/s"), int(mujoco.mjtJoint.mjJNT_SLIDE): ("m", "m/s")}

# MuJoCo has one callback for all models, while each instance steps on a thread of its own.
stepping = threading.local()


def apply_loads(model, data):
    mechanism = getattr(stepping, "mechanism", None)
    if mechanism is not None:
        mechanism.apply_loads(data)


class Mechanism(Subsystem):
    """A model of MuJoCo. Its loads are evaluated at every stage of the integrator, by the callback for passive forces."""

    compiled = None

    def __init__(self, setup):
        self.model = copy.copy(self.compiled)
        # Values that are not finite shall fail the step, not set the model back to its start.
        self.model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_AUTORESET
        self.dt = self.model.opt.timestep
        has_gravity = not self.model.opt.disableflags & mujoco.mjtDisableBit.mjDSBL_GRAVITY
        self.gravity = has_gravity * self.model.opt.gravity
        self.is_staged = self.model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4
        self.sites, self.joints = sites(self.model), joints(self.model)
        self.data, self.seen = mujoco.MjData(self.model), mujoco.MjData(self.model)
        self.data.time = setup.t_start
        for joint in self.joints:
            self.data.qpos[joint.qposadr[0]] = setup[joint.name]
            self.data.qvel[joint.dofadr[0]] = setup[f"{joint.name}_rate"]

    def apply_loads(self, data):
        """Adds the loads at the time of `data`, at the places where the sites are now."""
        loads = self.loads(data.time)
        for place, site in enumerate(self.sites):
            load = np.array(loads[6 * place : 6 * place + 6])
            point, body = data.site_xpos[site.id], self.model.site_bodyid[site.id]
            mujoco.mj_applyFT(self.model, data, load[:3], load[3:], point, body, data.qfrc_passive)

    def under(self, loads, act, data):
        """Calls a function of MuJoCo under `loads`, a function of the time."""
        self.loads, stepping.mechanism = loads, self
        try:
            act(self.model, data)
        finally:
            stepping.mechanism = None

    def advance(self, t, step, u):
        for tau, h, _ in u.stages(self.dt, nodes=()):
            self.model.opt.timestep, self.data.time = h, t + tau
            # An integrator without stages takes one load for its step: that of the middle.
            later = 0.0 if self.is_staged else h / 2
            self.under(lambda time, later=later: u(time - t + later), mujoco.mj_step, self.data)
            self.internal_steps += 1

    def outputs(self, t, u):
        model, seen = self.model, self.seen
        mujoco.mj_copyState(model, self.data, seen, STATE)
        self.under(lambda _: u, mujoco.mj_forward, seen)
        mujoco.mj_rnePostConstraint(model, seen)
        told = []
        for site in self.sites:
            velocity, acceleration = np.zeros(6), np.zeros(6)
            mujoco.mj_objectVelocity(model, seen, mujoco.mjtObj.mjOBJ_SITE, site.id, velocity, 0)
            mujoco.mj_objectAcceleration(model, seen, mujoco.mjtObj.mjOBJ_SITE, site.id, acceleration, 0)
            # MuJoCo has rotations first, and gives the acceleration that a sensor feels.
            told += [*seen.site_xpos[site.id], *quaternion_of_matrix(seen.site_xmat[site.id].reshape(3, 3))]
            told += [*velocity[3:], *velocity[:3], *(acceleration[3:] + self.gravity), *acceleration[:3]]
        for joint in self.joints:
            told += [seen.qpos[joint.qposadr[0]], seen.qvel[joint.dofadr[0]]]
        return told

    def save(self):
        state = np.empty(mujoco.mj_stateSize(self.model, STATE))
        mujoco.mj_getState(self.model, self.data, state, STATE)
        return state

    def load(self, state):
        mujoco.mj_setState(self.model, self.data, state, STATE)


def sites(model):
    """The sites on bodies that move."""
    return [model.site(site) for site in range(model.nsite) if model.body_weldid[model.site_bodyid[site]] != 0]


def joints(model):
    """The hinges and slides that have a name."""
    scalar = (model.joint(joint) for joint in range(model.njnt) if model.jnt_type[joint] in UNITS)
    return [joint for joint in scalar if joint.name]


def mechanism(file):
    """The class of the model in a file."""
    try:
        model = mujoco.MjModel.from_xml_path(file)
    except ValueError as error:
        sys.exit(f"error: {file}: {error}")
    if model.opt.disableflags & NO_PASSIVE_FORCES == NO_PASSIVE_FORCES:
        sys.exit(
            f"error: {file}: spring and damper are both disabled, so MuJoCo skips the callback that applies the loads; enable "
            "one of them and set stiffness and damping to 0"
        )
    markers = [spatial_marker(site.name or f"site{site.id}") for site in sites(model)]
    outputs, parameters = [], []
    for joint in joints(model):
        position, rate = UNITS[joint.type[0]]
        outputs += [Variable(joint.name, position), Variable(f"{joint.name}_rate", rate)]
        parameters += [Parameter(joint.name, position, default=float(model.qpos0[joint.qposadr[0]]))]
        parameters += [Parameter(f"{joint.name}_rate", rate, default=0.0)]
    description = Description(
        name=pathlib.Path(file).stem,
        text=f"MuJoCo {mujoco.__version__}: {pathlib.Path(file).name}",
        inputs=[variable for marker in markers for variable in marker.inputs],
        outputs=[*(variable for marker in markers for variable in marker.outputs), *outputs],
        parameters=parameters,
        markers=markers,
        repeats_step_sequence=True,
        exportable_snapshot=True,
    )
    return type("Model", (Mechanism,), {"description": description, "compiled": model})


if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit("error: the first argument is the MJCF file of the model, as in: python mujoco_worker.py arm.xml")
    model = mechanism(sys.argv[1])
    # Only now: the compiler of MJCF does not get on with a callback.
    mujoco.set_mjcb_passive(apply_loads)
    serve(model, arguments=sys.argv[2:])

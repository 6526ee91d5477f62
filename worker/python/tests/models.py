"""Models with known answers, also for the suite that all workers pass: python models.py --listen ADDRESS."""

import math
import time

from linchpin_worker import (
    Description,
    Marker,
    Parameter,
    Refused,
    Solver,
    StepFailed,
    Subsystem,
    Variable,
    scalar_marker,
    serve,
)
from linchpin_worker._contract import worker_pb2 as pb

START, LEAK = 0.375, 0.21


class Tank(Subsystem):
    """`level' = inflow - leak`, with a solver that can fail: above `capacity` as one that may succeed with a smaller step.

    Every step sleeps for `pause` seconds. The output `repeated` is 1 after a step that repeated internal steps, otherwise 0.
    """

    description = Description(
        "tank",
        inputs=[Variable("inflow", "m/s"), Variable("leak", "m/s", default=LEAK)],
        outputs=[Variable("level", "m"), Variable("rate", "m/s"), Variable("repeated")],
        parameters=[Parameter("capacity", "m", above=0.0), Parameter("pause", "s", default=0.0, least=0.0)],
    )

    def __init__(self, setup):
        self.capacity, self.pause = setup.numbers("capacity", "pause")
        self.level, self.repeated = START, 0.0

    def advance(self, t, step, u):
        time.sleep(self.pause)
        self.internal_steps += 1
        self.repeated = 0.0
        for name, sign in (("inflow", 1.0), ("leak", -1.0)):
            mean = sum(power / (n + 1) for n, power in enumerate(u.polynomial(name).powers(step)))
            self.level += sign * mean * step
        if self.level < 0.0:
            raise RuntimeError("the tank is empty")
        if self.level > self.capacity:
            raise StepFailed(f"the tank overflows: {self.level} m", t + step)

    def advance_perturbed(self, t, step, u):
        self.advance(t, step, u)
        self.repeated = 1.0

    def outputs(self, t, u):
        return self.level, u.inflow - u.leak, self.repeated

    def save(self):
        return self.level

    def load(self, state):
        self.level = state


class Oscillator(Subsystem):
    """`m a = f - c x - d v + partner_stiffness (partner_x - x) + partner_damping (partner_v - v)`.

    Both solvers expand the motion in powers of time: "exact" over parts that are short beside the period, "rk4" over parts of
    the length `step`, up to the fourth power. "radau5" is the exact one and says a tolerance.
    """

    description = Description(
        "oscillator",
        inputs=[Variable(name, unit, default=0.0) for name, unit in (("f", "N"), ("partner_x", "m"), ("partner_v", "m/s"))],
        outputs=[Variable("x", "m"), Variable("v", "m/s"), Variable("a", "m/s^2")],
        parameters=[
            Parameter("m", "kg", above=0.0),
            *(Parameter(name, default=0.0) for name in ("c", "d", "x0", "v0", "partner_stiffness", "partner_damping")),
        ],
        solvers=[
            Solver("exact"),
            Solver("radau5", options=[Parameter(name, default=1e-8, above=0.0) for name in ("rtol", "atol")]),
            Solver("rk4", options=[Parameter("step", "s", above=0.0)]),
        ],
        markers=[scalar_marker("mass", "x", "v", "a", "f")],
        states={"x": "x0", "v": "v0"},
        repeats_step_sequence=True,
        directional_derivatives=True,
        exportable_snapshot=True,
        output_integrals=True,
        impulses=True,
    )

    def __init__(self, setup):
        self.m, c, d, self.x, self.v = setup.numbers("m", "c", "d", "x0", "v0")
        self.partner = setup.numbers("partner_stiffness", "partner_damping")
        self.c, self.d = c + self.partner[0], d + self.partner[1]
        self.tolerance = setup.options.get("rtol")
        self.step, self.terms = setup.options.get("step"), 4 if setup.solver == "rk4" else 20

    def end(self, step, u, x, v):
        parts = math.ceil(step / self.step if self.step else step * max(math.sqrt(self.c / self.m), self.d / self.m))
        h = step / max(1, parts)
        factors = {"f": 1.0, "partner_x": self.partner[0], "partner_v": self.partner[1]}
        for part in range(max(1, parts)):
            self.internal_steps += 1
            loads = [0.0] * max(self.terms, 8)
            for name, factor in factors.items():
                for n, power in enumerate(u.polynomial(name).shifted(part * h).powers(h)):
                    loads[n] += factor * power
            xs, ws = [x], [h * v]
            for n in range(self.terms):
                load = loads[n] - self.c * xs[n]
                xs.append(ws[n] / (n + 1))
                ws.append((h * h * load - h * self.d * ws[n]) / self.m / (n + 1))
            self.integrate(part * h, h, u, xs, ws)
            x, v = sum(xs), v + sum(ws[1:]) / h
        return x, v

    def integrate(self, start, h, u, xs, ws):
        def inside(sigma):
            x, w = (sum(power * (sigma / h) ** n for n, power in enumerate(powers)) for powers in (xs, ws))
            return self.told(x, w / h, u(start + sigma))

        self.integrals.add_along(start, h, max(self.terms, 7), inside)

    def impulse(self, t, u, impulses):
        self.v += impulses.f / self.m

    def told(self, x, v, u):
        load = u.f + self.partner[0] * u.partner_x + self.partner[1] * u.partner_v
        return x, v, (load - self.c * x - self.d * v) / self.m

    def advance(self, t, step, u):
        self.x, self.v = self.end(step, u, self.x, self.v)

    def derivative(self, t, step, u, direction):
        state = self.end(step, direction, 0.0, 0.0) if step > 0.0 else (0.0, 0.0)
        return self.told(*state, direction.at_end)

    def outputs(self, t, u):
        return self.told(self.x, self.v, u)

    def save(self):
        return self.x, self.v

    def load(self, state):
        self.x, self.v = state


IN_PLANE, IN_SPACE = ("x", "y", "angle"), ("x", "y", "z", "qw", "qx", "qy", "qz")
PLANAR_LOAD, SPATIAL_LOAD = ("fx", "fy", "moment"), ("fx", "fy", "fz", "mx", "my", "mz")
MARKERS = {
    "planar": (pb.MARKER_KIND_PLANAR, IN_PLANE, PLANAR_LOAD),
    "planar-point": (pb.MARKER_KIND_PLANAR, IN_PLANE[:2], PLANAR_LOAD),
    "planar-pushed": (pb.MARKER_KIND_PLANAR, IN_PLANE, PLANAR_LOAD[:2]),
    "planar-watched": (pb.MARKER_KIND_PLANAR, IN_PLANE, ()),
    "spatial": (pb.MARKER_KIND_SPATIAL, IN_SPACE, SPATIAL_LOAD),
    "spatial-point": (pb.MARKER_KIND_SPATIAL, IN_SPACE[:3], SPATIAL_LOAD),
    "spatial-pushed": (pb.MARKER_KIND_SPATIAL, IN_SPACE, SPATIAL_LOAD[:3]),
    "placeless": (pb.MARKER_KIND_PLANAR, (), PLANAR_LOAD),
    "scalar": (pb.MARKER_KIND_SCALAR, ("x",), ("fx",)),
}


class Stand(Subsystem):
    """A marker that does not move, and the impulse of what acts on it; `marker` says of which kind it is, `pose` where."""

    description = Description(
        "stand",
        parameters=[Parameter("marker", kind=str), Parameter("pose", kind=list)],
        joint_loads=True,
    )

    @classmethod
    def described(cls, parameters):
        name = parameters.get("marker")
        if (name is None and "marker" in parameters) or not isinstance(name, str | None):
            raise Refused("parameters.marker", "it must be a text")
        if name is None:
            raise Refused("parameters.marker", "missing; the model needs it as a text")
        if name not in MARKERS:
            raise Refused("parameters.marker", f'"{name}" is unknown; known: {", ".join(MARKERS)}')
        kind, position, load = MARKERS[name]
        ends = ("total", "impulse")
        return Description(
            "stand",
            inputs=[Variable(name, default=0.0) for name in load],
            outputs=[Variable(name) for name in (*position, *(f"{name}_{end}" for end in ends for name in load))],
            parameters=cls.description.parameters,
            markers=[Marker("foot", kind, position, load=load)],
            joint_loads=True,
        )

    def __init__(self, setup):
        _, position, load = MARKERS[setup.parameters["marker"]]
        self.pose = setup.parameters["pose"]
        if len(self.pose) != len(position):
            raise Refused("parameters.pose", "it must be as many numbers as the marker's position has")
        self.impulse = [0.0] * len(load)

    def load_at(self, u):
        return u.with_joint_loads({"foot": self.pose})

    def advance(self, t, step, u):
        """Simpson's rule: exact for loads up to the third power of time."""
        for part, weight in ((0.0, 1.0), (0.5, 4.0), (1.0, 1.0)):
            for place, load in enumerate(self.load_at(u(part * step))):
                self.impulse[place] += weight * step / 6.0 * load

    def outputs(self, t, u):
        return [*self.pose, *self.load_at(u), *self.impulse]

    def save(self):
        return self.impulse

    def load(self, state):
        self.impulse = state


class Faulty(Subsystem):
    """A model whose every method does what the text parameter `fault` says, for the tests of what a master is told."""

    description = Description(
        "faulty",
        inputs=[Variable("f", "N", default=0.0)],
        outputs=[Variable("x", "m"), Variable("v", "m/s")],
        parameters=[Parameter("fault", kind=str)],
        max_input_degree=1,
    )

    def __init__(self, setup):
        self.fault = setup.parameters["fault"]
        self.x = 0.0
        if self.fault == "setup":
            raise KeyError("no geometry")

    def advance(self, t, step, u):
        self.x += step
        match self.fault:
            case "failed":
                raise StepFailed("no convergence", t + 0.5 * step)
            case "failed without time":
                raise StepFailed("no convergence")
            case "overflow":
                self.x = math.exp(1e6)
            case "error":
                raise LookupError("no such element")
            case "silent error":
                raise RuntimeError
            case "exit":
                raise SystemExit(3)
            case "nan":
                self.x = math.nan

    def outputs(self, t, u):
        match self.fault:
            case "short":
                return [self.x]
            case "text":
                return [self.x, "fast"]
            case "named":
                return {"x": self.x, "v": 1.0}
            case "misnamed":
                return {"x": self.x, "w": 1.0}
            case "infinite start":
                return [math.inf, 1.0]
        return [self.x, 1.0]

    def save(self):
        if self.fault == "unsaved":
            return lambda: self.x
        return self.x

    def load(self, state):
        if self.fault == "lost":
            raise StepFailed("the state is gone")
        self.x = state


if __name__ == "__main__":
    serve(Tank, Oscillator, Stand)

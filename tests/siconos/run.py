#!/usr/bin/python3
"""A second opinion on impacts and friction: small mechanisms integrated by Siconos with the Moreau-Jean scheme.

Siconos (Debian: python3-siconos) imports with /usr/bin/python3 only. Equations of motion and contact relations are in
contact.c, which is compiled when a run starts. The result is one JSON object on the standard output:

    scheme             name, theta, solver (of contact problems), tolerance, newton_tolerance
    problem, parameters, dt, steps, coordinates
    samples            t, q, v, energy, gaps, forces (per contact: normal and tangential impulse of the step over dt)
    impacts            t, contacts (from 1), before, after (normal velocities), impulses (normal)
    impact_count       steps in which a contact closes faster than the threshold: length of "impacts"
    first_impact       t of the first of them, or null
    max_penetration    largest negative gap at the end of a step
    energy_loss        energy at the start less energy at the end
    solver             calls and failures of the contact solver, newton_iterations, newton_failures (steps)
    seconds_per_step   time per step spent inside Siconos; recording and output are not in it

A contact takes part in a step that starts with gap + dt/2 * gap velocity <= 0. The time of an impact is the start of
its step: the contact that the scheme foresees is within dt/2 of it. The energy contains the potential of the weight and
of a constant torque. Units: m, kg, s, rad. The scheme is of first order: compare energies in the limit dt -> 0, and
impacts above a threshold only, because the end of a series of impacts depends on dt.

Exit code: 0; 1 when a contact problem was not solved or a Newton loop did not converge (the result is written all the
same); 2 for wrong arguments; 3 when the plugin does not compile or Siconos is not there.
"""

import argparse
import contextlib
import ctypes
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # the matrices have a handful of rows

SOURCE = pathlib.Path(__file__).resolve().with_name("contact.c")


# Problems ------------------------------------------------------------------------------------------------------------


class Problem:
    """What run.py has to know of a problem of contact.c.

    model     prefix of its functions in contact.c
    contacts  number of contacts
    solver    contact solver unless another one is asked for
    defaults  parameters; those named in contact.c go there, the others are used here
    start     parameters -> coordinates and velocities
    """

    def __init__(self, text, model, coordinates, contacts, solver, defaults, start, force_jacobians=False):
        self.text = text
        self.model = model
        self.coordinates = coordinates
        self.contacts = contacts
        self.solver = solver
        self.defaults = defaults
        self.start = start
        self.force_jacobians = force_jacobians

    def parameters(self, settings):
        parameters = dict(self.defaults)
        for key, value in settings:
            if key not in parameters:
                raise ValueError(f"unknown parameter {key!r}, there are: {' '.join(parameters)}")
            parameters[key] = value
        if "J" in parameters and parameters["J"] == 0.0:
            parameters["J"] = parameters["m"] * (parameters["b"] ** 2 + parameters["h"] ** 2) / 3.0
        return parameters


def start_ball(p):
    return [p["h0"]], [p["v0"]]


def start_on_slope(p):
    return [0.0, p["h"], 0.0], [p["v0"], 0.0, 0.0]


def start_on_corner(p):
    """Tilted by phi0 about one corner, which touches the floor: corner 1 for phi0 >= 0, otherwise corner 2."""
    phi, omega = p["phi0"], p["omega0"]
    side = -1.0 if phi >= 0.0 else 1.0
    rx = -side * p["b"] * math.cos(phi) - p["h"] * math.sin(phi)
    ry = -side * p["b"] * math.sin(phi) + p["h"] * math.cos(phi)
    return [side * p["b"] + rx, ry, phi], [-omega * ry, omega * rx, omega]


def start_crank(p):
    return [p["theta1"], p["theta2"], p["theta3"]], [p["omega1"], p["omega2"], p["omega3"]]


CRANK = {
    "l1": 0.153, "l2": 0.306, "a": 0.05, "b": 0.025, "c": 0.001,
    "m1": 0.038, "m2": 0.038, "m3": 0.076, "J1": 7.4e-5, "J2": 5.9e-4, "J3": 2.7e-6,
    "g": 9.81, "torque": 0.0, "eps": 0.4, "mu": 0.01,
    "theta1": 0.0, "theta2": 0.0, "theta3": 0.0, "omega1": 150.0, "omega2": -75.0, "omega3": 0.0,
}  # fmt: skip
CRANK_DRIVEN = dict(CRANK, c=0.0005, torque=1.0, eps=0.1, mu=0.1, omega1=0.0, omega2=0.0)
ANGLES = ["theta1", "theta2", "theta3"]

# Which solver: enum is exact for the slider-crank, where nsgs stalls at a relative residual of 1e-8, which tilts the
# slider, and lemke fails at a few impacts. For the block with large friction enum takes nearly singular matrices for
# regular ones and returns wrong impulses; nsgs and, mostly, lemke solve these problems. Every such failure is counted.
PROBLEMS = {
    "ball": Problem(
        "ball falling on a floor from the height h0 with the velocity v0, upwards positive; one contact, no friction",
        "ball", ["y"], 1, "lemke",
        {"m": 1.3, "g": 9.81, "h0": 0.83, "v0": 0.0, "eps": 0.73},
        start_ball,
    ),
    "incline": Problem(
        "block 2 b x 2 h on a slope (rad), starts with v0 downwards; mu < b / h, or it tips while it slides",
        "block", ["x", "y", "phi"], 2, "nsgs",
        {"b": 0.11, "h": 0.07, "m": 2.3, "J": 0.0, "g": 9.81, "slope": 0.4, "mu": 0.3, "eps": 0.0, "v0": 0.57},
        start_on_slope,
    ),
    "rocking": Problem(
        "block 2 b x 2 h released on one corner at the angle phi0 with the angular velocity omega0",
        "block", ["x", "y", "phi"], 2, "nsgs",
        {"b": 0.09, "h": 0.31, "m": 1.7, "J": 0.0, "g": 9.81, "slope": 0.0, "mu": 1.4, "eps": 0.0, "phi0": 0.12,
         "omega0": 0.0},
        start_on_corner,
    ),
    "slider-crank-1": Problem(
        "rigid slider-crank with clearance, parameters of Table 1 (free, light friction)",
        "crank", ANGLES, 4, "enum", CRANK, start_crank, force_jacobians=True,
    ),
    "slider-crank-2": Problem(
        "rigid slider-crank with clearance, parameters of Table 2 (driven from rest)",
        "crank", ANGLES, 4, "enum", CRANK_DRIVEN, start_crank, force_jacobians=True,
    ),
}  # fmt: skip


# Plugin --------------------------------------------------------------------------------------------------------------


class Plugin:
    """contact.c, compiled and loaded. Siconos opens the same file, so both see the same variables."""

    def __init__(self, folder):
        target = pathlib.Path(folder) / "contact.so"
        if not target.exists() or target.stat().st_mtime <= SOURCE.stat().st_mtime:
            target.parent.mkdir(parents=True, exist_ok=True)
            fresh = target.with_suffix(f".{os.getpid()}.so")  # renamed at the end: runs may share the folder
            command = [os.environ.get("CC", "cc"), "-O2", "-shared", "-fPIC", "-std=c11", "-o", str(fresh), str(SOURCE)]
            subprocess.run(command + ["-lm"], check=True)
            fresh.replace(target)
        self.path = str(target.with_suffix(""))  # Siconos appends .so
        self.library = ctypes.CDLL(str(target))

    def set_parameters(self, model, values):
        names = ctypes.c_char_p.in_dll(self.library, f"{model}_parameters").value.decode().split()
        (ctypes.c_double * len(names)).in_dll(self.library, model)[:] = [values[name] for name in names]

    def variable(self, kind, name):
        return kind.in_dll(self.library, name)

    def energy(self, model, q, v):
        size = len(q)
        vector = ctypes.c_double * size
        coordinates, mass = vector(*q), (ctypes.c_double * size**2)()
        self.library[f"{model}_mass"](ctypes.c_uint(size), coordinates, mass, ctypes.c_uint(0), None)
        potential = self.library[f"{model}_potential"]
        potential.restype = ctypes.c_double
        kinetic = sum(v[i] * mass[i + size * j] * v[j] for i in range(size) for j in range(size)) / 2.0
        return kinetic + potential(coordinates)


# Integration ---------------------------------------------------------------------------------------------------------


class Integration:
    """One system with its contacts under the Moreau-Jean scheme."""

    def __init__(self, problem, parameters, plugin, options):
        import siconos.kernel as kernel
        import siconos.numerics as numerics

        self.problem = problem
        self.plugin = plugin
        plugin.set_parameters(problem.model, parameters)
        model, path = problem.model, plugin.path

        self.body = kernel.LagrangianDS(*problem.start(parameters))
        self.body.setComputeMassFunction(path, f"{model}_mass")
        self.body.setComputeFIntFunction(path, f"{model}_force")
        if problem.force_jacobians:
            self.body.setComputeJacobianFIntqFunction(path, f"{model}_force_dq")
            self.body.setComputeJacobianFIntqDotFunction(path, f"{model}_force_dv")

        # No restitution along the tangent: with a plane contact Siconos 4.4 writes past the end of a vector for it.
        friction = "mu" in parameters
        if friction:
            law = kernel.NewtonImpactFrictionNSL(parameters["eps"], 0.0, parameters["mu"], 2)
        else:
            law = kernel.NewtonImpactNSL(parameters["eps"])

        # One step more than needed, so that rounding of the final time cannot take the last step away.
        system = kernel.NonSmoothDynamicalSystem(0.0, (options.steps + 1) * options.dt)
        system.insertDynamicalSystem(self.body)
        self.contacts = []
        for k in range(1, problem.contacts + 1):
            relation = kernel.LagrangianScleronomousR(f"{path}:{model}_gap_{k}", f"{path}:{model}_jacobian_{k}")
            contact = kernel.Interaction(law, relation)
            system.link(contact, self.body)
            self.contacts.append(contact)

        if friction:
            number = getattr(numerics, f"SICONOS_FRICTION_2D_{options.solver.upper()}")
            self.impulses = kernel.FrictionContact(2, number)
        else:
            self.impulses = kernel.LCP(numerics.SICONOS_LCP_LEMKE)
        solver = self.impulses.numericsSolverOptions()
        solver.dparam[numerics.SICONOS_DPARAM_TOL] = options.tolerance
        if options.solver == "nsgs":
            solver.iparam[numerics.SICONOS_IPARAM_MAX_ITER] = 100_000

        scheme = kernel.MoreauJeanOSI(options.theta)
        clock = kernel.TimeDiscretisation(0.0, options.dt)
        self.simulation = kernel.TimeStepping(system, clock, scheme, self.impulses)
        self.simulation.setNewtonTolerance(options.newton_tolerance)
        self.simulation.setNewtonMaxIteration(50)
        self.simulation.setWarnOnNonConvergence(False)  # counted below

        # The counter of contact.c takes the place of the warning. Siconos does not hand setCheckSolverFunction to
        # Python in a usable form; the method does not touch its object, hence the null pointer.
        residual = solver.dparam[numerics.SICONOS_DPARAM_RESIDU :]
        residual[0] = 0.0
        plugin.variable(ctypes.c_void_p, "solver_residual").value = residual.ctypes.data if friction else None
        plugin.variable(ctypes.c_double, "solver_tolerance").value = options.tolerance
        for counter in ("solver_calls", "solver_failures"):
            plugin.variable(ctypes.c_long, counter).value = 0
        method = "_ZN12TimeStepping22setCheckSolverFunctionEPFviP10SimulationE"
        install = ctypes.CDLL(kernel._kernel.__file__)[method]
        install(None, ctypes.cast(plugin.library.count_solver_call, ctypes.c_void_p))

        self.simulation.initialize()
        self.simulation.updateOutput()  # gaps at the start
        self.simulation.updateIndexSets()  # otherwise the first step misses a contact that is closed at the start
        # Views of the vectors of Siconos, valid from here on.
        self.q, self.v = self.body.q(), self.body.velocity()
        self.gaps = [contact.y(0) for contact in self.contacts]
        self.velocities = [contact.y(1) for contact in self.contacts]
        self.multipliers = [contact.lambda_(1) for contact in self.contacts]  # impulses of a step

    def sample(self, t, dt):
        q, v = self.q.tolist(), self.v.tolist()
        return {
            "t": t,
            "q": q,
            "v": v,
            "energy": self.plugin.energy(self.problem.model, q, v),
            "gaps": [float(gap[0]) for gap in self.gaps],
            "forces": [(multiplier / dt).tolist() for multiplier in self.multipliers],
        }

    def run(self, dt, steps, sampled, threshold):
        simulation, clock = self.simulation, time.perf_counter
        velocities, gaps, multipliers = self.velocities, self.gaps, self.multipliers
        samples, impacts = [self.sample(0.0, dt)], []
        seconds, penetration, newton_failures = 0.0, 0.0, 0
        for step in range(1, steps + 1):
            before = [float(velocity[0]) for velocity in velocities]
            start = clock()
            simulation.computeOneStep()
            seconds += clock() - start
            newton_failures += not simulation.isNewtonConverge()
            penetration = max(penetration, -min(gap[0] for gap in gaps))
            struck = [k for k, u in enumerate(before) if u < -threshold and multipliers[k][0] > 0.0]
            if struck:
                impacts.append({
                    "t": (step - 1) * dt,
                    "contacts": [k + 1 for k in struck],
                    "before": [before[k] for k in struck],
                    "after": [float(velocities[k][0]) for k in struck],
                    "impulses": [float(multipliers[k][0]) for k in struck],
                })  # fmt: skip
            if step in sampled:
                samples.append(self.sample(step * dt, dt))
            start = clock()
            simulation.nextStep()
            seconds += clock() - start
        return {
            "samples": samples,
            "impacts": impacts,
            "impact_count": len(impacts),
            "first_impact": impacts[0]["t"] if impacts else None,
            "max_penetration": float(penetration),
            "energy_loss": samples[0]["energy"] - samples[-1]["energy"],
            "solver": self.verdict(steps, newton_failures),
            "seconds_per_step": seconds / steps,
        }

    def verdict(self, steps, newton_failures):
        calls = self.plugin.variable(ctypes.c_long, "solver_calls").value
        if calls < steps:
            raise RuntimeError(f"only {calls} contact problems seen in {steps} steps: their failures were not counted")
        failures = self.plugin.variable(ctypes.c_long, "solver_failures").value
        return {
            "calls": calls,
            "failures": failures,
            "newton_iterations": self.simulation.getNewtonCumulativeNbIterations(),
            "newton_failures": newton_failures,
        }


@contextlib.contextmanager
def output_to_stderr():
    """Siconos prints to the standard output, which is for the result."""
    sys.stdout.flush()
    saved = os.dup(1)
    os.dup2(2, 1)
    try:
        yield
    finally:
        ctypes.CDLL(None).fflush(None)
        os.dup2(saved, 1)
        os.close(saved)


# Command line --------------------------------------------------------------------------------------------------------


def setting(text):
    key, separator, value = text.partition("=")
    if not separator:
        raise argparse.ArgumentTypeError(f"expected key=value, not {text!r}")
    try:
        return key, float(value)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{value!r} is not a number") from None


def positive(text):
    value = float(text)
    if not (0.0 < value < math.inf):
        raise argparse.ArgumentTypeError(f"{text} is not a positive number")
    return value


def arguments(argv):
    lines = ["problems and their parameters:"]
    for name, problem in PROBLEMS.items():
        values = " ".join(f"{key}={value:g}" for key, value in problem.defaults.items())
        lines += ["", f"  {name}: {problem.text}", f"    {values}"]
    lines += ["", "J = 0 stands for a homogeneous block: J = m (b^2 + h^2) / 3."]
    parser = argparse.ArgumentParser(
        description=__doc__, epilog="\n".join(lines), formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("problem", choices=PROBLEMS, metavar="PROBLEM", help=" | ".join(PROBLEMS))
    parser.add_argument("--dt", type=positive, default=1e-5, help="step size (1e-5)")
    parser.add_argument("--t-end", type=positive, default=0.05, help="final time, a multiple of the step size (0.05)")
    parser.add_argument("--samples", type=int, default=50, help="samples after the start, at equal distances (50)")
    parser.add_argument("--set", type=setting, action="append", default=[], metavar="KEY=VALUE", dest="settings",
                        help="set a parameter of the problem; may be repeated")  # fmt: skip
    parser.add_argument("--threshold", type=float, default=0.01, help="slowest impact to record, in m/s (0.01)")
    parser.add_argument("--theta", type=positive, default=0.5, help="theta of the Moreau-Jean scheme (0.5)")
    parser.add_argument("--solver", choices=("enum", "lemke", "nsgs"),
                        help="solver of contact problems with friction (the most reliable one for the problem); "
                        "without friction always lemke")  # fmt: skip
    parser.add_argument("--tolerance", type=positive, default=1e-12, help="of the contact solver (1e-12)")
    parser.add_argument("--newton-tolerance", type=positive, default=1e-13, help="of a step's residual in N s (1e-13)")
    parser.add_argument("--build-dir", help="folder for the compiled plugin, kept for further runs (temporary)")
    parser.add_argument("--json", metavar="OUT", help="write the result to this file, not to the standard output")
    options = parser.parse_args(argv)

    if options.solver is None or "mu" not in PROBLEMS[options.problem].defaults:
        options.solver = PROBLEMS[options.problem].solver
    options.steps = round(options.t_end / options.dt)
    if options.steps < 1 or abs(options.steps * options.dt - options.t_end) > 1e-9 * options.t_end:
        parser.error("--t-end is not a multiple of --dt")
    if not 1 <= options.samples <= options.steps:
        parser.error(f"--samples must be in 1 .. {options.steps}, the number of steps")
    try:
        options.parameters = PROBLEMS[options.problem].parameters(options.settings)
    except ValueError as error:
        parser.error(str(error))
    return options


def main(argv=None):
    options = arguments(argv)
    problem = PROBLEMS[options.problem]
    sampled = {round(k * options.steps / options.samples) for k in range(1, options.samples + 1)}
    try:
        import siconos
        import siconos.kernel  # noqa: F401
    except ImportError as error:
        print(f"run.py: {error}: install python3-siconos and start with /usr/bin/python3", file=sys.stderr)
        return 3
    with contextlib.ExitStack() as stack:
        folder = options.build_dir or stack.enter_context(tempfile.TemporaryDirectory())
        try:
            plugin = Plugin(folder)
        except (OSError, subprocess.CalledProcessError) as error:
            print(f"run.py: contact.c: {error}", file=sys.stderr)
            return 3
        with output_to_stderr():
            integration = Integration(problem, options.parameters, plugin, options)
            outcome = integration.run(options.dt, options.steps, sampled, options.threshold)
    result = {
        "scheme": {
            "name": "Moreau-Jean",
            "theta": options.theta,
            "solver": options.solver,
            "tolerance": options.tolerance,
            "newton_tolerance": options.newton_tolerance,
        },
        "problem": options.problem,
        "parameters": options.parameters,
        "dt": options.dt,
        "steps": options.steps,
        "coordinates": problem.coordinates,
        **outcome,
    }
    text = json.dumps(result, indent=1, allow_nan=False)
    if options.json:
        pathlib.Path(options.json).write_text(text + "\n")
    else:
        print(text)
    failures = outcome["solver"]["failures"] + outcome["solver"]["newton_failures"]
    if failures:
        print(f"run.py: {failures} contact problems or Newton loops without a solution", file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())

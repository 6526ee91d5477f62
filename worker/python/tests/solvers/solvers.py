"""Solvers of others: their examples, and the scenes of these."""

import csv
import importlib
import importlib.util
import os
import pathlib
import sys
import tempfile
import unittest

from linchpin_worker._contract import worker_pb2 as pb
from linchpin_worker.inputs import Inputs, values_type
from linchpin_worker.polynomial import Polynomial
from linchpin_worker.setup import setup_of

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "runs"))

from linchpin import EXAMPLES, PACKAGE, PROGRAM, linchpin

__all__ = ["EXAMPLES", "PACKAGE", "PROGRAM", "linchpin"]

# The workers are other processes.
os.environ["PYTHONPATH"] = str(PACKAGE / "src")


def needed(*modules):
    """Skips a test where a solver is not installed, and says how to have it."""
    missing = [module for module in modules if importlib.util.find_spec(module) is None]
    return unittest.skipIf(missing, f"not installed: {', '.join(missing)}; to have it: bash tests/python/add.sh solvers")


def example(solver, module):
    """The module of an example."""
    # As a program sees the files beside it.
    sys.path.insert(0, str(EXAMPLES / solver))
    try:
        return importlib.import_module(module)
    finally:
        sys.path.pop(0)


def results(solver, scene, *settings):
    """The columns of a scene of an example, by their names."""
    sets = [word for setting in settings for word in ("--set", setting)]
    with tempfile.TemporaryDirectory() as out:
        linchpin("run", scene, "--out", out, "--no-plots", "--quiet", *sets, folder=EXAMPLES / solver)
        with open(f"{out}/results.csv", newline="") as table:
            rows = list(csv.reader(table))
    return {name: [float(row[place]) for row in rows[1:]] for place, name in enumerate(rows[0])}


def opening(columns, joint):
    """The largest distance of the two points of a joint along an axis (m)."""
    return max(max(map(abs, columns[f"{joint}.residual.position.{axis}"])) for axis in "xyz")


def made(model, **parameters):
    """An instance of a model, outside of a server."""
    given = {name: pb.Value(number=value) for name, value in parameters.items()}
    return model(setup_of(model.description, pb.InitializeRequest(parameters=given)))


def inputs(model, step, **values):
    """The inputs of a step: a value at its start and one at its end for each name, on a line between them."""
    names = [variable.name for variable in model.description.inputs]
    lines = [Polynomial.through([0.0, step], list(values.get(name, (0.0, 0.0)))) for name in names]
    return Inputs(lines, step, values_type(names, 0, ()), names)


def assert_rates(test, model, marker, load, h=1e-4, limit=1e-5, **parameters):
    """Velocity and acceleration of a spatial marker are differences of its position and velocity, under a constant load."""
    body, rows = made(model, **parameters), []
    u = inputs(model, h, **load)
    names = [variable.name for variable in model.description.outputs]
    for step in range(3):
        rows.append(dict(zip(names, body.outputs(step * h, u.at_end), strict=True)))
        body.advance(step * h, h, u)

    def rate(name):
        return (rows[2][f"{marker}_{name}"] - rows[0][f"{marker}_{name}"]) / (2 * h)

    middle = {name.removeprefix(f"{marker}_"): value for name, value in rows[1].items()}
    for axis in "xyz":
        for order, base in ((f"v{axis}", axis), (f"a{axis}", f"v{axis}"), (f"alpha_{axis}", f"omega_{axis}")):
            test.assertAlmostEqual(rate(base), middle[order], delta=limit * max(1.0, abs(middle[order])), msg=order)
    # The rate of a quaternion is half the product of the angular velocity and the quaternion.
    w, x, y, z = (middle[f"q{part}"] for part in "wxyz")
    a, b, c = (middle[f"omega_{axis}"] for axis in "xyz")
    turning = (-a * x - b * y - c * z, a * w + b * z - c * y, b * w + c * x - a * z, c * w + a * y - b * x)
    for part, expected in zip("wxyz", turning, strict=True):
        test.assertAlmostEqual(rate(f"q{part}"), 0.5 * expected, delta=limit * max(1.0, abs(expected)))
    test.assertGreater(sum(abs(rate(f"v{axis}")) for axis in "xyz"), 0.1, "nothing moves")

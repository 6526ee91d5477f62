"""Parameters and options as a scene gives them and as a constructor finds them."""

import unittest

from linchpin_worker import Description, Parameter, Refused, Solver
from linchpin_worker._contract import worker_pb2 as pb
from linchpin_worker.setup import setup_of

DESCRIPTION = Description(
    "own",
    parameters=[
        Parameter("m", "kg", above=0.0, most=10.0),
        Parameter("restitution", default=0.5, least=0.0, below=1.0, description="of Newton"),
        Parameter("mesh", kind=str),
        Parameter("is_fixed", kind=bool),
        Parameter("nodes", kind=list),
    ],
    solvers=[Solver("rk4", "fixed steps", [Parameter("dt", "s", default=1e-3, above=0.0)]), Solver("exact")],
)
GIVEN = {
    "m": pb.Value(number=2.0),
    "mesh": pb.Value(text="beam"),
    "is_fixed": pb.Value(flag=True),
    "nodes": pb.Value(numbers=pb.NumberList(values=[1.0, 2.5])),
}


def setup(solver=None, **changes):
    return setup_of(DESCRIPTION, pb.InitializeRequest(parameters={**GIVEN, **changes}, solver=solver, t_start=0.25))


class Setups(unittest.TestCase):
    def test_values_have_the_declared_kinds(self):
        found = setup()
        expected = {"m": 2.0, "restitution": 0.5, "mesh": "beam", "is_fixed": True, "nodes": [1.0, 2.5]}
        self.assertEqual(found.parameters, expected)
        self.assertEqual((found.t_start, found["m"], found.numbers("restitution", "m")), (0.25, 2.0, [0.5, 2.0]))

    def test_a_default_may_be_a_whole_number(self):
        description = Description("own", parameters=[Parameter("elements", default=8)])
        self.assertEqual(setup_of(description, pb.InitializeRequest()).numbers("elements"), [8.0])

    def test_only_numbers_are_read_as_numbers(self):
        with self.assertRaisesRegex(TypeError, r"parameter mesh is no number; take setup.parameters\['mesh'\]"):
            setup().numbers("m", "mesh")

    def test_the_first_solver_is_the_default(self):
        found = setup()
        self.assertEqual((found.solver, found.options), ("rk4", {"dt": 1e-3}))
        found = setup(pb.Solver(kind="rk4", options={"dt": pb.Value(number=1e-4)}))
        self.assertEqual(found.options, {"dt": 1e-4})
        found = setup(pb.Solver(kind="exact"))
        self.assertEqual((found.solver, found.options), ("exact", {}))

    def test_limits_are_told(self):
        for changes, words in (
            ({"m": 0.0}, "parameters.m = 0 is out of range: it must be greater than 0 and at most 10"),
            ({"m": 10.5}, "parameters.m = 10.5 is out of range"),
            ({"restitution": 1.0}, "parameters.restitution = 1 is out of range: it must be at least 0 and less than 1"),
            ({"restitution": -1e-9}, "parameters.restitution = -1e-09 is out of range"),
        ):
            with self.assertRaisesRegex(Refused, words) as caught:
                setup(**{name: pb.Value(number=value) for name, value in changes.items()})
            self.assertEqual(caught.exception.field, f"parameters.{next(iter(changes))}")
        self.assertEqual(setup(m=pb.Value(number=10.0), restitution=pb.Value(number=0.0))["m"], 10.0)

    def test_limits_stand_in_the_description(self):
        described = {parameter.name: parameter for parameter in DESCRIPTION.message().parameters}
        self.assertEqual(described["m"].description, "greater than 0 and at most 10")
        self.assertEqual(described["restitution"].description, "of Newton; at least 0 and less than 1")
        self.assertFalse(described["m"].HasField("default"))
        self.assertEqual(described["restitution"].default, 0.5)

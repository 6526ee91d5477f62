"""Descriptions that contradict themselves are refused where they are written."""

import math
import unittest

from models import Tank

from linchpin_worker import (
    Description,
    DescriptionError,
    Host,
    Marker,
    Parameter,
    Solver,
    Subsystem,
    Variable,
    planar_marker,
    scalar_marker,
    spatial_marker,
)
from linchpin_worker._contract import worker_pb2 as pb

X, F = Variable("x", "m"), Variable("f", "N", default=0.0)


class Mistakes(unittest.TestCase):
    def test_each_is_named(self):
        spatial = pb.MARKER_KIND_SPATIAL
        for fields, words in (
            ({"name": ""}, "a model needs a name"),
            ({"inputs": [F, F]}, 'two inputs have the name "f"'),
            ({"outputs": [X, X]}, 'two outputs have the name "x"'),
            ({"outputs": [X, Variable("")]}, "output number 1 has no name"),
            ({"parameters": [Parameter("m"), Parameter("m")]}, 'two parameters have the name "m"'),
            ({"solvers": [Solver("rk4"), Solver("rk4")]}, 'two solvers have the name "rk4"'),
            ({"markers": [scalar_marker("tip", "x")] * 2, "outputs": [X]}, 'two markers have the name "tip"'),
            ({"markers": [scalar_marker("tip", "y")], "outputs": [X]}, 'marker "tip": position names the output "y".* has: x'),
            ({"markers": [scalar_marker("tip", "x", load="g")], "outputs": [X], "inputs": [F]}, 'input "g".* has: f'),
            ({"markers": [Marker("tip", spatial, ["x"])], "outputs": [X]}, "position has the length 1; .* are 0, 3, 7"),
            ({"states": {"x": "x0"}, "outputs": [X]}, 'states names the parameter "x0"; the model has: none'),
            ({"states": {"y": "x0"}, "outputs": [X]}, 'states names the output "y"; the model has: x'),
            ({"max_input_degree": 8}, "max_input_degree = 8: it must be from 0 to 7"),
            ({"inputs": [Variable("f", default=math.nan)]}, 'default of the input "f" is nan'),
        ):
            with self.subTest(words=words), self.assertRaisesRegex(DescriptionError, words):
                Description(**{"name": "own", **fields})

    def test_parameters_have_known_kinds_and_only_numbers_have_defaults(self):
        with self.assertRaisesRegex(ValueError, "float, str, bool or list"):
            Parameter("m", kind=int)
        with self.assertRaisesRegex(ValueError, "only numbers can have a default"):
            Parameter("name", kind=str, default=1.0)

    def test_a_model_needs_its_methods(self):
        class Bare(Subsystem):
            description = Description("bare")

            def advance(self, t, step, u):
                pass

        class Undescribed(Subsystem):
            pass

        for models, words in (
            ([Bare], 'model "bare": Bare has no method outputs'),
            ([Undescribed], "Undescribed has no description"),
            ([Tank, Tank], 'two models have the name "tank"'),
            ([], "at least one model"),
        ):
            with self.assertRaisesRegex(DescriptionError, words):
                Host(*models)

    def test_directional_derivatives_need_their_method(self):
        class Linear(Tank):
            description = Description("linear", directional_derivatives=True)

        with self.assertRaisesRegex(DescriptionError, "Linear has no method derivative"):
            Host(Linear)


class Markers(unittest.TestCase):
    def test_a_planar_marker_has_the_names_of_built_in_ones(self):
        marker = planar_marker("end")
        self.assertEqual(marker.kind, pb.MARKER_KIND_PLANAR)
        self.assertEqual(marker.position, ["end_x", "end_y", "end_angle"])
        self.assertEqual(marker.velocity, ["end_vx", "end_vy", "end_rate"])
        self.assertEqual(marker.acceleration, ["end_ax", "end_ay", "end_alpha"])
        self.assertEqual(marker.load, ["end_fx", "end_fy", "end_moment"])
        self.assertEqual([own.unit for own in marker.outputs[:3]], ["m", "m", "rad"])
        self.assertEqual([own.default for own in marker.inputs], [0.0] * 3)

    def test_a_spatial_marker_has_the_names_of_built_in_ones(self):
        marker = spatial_marker("end")
        names = [own.name.removeprefix("end_") for own in marker.outputs]
        position, velocity, acceleration = names[:7], names[7:13], names[13:]
        self.assertEqual(position, ["x", "y", "z", "qw", "qx", "qy", "qz"])
        self.assertEqual(velocity, ["vx", "vy", "vz", "omega_x", "omega_y", "omega_z"])
        self.assertEqual(acceleration, ["ax", "ay", "az", "alpha_x", "alpha_y", "alpha_z"])
        self.assertEqual(marker.load, [f"end_{name}" for name in ("fx", "fy", "fz", "moment_x", "moment_y", "moment_z")])

    def test_parts_that_are_not_offered_are_absent(self):
        marker = spatial_marker("end", orientation=False, velocity=False)
        self.assertEqual([len(names) for _, names, _ in marker.lists()], [3, 0, 3, 3])
        Description("own", inputs=marker.inputs, outputs=marker.outputs, markers=[marker])
        marker = planar_marker("end", acceleration=False, load=False)
        self.assertEqual([len(names) for _, names, _ in marker.lists()], [3, 3, 0, 0])
        Description("own", inputs=marker.inputs, outputs=marker.outputs, markers=[marker])

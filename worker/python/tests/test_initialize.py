"""Describe and Initialize."""

import math

from models import LEAK
from peer import PROTOCOL, RAMP, WorkerTest, constant, initialize, number, oscillator, tank

from linchpin_worker._contract import worker_pb2 as pb


class Initializing(WorkerTest):
    def test_describe_tells_models_and_capabilities(self):
        reply = self.peer.call("Describe", pb.DescribeRequest(protocol=PROTOCOL))
        self.assertEqual(reply.protocol, PROTOCOL)
        described = {model.name: model for model in reply.models}
        self.assertEqual(list(described), ["tank", "oscillator", "stand"])
        self.assertEqual(
            described["oscillator"].capabilities,
            pb.Capabilities(
                exchange=True,
                repeats_step_sequence=True,
                max_input_degree=7,
                directional_derivatives=True,
                interior_outputs=True,
                exportable_snapshot=True,
                output_integrals=True,
                impulses=True,
            ),
        )
        self.assertEqual([one.name for one in described["oscillator"].solvers], ["exact", "radau5", "rk4"])
        self.assertEqual(described["oscillator"].states[1], pb.StateVariable(output="v", initial="v0"))
        self.assertFalse(described["tank"].inputs[0].HasField("default"))
        self.assertEqual(described["tank"].inputs[1].default, LEAK)
        self.assertEqual(described["tank"].parameters[0].description, "greater than 0")

    def test_a_named_model_is_described_with_its_parameters(self):
        parameters = {"marker": pb.Value(text="spatial")}
        reply = self.peer.call("Describe", pb.DescribeRequest(protocol=PROTOCOL, model="stand", parameters=parameters))
        (model,) = reply.models
        self.assertEqual(model.markers[0].kind, pb.MARKER_KIND_SPATIAL)
        self.assertEqual(len(model.outputs), 19)
        for parameters, field in (({}, "parameters.marker"), ({"marker": pb.Value(text="round")}, "parameters.marker")):
            request = pb.DescribeRequest(protocol=PROTOCOL, model="stand", parameters=parameters)
            self.assert_misuse(field, lambda request=request: self.peer.call("Describe", request))
        unknown = pb.DescribeRequest(protocol=PROTOCOL, model="clockwork")
        self.assert_misuse("model", lambda: self.peer.call("Describe", unknown), "clockwork", "tank, oscillator, stand")

    def test_every_mistake_in_initialize_is_named(self):
        text, numbers = pb.Value(text="heavy"), pb.Value(numbers=pb.NumberList(values=[1.0]))
        marker = {"marker": pb.Value(text="planar"), "pose": numbers}
        own = dict(oscillator().parameters)
        for request, field, words in (
            (initialize(model="clockwork"), "model", ["clockwork", "tank, oscillator, stand"]),
            (tank(protocol=pb.ProtocolVersion(major=2, minor=5)), "protocol", ["1.4", "2.5"]),
            (initialize(protocol=None, model="tank"), "protocol", ["no version"]),
            (oscillator(parameters={**own, "mass": number(1.0)}), "parameters.mass", ["m, c, d, x0"]),
            (oscillator(parameters={**own, "m": number(-1.25)}), "parameters.m", ["-1.25", "greater than 0"]),
            (oscillator(parameters={**own, "c": number(math.nan)}), "parameters.c", ["NaN", "finite"]),
            (oscillator(parameters={**own, "d": text}), "parameters.d", ["a number"]),
            (oscillator(parameters={**own, "d": pb.Value(flag=True)}), "parameters.d", ["a number"]),
            (oscillator(parameters={**own, "d": pb.Value()}), "parameters.d", ["a number"]),
            (oscillator(parameters={}), "parameters.m", ["missing", "a number"]),
            (oscillator(solver=pb.Solver(kind="euler")), "solver.kind", ["euler", "exact, radau5, rk4"]),
            (tank(solver=pb.Solver(kind="euler")), "solver.kind", ["euler", "none"]),
            (tank(solver=pb.Solver(options={"dt": number(1.0)})), "solver.dt", ["none"]),
            (oscillator(solver=pb.Solver(kind="rk4")), "solver.step", ["missing"]),
            (oscillator(solver=pb.Solver(kind="radau5", options={"rtoll": number(1.0)})), "solver.rtoll", ["rtol, atol"]),
            (oscillator(solver=pb.Solver(kind="radau5", options={"atol": number(0.0)})), "solver.atol", ["greater"]),
            (oscillator(t_start=-math.inf), "t_start", ["-inf", "finite"]),
            (oscillator(inputs=["f", "force"]), "inputs", ["force", "f, partner_x"]),
            (oscillator(inputs=["f", "f"]), "inputs", ["f", "twice"]),
            (tank(inputs=["leak"]), "inputs", ["inflow", "driven"]),
            (oscillator(coupling_outputs=["y"]), "coupling_outputs", ["y", "x, v, a"]),
            (oscillator(recorded_outputs=["y"]), "recorded_outputs", ["y", "x, v, a"]),
            (oscillator(interior_outputs=["y"]), "interior_outputs", ["y", "x, v, a"]),
            (tank(integrated_outputs=["level"]), "integrated_outputs", ["tank", "output_integrals"]),
            (oscillator(joint_inputs=["lambda"]), "joint_inputs", ["forces and moments"]),
            (oscillator(joint_loads=[pb.JointLoad()]), "joint_loads", ["forces and moments"]),
            (initialize(model="stand", parameters={**marker, "marker": numbers}), "parameters.marker", ["a text"]),
            (initialize(model="stand", parameters={**marker, "pose": text}), "parameters.pose", ["a list of numbers"]),
            (initialize(model="stand", parameters=marker), "parameters.pose", ["as many numbers"]),
            (
                initialize(
                    model="stand", parameters={**marker, "pose": pb.Value(numbers=pb.NumberList(values=[0.0, math.inf]))}
                ),
                "parameters.pose[1]",
                ["inf", "finite"],
            ),
        ):
            with self.subTest(field=field, words=words):
                self.assert_misuse(field, lambda request=request: self.peer.call("Initialize", request), *words)
        self.assert_no_instance(lambda: self.peer.call("Step", pb.StepRequest(instance=5)), 5)
        self.assertEqual(len(self.peer.call("ListInstances", pb.ListInstancesRequest()).instances), 0)

    def test_defaults_and_tolerances(self):
        bare = oscillator(parameters={"m": number(2.0)})
        driver = self.drive(bare)
        self.assertEqual(driver.values("x", "v", "a", signals=[constant(0, 3.0)]), [0.0, 0.0, 1.5])
        self.assertFalse(driver.initialized.HasField("tolerance"))
        adaptive = oscillator(instance=6, solver=pb.Solver(kind="radau5"))
        self.assertEqual(self.drive(adaptive).initialized.tolerance, 1e-8)

    def test_initialize_may_be_repeated_until_the_next_call(self):
        driver = self.drive()
        self.assertEqual(self.peer.call("Initialize", tank()), driver.initialized)
        again = lambda request: lambda: self.peer.call("Initialize", request)
        self.assert_misuse("instance", again(tank(t_start=0.5)), "0x5", "exists")
        driver.step(0.0, 0.3, *RAMP)
        self.assert_misuse("instance", again(tank()), "0x5", "exists")

    def test_terminate_ends_an_instance_once_and_again(self):
        driver = self.drive()
        for _ in range(2):
            self.assertEqual(self.peer.call("Terminate", pb.TerminateRequest(instance=5)).instance, 5)
        self.assert_no_instance(lambda: driver.step(0.0, 0.3, *RAMP), 5)
        self.assert_no_instance(driver.exchange, 5)

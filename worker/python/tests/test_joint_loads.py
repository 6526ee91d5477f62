"""Joint loads, as tests/tests/sdk/joint_loads.rs has them: what a subsystem is given, and every mistake of a request."""

import math

from peer import Driver, Peer, PeerTest, constant, initialize, through

from linchpin_worker._contract import worker_pb2 as pb
from linchpin_worker.inputs import values_type
from linchpin_worker.joint_law import A, JointLaw, Pose
from linchpin_worker.joint_load import JointLoad, LoadedMarker, Partner

OWN, NORMAL, POINT = (0.3, -0.7, 1.1), (0.6, -0.8), (0.4, 0.25)
GIVEN = (13.0, 7.0, 2.9, 1.7, 0.4, -0.8)
LOADS = ("fx_total", "fy_total", "moment_total")


def numbers(*values):
    return pb.Value(numbers=pb.NumberList(values=values))


def in_plane(**changes):
    """The load of end b of an inplane condition: signal 2 is the multiplier, 3 to 5 the partner's pose."""
    fields = {
        "marker": "foot",
        "law": pb.JOINT_LAW_INPLANE,
        "end": pb.JOINT_END_B,
        "point_a": [*POINT, 0.0],
        "point_b": [-0.5, 0.9, 0.0],
        "axis_b": [*NORMAL, 0.0],
        "multiplier": 2,
        "partner_position": [3, 4],
        "partner_rotation": [5],
    }
    return pb.JointLoad(**{**fields, **changes})


def stand(load=None, *, marker="planar", pose=OWN, **changes):
    fields = {
        "model": "stand",
        "parameters": {"marker": pb.Value(text=marker), "pose": numbers(*pose)},
        "inputs": ["moment", "fx"],
        "coupling_outputs": LOADS,
        "recorded_outputs": [name.replace("total", "impulse") for name in LOADS],
        "joint_inputs": ["lambda", "partner_x", "partner_y", "partner_angle"],
        "joint_loads": [load or in_plane()],
    }
    return initialize(**{**fields, **changes})


def expected(multiplier, x, y, angle):
    """`fx, fy, moment` of the load on the stand: the law once more."""

    def turned(vector, angle):
        cos, sin = math.cos(angle), math.sin(angle)
        return vector[0] * cos - vector[1] * sin, vector[0] * sin + vector[1] * cos

    normal, point = turned(NORMAL, OWN[2]), turned(POINT, angle)
    arm = x + point[0] - OWN[0], y + point[1] - OWN[1]
    moment = arm[0] * normal[1] - arm[1] * normal[0]
    return [-multiplier * part for part in (*normal, moment)]


def signals(values=GIVEN):
    return [constant(place, value) for place, value in enumerate(values)]


class Loads(PeerTest):
    def setUp(self):
        self.peer = Peer(self)

    def assert_near(self, found, values):
        for own, other in zip(found, values, strict=True):
            self.assertAlmostEqual(own, other, delta=1e-13 * (1.0 + abs(other)))

    def test_places_of_joint_inputs_follow_those_of_driven_inputs(self):
        fx, fy, moment = expected(2.9, 1.7, 0.4, -0.8)
        driver = Driver(self.peer, stand())
        self.assert_near(driver.values(*LOADS, signals=signals()), [fx + 7.0, fy, moment + 13.0])

    def test_a_driven_input_can_be_the_multiplier(self):
        fx, fy, moment = expected(7.0, 1.7, 0.4, -0.8)
        driver = Driver(self.peer, stand(in_plane(multiplier=1)))
        self.assert_near(driver.values(*LOADS, signals=signals()), [fx + 7.0, fy, moment + 13.0])

    def test_impulses_follow_the_polynomials_of_joint_inputs(self):
        step, given = 0.7, signals((0.0, 0.0, 0.0, 0.0, 0.4, -0.8))
        multiplier, x = lambda t: 2.9 - 3.0 * t + 11.0 * t * t, lambda t: 1.7 - 4.0 * t
        given[2] = through(2, *((t, multiplier(t)) for t in (step, 0.0, -step)))
        given[3] = through(3, *((t, x(t)) for t in (step, 0.0)))
        start, middle, end = (expected(multiplier(t), x(t), 0.4, -0.8) for t in (0.0, 0.5 * step, step))
        impulses = [step / 6.0 * (a + 4.0 * b + c) for a, b, c in zip(start, middle, end, strict=True)]
        driver = Driver(self.peer, stand())
        self.assert_near(driver.step(0.0, step, *given, outputs=pb.OUTPUT_SET_ALL), [*end, *impulses])

    def test_perturbed_joint_inputs_are_those_of_the_steps_that_they_stand_for(self):
        driver = Driver(self.peer, stand(coupling_outputs=["fx_impulse", "moment_impulse"]))
        perturbed = [through(place, (0.3, value + 0.1), (0.0, value)) for place, value in enumerate(GIVEN)]
        start = driver.snapshot()
        columns = driver.perturbed(0.0, 0.3, signals(), perturbed=perturbed).outputs
        for place, column in enumerate(columns):
            given = signals()
            given[place] = perturbed[place]
            self.assertEqual(driver.step(0.0, 0.3, *given), list(column.values))
            driver.restore(start)

    def test_a_joint_input_needs_a_signal(self):
        driver = Driver(self.peer, stand())
        self.assert_misuse("signals", lambda: driver.step(0.0, 0.3, *signals()[:5]), "partner_angle")

    def test_joint_inputs_without_a_load_are_passed_over(self):
        driver = Driver(self.peer, stand(joint_loads=[]))
        self.assert_near(driver.values(*LOADS, signals=signals()), [7.0, 0.0, 13.0])

    def test_a_load_in_space_is_the_one_in_the_plane(self):
        """About the third axis: the partner's rotation vector follows on its attitude, a turn of a quarter."""
        fx, fy, moment = expected(2.9, 1.7, 0.4, -0.8)
        half, turn = 0.5 * OWN[2], -0.8 - 0.5 * math.pi
        quarter = math.sqrt(0.5)
        load = in_plane(partner_position=[1, 2, 3], partner_rotation=[4, 5, 6], partner_attitude=[7, 8, 9, 10], multiplier=0)
        pose = (*OWN[:2], 0.0, math.cos(half), 0.0, 0.0, math.sin(half))
        names = ["lambda", *(f"partner_{number}" for number in range(10))]
        wanted = ["fx_total", "fy_total", "fz_total", "mx_total", "my_total", "mz_total"]
        request = stand(
            load,
            marker="spatial",
            pose=pose,
            inputs=[],
            joint_inputs=names,
            coupling_outputs=wanted,
            recorded_outputs=[],
        )
        given = signals((2.9, 1.7, 0.4, 0.0, 0.0, 0.0, turn, quarter, 0.0, 0.0, quarter))
        driver = Driver(self.peer, request)
        self.assert_near(driver.values(*wanted, signals=given), [fx, fy, 0.0, 0.0, 0.0, moment])

    def test_every_mistake_of_a_request_is_named(self):
        place = "joint_loads[0]"
        in_space = (0.3, -0.7, 0.2, 1.0, 0.0, 0.0, 0.0)
        for request, field, words in (
            (stand(in_plane(law=9)), f"{place}.law", ["law 9", "2 (inplane)"]),
            (stand(in_plane(end=0)), f"{place}.end", ["end 0", "1 (a) and 2 (b)"]),
            (stand(in_plane(axis_b=[0.5, 0.0, 0.0])), f"{place}.axis_b", ["length 0.5", "unit vector"]),
            (stand(in_plane(point_a=[0.5])), f"{place}.point_a", ["three finite numbers"]),
            (stand(in_plane(point_a=[0.5, 0.0, 0.7])), f"{place}.point_a", ["0.7", "planar", "must be 0"]),
            (stand(in_plane(marker="hand")), f"{place}.marker", ["hand", "it has: foot"]),
            (stand(in_plane(multiplier=6)), f"{place}.multiplier", ["no signal 6", "list 6"]),
            (stand(in_plane(partner_position=[3])), f"{place}.partner_position", ["length 1", "needs 2"]),
            (stand(in_plane(partner_position=[])), f"{place}.partner_position", ["length 0", "needs 2"]),
            (stand(in_plane(partner_position=[3, 17])), f"{place}.partner_position", ["no signal 17"]),
            (stand(in_plane(partner_rotation=[3, 4, 5])), f"{place}.partner_rotation", ["length 3", "needs 1"]),
            (stand(in_plane(partner_attitude=[0] * 4)), f"{place}.partner_attitude", ["length 4", "must be empty", "planar"]),
            (
                stand(in_plane(end=pb.JOINT_END_A, partner_position=[0] * 3, partner_rotation=[5])),
                f"{place}.partner_position",
                ["length 3", "2 or none"],
            ),
            (
                stand(in_plane(partner_position=[0] * 3), marker="spatial", pose=in_space, inputs=["mz", "fx"]),
                f"{place}.partner_rotation",
                ["length 1", "needs 3"],
            ),
            (stand(marker="planar-point", pose=OWN[:2]), f"{place}.marker", ["position", "length 2", "needs 3"]),
            (stand(marker="planar-pushed", inputs=["fx", "fy"]), f"{place}.marker", ["load", "length 2", "needs 3"]),
            (stand(marker="planar-watched", inputs=[]), f"{place}.marker", ["load", "length 0", "needs 2"]),
            (stand(marker="scalar", pose=[0.3], inputs=["fx"]), f"{place}.marker", ["planar nor spatial", "foot"]),
            (stand(joint_inputs=["lambda", "lambda"]), "joint_inputs", ["lambda", "twice"]),
        ):
            for name in ("coupling_outputs", "recorded_outputs"):
                request.ClearField(name)
            with self.subTest(field=field, words=words):
                self.assert_misuse(field, lambda request=request: self.peer.call("Initialize", request), *words)


class Poses(PeerTest):
    def test_a_pose_may_end_early(self):
        planar, spatial = LoadedMarker("tip", True, 2, ()), LoadedMarker("tip", False, 3, ())
        self.assertEqual(planar.pose((1.0, 2.0)), Pose.planar(1.0, 2.0, 0.0))
        self.assertEqual(spatial.pose((1.0, 2.0, 3.0)), Pose((1.0, 2.0, 3.0)))
        self.assertEqual(LoadedMarker("tip", False, 0, ()).pose(()), Pose())
        with self.assertRaisesRegex(ValueError, 'marker "tip" has the length 2; its position has 3'):
            spatial.pose((1.0, 2.0))

    def test_what_a_partner_does_not_tell_is_at_rest(self):
        self.assertEqual(Partner().pose(()), Pose())
        self.assertEqual(Partner(position=[1, 0]).pose((2.0, 1.0)), Pose((1.0, 2.0, 0.0)))

    def test_a_marker_without_a_pose_is_named(self):
        law = JointLaw.of_message(in_plane())
        load = JointLoad(LoadedMarker("foot", True, 3, [0]), law, A, 1, Partner())
        values = values_type(["fx"], 1, [load])([0.0, 1.0])
        with self.assertRaisesRegex(ValueError, 'no pose of the marker "foot".*given: hand'):
            values.with_joint_loads({"hand": (0.0, 0.0, 0.0)})

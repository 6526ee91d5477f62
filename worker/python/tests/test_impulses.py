"""Impulses of loads within a step."""

import math

from peer import STEP, Driver, Peer, WorkerTest, constant, initialize, load, oscillator

from linchpin_worker import Description, DescriptionError, Host, Subsystem, planar_marker
from linchpin_worker._contract import worker_pb2 as pb

TIP = planar_marker("tip")
MASS, INERTIA, ARM = 1.7, 0.3, (0.4, 0.25)


class Puck(Subsystem):
    """A body at rest but for impulses, with joint loads at its centre."""

    description = Description("puck", inputs=TIP.inputs, outputs=TIP.outputs, markers=[TIP], joint_loads=True, impulses=True)

    def __init__(self, setup):
        self.position, self.velocity = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)

    def accelerations(self, u):
        fx, fy, moment = u.with_joint_loads({"tip": self.position})
        return fx / MASS, fy / MASS, moment / INERTIA

    def advance(self, t, step, u):
        self.position = tuple(x + step * v for x, v in zip(self.position, self.velocity, strict=True))

    def impulse(self, t, u, impulses):
        pairs = zip(self.velocity, self.accelerations(u.plus(impulses)), self.accelerations(u), strict=True)
        self.velocity = tuple(v + raised - own for v, raised, own in pairs)

    def outputs(self, t, u):
        return (*self.position, *self.velocity, *self.accelerations(u))

    def save(self):
        return self.position, self.velocity

    def load(self, state):
        self.position, self.velocity = state


def puck(**fields):
    """Its multiplier is signal 3, the partner's angle, by which the load turns, signal 4."""
    joint_load = pb.JointLoad(
        marker="tip",
        law=pb.JOINT_LAW_INPLANE,
        end=pb.JOINT_END_A,
        point_a=[*ARM, 0.0],
        point_b=[0.0, 0.0, 0.0],
        axis_b=[1.0, 0.0, 0.0],
        multiplier=3,
        partner_position=[],
        partner_rotation=[4],
    )
    return initialize(
        model="puck",
        inputs=[variable.name for variable in TIP.inputs],
        coupling_outputs=[*TIP.position, *TIP.velocity],
        interior_outputs=[TIP.velocity[0]],
        joint_inputs=["lambda", "angle"],
        joint_loads=[joint_load],
        **fields,
    )


def struck(at, *loads):
    return pb.Impact(at=at, loads=loads)


class Impulses(WorkerTest):
    def setUp(self):
        self.peer = Peer(self, classes=[Puck])

    def assert_near(self, found, expected):
        for own, other in zip(found, expected, strict=True):
            self.assertAlmostEqual(own, other, delta=1e-14 * (1.0 + abs(other)))

    def test_velocities_jump_by_impulse_over_mass_and_positions_go_on_from_there(self):
        driver = Driver(self.peer, puck())
        signals = [constant(place, value) for place, value in enumerate((11.0, -3.0, 0.7, 5.0, 0.0))]
        impacts = pb.Impacts(impacts=[struck(0.25 * STEP, 0.34, 0.0, 0.06, 0.0, 0.0), struck(STEP, 0.0, 0.17, 0.0, 0.0, 0.0)])
        found = driver.step(0.0, STEP, *signals, impacts=impacts)
        self.assert_near(found, [0.75 * STEP * 0.2, 0.0, 0.75 * STEP * 0.2, 0.2, 0.1, 0.2])

    def test_an_impulse_of_a_joint_acts_where_the_pose_of_the_partner_has_it(self):
        """The load of the multiplier turns with the partner; what the multiplier is at the instant does not count."""
        angle, impulse = 0.8, 0.51
        signals = [constant(place, value) for place, value in enumerate((0.0, 0.0, 0.0, 5.0, angle))]
        impacts = pb.Impacts(impacts=[struck(0.0, 0.0, 0.0, 0.0, impulse, 0.0)])
        velocity = Driver(self.peer, puck()).step(0.0, STEP, *signals, impacts=impacts)[3:]
        x, y = impulse * math.cos(angle), impulse * math.sin(angle)
        self.assert_near(velocity, [x / MASS, y / MASS, (ARM[0] * y - ARM[1] * x) / INERTIA])

    def test_outputs_at_the_instant_of_an_impact_are_those_before_it(self):
        driver = Driver(self.peer, puck())
        signals = [constant(place, 0.0) for place in range(5)]
        impacts = pb.Impacts(impacts=[struck(0.5 * STEP, 1.7, 0.0, 0.0, 0.0, 0.0)])
        told = driver.step(0.0, STEP, *signals, impacts=impacts, instants=[0.5 * STEP, 0.75 * STEP])
        self.assert_near(told[6:], [0.0, 1.0])

    def test_a_sample_has_the_impulses_until_then(self):
        driver = Driver(self.peer, puck())
        signals = [constant(place, 0.0) for place in range(5)]
        impacts = pb.Impacts(impacts=[struck(0.5 * STEP, 1.7, 0.0, 0.0, 0.0, 0.0)])
        samples = [0.25 * STEP, 0.5 * STEP, 0.75 * STEP]
        reply = driver.exchange(advance=pb.Advance(step=STEP, signals=signals, samples=samples, impacts=impacts))
        self.assert_near([sample.values[3] for sample in reply.samples], [0.0, 1.0, 1.0])

    def test_the_next_request_has_none_of_them(self):
        driver = Driver(self.peer, oscillator())
        start = driver.snapshot()
        plain = driver.step(0.0, STEP, *load(4.0))
        driver.restore(start)
        impacts = pb.Impacts(impacts=[struck(0.5 * STEP, 0.1, 0.0), struck(0.7 * STEP)])
        self.assertNotEqual(driver.step(0.0, STEP, *load(4.0), impacts=impacts), plain)
        driver.restore(start)
        self.assertEqual(driver.step(0.0, STEP, *load(4.0)), plain)

    def test_impacts_that_contradict_their_step_are_refused(self):
        driver = Driver(self.peer, oscillator())
        ordered = struck(0.5 * STEP, 0.1, 0.0)
        for impacts, words in (
            ([struck(-1e-9)], ["impact 0", "from 0 s on"]),
            ([ordered, struck(1.01 * STEP)], ["impact 1", "end of the step at 0.0017 s"]),
            ([ordered, struck(0.2 * STEP)], ["impact 1", "from 0.00085 s on"]),
            ([struck(math.nan)], ["impact 0", "NaN"]),
            ([struck(0.0, 1.0)], ["impact 0 has 1 loads", "each of the 2 signals"]),
            ([struck(0.0, 1.0, math.inf)], ["impact 0", "inf", "finite"]),
        ):
            given = pb.Impacts(impacts=impacts)
            self.assert_misuse("impacts", lambda given=given: driver.step(0.0, STEP, *load(4.0), impacts=given), *words)
        self.assertEqual(driver.values("x"), [0.37])

    def test_a_model_that_says_impulses_has_the_method(self):
        class Silent(Puck):
            impulse = Subsystem.impulse

        with self.assertRaisesRegex(DescriptionError, "no method impulse"):
            Host(Silent)

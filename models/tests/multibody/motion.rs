//! Prescribed motion.

use std::f64::consts::TAU;

use linchpin_models::integrators::Ode;
use linchpin_models::integrators::radau::{Radau, Tolerances};
use linchpin_worker::{Inputs, Setup};

use crate::common::body::{Body, TIGHT, difference};
use crate::common::interval;
use crate::common::mechanisms::Given::{List as L, Number as N, Text as T};
use crate::common::mechanisms::{Composition, Given, list, values, with};
use crate::{FORMULATIONS, planar, spatial};

const AMPLITUDE: f64 = 0.06;
const FREQUENCY: f64 = 2.7;
const PHASE: f64 = 0.4;

/// A pendulum whose pivot is shaken along y: `(J + m l^2) phi'' = -m l (g + y'') cos phi`.
struct Shaken;

const M: f64 = 1.3;
const J: f64 = 0.17;
const LENGTH: f64 = 0.5;

/// Shaking and its second derivative.
fn shaking(t: f64) -> (f64, f64) {
    let omega = TAU * FREQUENCY;
    let value = AMPLITUDE * ((omega * t + PHASE).sin() - PHASE.sin());
    (
        value,
        -omega * omega * AMPLITUDE * (omega * t + PHASE).sin(),
    )
}

impl Ode for Shaken {
    fn derivative(&self, t: f64, y: &[f64], dy: &mut [f64]) {
        dy[0] = y[1];
        let gravity = 9.81 + shaking(t).1;
        dy[1] = -M * LENGTH * gravity * y[0].cos() / (J + M * LENGTH * LENGTH);
    }
}

/// The pendulum's angle and its rate at `t`.
fn reference(t: f64) -> [f64; 2] {
    let tolerances = Tolerances {
        relative: 1e-13,
        absolute: 1e-13,
    };
    let mut state = [0.3, 0.0];
    if t > 0.0 {
        Radau::new(2, tolerances)
            .integrate(&Shaken, t, &mut state)
            .unwrap();
    }
    state
}

/// The link moves with its pivot at the start.
const SPEED: f64 = AMPLITUDE * TAU * FREQUENCY;

fn link() -> Vec<(&'static str, Given)> {
    let speed = SPEED * PHASE.cos();
    vec![
        ("body.link.m", N(M)),
        ("body.link.inertia", N(J)),
        (
            "body.link.position",
            list(&[LENGTH * 0.3f64.cos(), LENGTH * 0.3f64.sin()]),
        ),
        ("body.link.angle", N(0.3)),
        ("body.link.velocity", list(&[0.0, speed])),
        ("marker.link.body", T("link")),
        ("motion.shake.amplitude", N(AMPLITUDE)),
        ("motion.shake.frequency", N(FREQUENCY)),
        ("motion.shake.phase", N(PHASE)),
    ]
}

/// The pivot is a carriage that slides on the ground.
fn on_carriage(reversed: bool) -> Vec<(&'static str, Given)> {
    let (a, b, axis) = if reversed {
        ("carriage", "ground", L(&[0.0, -1.0]))
    } else {
        ("ground", "carriage", L(&[0.0, 3.0]))
    };
    let mut composition = link();
    composition.extend([
        ("body.carriage.m", N(0.4)),
        ("body.carriage.inertia", N(0.3)),
        ("body.carriage.velocity", list(&[0.0, SPEED * PHASE.cos()])),
        ("joint.slide.kind", T("prismatic")),
        ("joint.slide.a", T(a)),
        ("joint.slide.b", T(b)),
        ("joint.slide.point", L(&[0.2, 0.1])),
        ("joint.slide.axis", axis),
        ("joint.pivot.kind", T("revolute")),
        ("joint.pivot.a", T("link")),
        ("joint.pivot.b", T("carriage")),
        ("joint.pivot.point", L(&[0.0, 0.0])),
        ("motion.shake.joint", T("slide")),
    ]);
    composition
}

fn assert_shaken(mut own: Body, what: &str) {
    for _ in 0..25 {
        let [angle, rate] = reference(own.t);
        let read = own.read_all(["link_angle", "link_rate", "link_y"]);
        let height = shaking(own.t).0 + LENGTH * angle.sin();
        let error = difference(&read, &[angle, rate, height]);
        assert!(error < 1e-9, "{what}: {error:e} at t = {}", own.t);
        own.advance(0.07);
    }
}

#[test]
fn a_pendulum_on_a_shaken_pivot_follows_the_parametric_equation() {
    for formulation in FORMULATIONS {
        for reversed in [false, true] {
            let own = planar(&on_carriage(reversed), formulation, TIGHT);
            assert_shaken(own, &format!("{formulation}, reversed {reversed}"));
        }
    }
    let mut composition = link();
    composition.extend([
        ("motion.shake.body", T("link")),
        ("motion.shake.point", L(&[-LENGTH, 0.0])),
        ("motion.shake.direction", L(&[0.0, 1.0])),
        ("motion.hold.body", T("link")),
        ("motion.hold.point", L(&[-LENGTH, 0.0])),
        ("motion.hold.direction", L(&[2.0, 0.0])),
    ]);
    assert_shaken(planar(&composition, "absolute", TIGHT), "a point");
}

/// The slider is where Pythagoras puts it, and the drive's power is the rate of the energy.
#[test]
fn a_driven_slider_crank_obeys_its_closed_form() {
    let (r, l, height, start): (f64, f64, f64, f64) = (0.3, 0.9, 0.11, 0.8);
    let tip = [r * start.cos(), r * start.sin()];
    let slope = ((height - tip[1]) / l).asin();
    let slider = [tip[0] + l * slope.cos(), height];
    let speed = 4.0;
    let tip_speed = [-speed * tip[1], speed * tip[0]];
    let slope_rate = -tip_speed[1] / (l * slope.cos());
    let slider_speed = tip_speed[0] - slope_rate * (height - tip[1]);
    let composition: Vec<(&str, Given)> = vec![
        ("body.crank.m", N(0.7)),
        ("body.crank.inertia", N(0.02)),
        ("body.crank.position", list(&tip.map(|own| 0.5 * own))),
        ("body.crank.velocity", list(&tip_speed.map(|own| 0.5 * own))),
        ("body.crank.rate", N(speed)),
        ("body.rod.m", N(0.4)),
        ("body.rod.inertia", N(0.03)),
        (
            "body.rod.position",
            list(&[0.5 * (tip[0] + slider[0]), 0.5 * (tip[1] + slider[1])]),
        ),
        (
            "body.rod.velocity",
            list(&[0.5 * (tip_speed[0] + slider_speed), 0.5 * tip_speed[1]]),
        ),
        ("body.rod.rate", N(slope_rate)),
        ("body.slider.m", N(1.9)),
        ("body.slider.inertia", N(0.1)),
        ("body.slider.position", list(&slider)),
        ("body.slider.velocity", list(&[slider_speed, 0.0])),
        ("joint.hinge.kind", T("revolute")),
        ("joint.hinge.a", T("ground")),
        ("joint.hinge.b", T("crank")),
        ("joint.hinge.point", L(&[0.0, 0.0])),
        ("joint.pin.kind", T("revolute")),
        ("joint.pin.a", T("crank")),
        ("joint.pin.b", T("rod")),
        ("joint.pin.point", list(&tip)),
        ("joint.wrist.kind", T("revolute")),
        ("joint.wrist.a", T("rod")),
        ("joint.wrist.b", T("slider")),
        ("joint.wrist.point", list(&slider)),
        ("joint.guide.kind", T("prismatic")),
        ("joint.guide.a", T("ground")),
        ("joint.guide.b", T("slider")),
        ("joint.guide.point", list(&slider)),
        ("joint.guide.axis", L(&[1.0, 0.0])),
        ("motion.drive.joint", T("hinge")),
        ("motion.drive.speed", N(speed)),
        ("marker.slider.body", T("slider")),
    ];
    let mut own = planar(&composition, "absolute", TIGHT);
    let step = 1e-3;
    for _ in 0..40 {
        own.advance(0.043);
        let angle = start + speed * own.t;
        let below = height - r * angle.sin();
        let x = r * angle.cos() + (l * l - below * below).sqrt();
        let rate = -speed * r * angle.sin()
            + below * speed * r * angle.cos() / (l * l - below * below).sqrt();
        let read = own.read_all(["slider_x", "slider_y", "slider_vx", "slider_angle"]);
        let error = difference(&read, &[x, height, rate, 0.0]);
        assert!(error < 1e-12, "{error:e} at t = {}", own.t);
    }
    let rates = own.rates(step, |own| own.read(&["energy", "hinge_moment"]));
    let power = speed * rates.values[1];
    assert!(
        (rates.rates[0] / power - 1.0).abs() < 1e-6,
        "{} {power}",
        rates.rates[0]
    );
}

/// Hooke's joint: shafts under the angle beta turn by `tan(out) = tan(in) cos(beta)`, counted from where the axis that the
/// input holds is at right angles to both. The second shaft is held by the
/// joint at one end and by two motions of a point, which are none, at the other.
#[test]
fn a_universal_joint_turns_as_hooke_found() {
    const BETA: f64 = 0.6;
    let (sin, cos) = BETA.sin_cos();
    let composition: Vec<(&str, Given)> = vec![
        ("body.in.m", N(0.7)),
        ("body.in.inertia", L(&[0.02, 0.03, 0.04])),
        ("body.in.position", L(&[-0.5, 0.0, 0.0])),
        ("body.in.omega", L(&[5.0, 0.0, 0.0])),
        ("body.out.m", N(0.9)),
        ("body.out.inertia", L(&[0.05, 0.03, 0.04])),
        ("body.out.position", list(&[0.5 * cos, 0.5 * sin, 0.0])),
        ("body.out.attitude", list4(BETA)),
        ("body.out.omega", list(&[5.0 * cos, 0.0, 0.0])),
        ("joint.bearing.kind", T("revolute")),
        ("joint.bearing.a", T("ground")),
        ("joint.bearing.b", T("in")),
        ("joint.bearing.point", L(&[-0.7, 0.0, 0.0])),
        ("joint.bearing.axis", L(&[1.0, 0.0, 0.0])),
        ("joint.cross.kind", T("universal")),
        ("joint.cross.a", T("in")),
        ("joint.cross.b", T("out")),
        ("joint.cross.point", L(&[0.0, 0.0, 0.0])),
        ("joint.cross.axis", L(&[0.0, 0.0, 1.0])),
        ("joint.cross.second_axis", list(&[-sin, cos, 0.0])),
        ("motion.drive.joint", T("bearing")),
        ("motion.drive.speed", N(5.0)),
        ("motion.up.body", T("out")),
        ("motion.up.point", L(&[0.5, 0.0, 0.0])),
        ("motion.up.direction", L(&[0.0, 0.0, 1.0])),
        ("motion.side.body", T("out")),
        ("motion.side.point", L(&[0.5, 0.0, 0.0])),
        ("motion.side.direction", list(&[-sin, cos, 0.0])),
        ("marker.out.body", T("out")),
    ];
    let mut own = spatial(&composition, "absolute", TIGHT);
    for _ in 0..40 {
        own.advance(0.047);
        let angle = 5.0 * own.t;
        let [w, x, y, z] = own.read_all(["out_qw", "out_qx", "out_qy", "out_qz"]);
        let q = nalgebra::UnitQuaternion::new_normalize(nalgebra::Quaternion::new(w, x, y, z));
        let turned = q * nalgebra::Vector3::y();
        let out = turned
            .z
            .atan2(turned.dot(&nalgebra::Vector3::new(-sin, cos, 0.0)));
        let expected = (angle.sin() * cos).atan2(angle.cos());
        let error = (out - expected + 0.5 * TAU).rem_euclid(TAU) - 0.5 * TAU;
        assert!(
            error.abs() < 1e-11,
            "{out} instead of {expected} at t = {}",
            own.t
        );
    }
}

fn list4(angle: f64) -> Given {
    let half = 0.5 * angle;
    list(&[half.cos(), 0.0, 0.0, half.sin()])
}

/// Both formulations of a tree with prescribed motions of both kinds, under loads.
#[test]
fn driven_trees_move_in_the_same_way_in_both() {
    const DRIVEN: Composition = &[
        ("motion.lift.joint", T("guide")),
        ("motion.lift.amplitude", N(0.2)),
        ("motion.lift.frequency", N(1.3)),
        ("motion.lift.phase", N(std::f64::consts::FRAC_PI_2)),
        ("motion.turn.joint", T("hinge")),
        ("motion.turn.speed", N(-2.0)),
    ];
    let composition = with(crate::common::mechanisms::SPATIAL_TREE, DRIVEN);
    let mut runs = FORMULATIONS.map(|formulation| spatial(&composition, formulation, TIGHT));
    let outputs: Vec<String> = runs[0]
        .model
        .outputs
        .iter()
        .map(|own| own.name.clone())
        .collect();
    runs.iter_mut().for_each(|run| run.drive_all(7.0));
    for _ in 0..20 {
        let [absolute, minimal] = runs.each_mut().map(|run| run.read(&outputs));
        for ((name, absolute), minimal) in outputs.iter().zip(&absolute).zip(&minimal) {
            let error = (absolute - minimal).abs() / (1.0 + minimal.abs());
            assert!(
                error < 1e-7,
                "{name}: {absolute} {minimal} at t = {}",
                runs[0].t
            );
        }
        runs.iter_mut().for_each(|run| run.advance(0.05));
    }
}

/// The time of a motion is that of the scene, wherever the run starts and however it is cut into macro steps.
#[test]
fn a_motion_counts_the_time_of_the_scene() {
    let composition: Vec<(&str, Given)> = vec![
        ("body.crank.m", N(1.0)),
        ("body.crank.inertia", N(0.1)),
        ("body.crank.angle", N(0.25 + 1.5 * 1.25)),
        ("body.crank.rate", N(1.5)),
        ("joint.hinge.kind", T("revolute")),
        ("joint.hinge.a", T("ground")),
        ("joint.hinge.b", T("crank")),
        ("joint.hinge.point", L(&[0.0, 0.0])),
        ("motion.drive.joint", T("hinge")),
        ("motion.drive.offset", N(0.25)),
        ("motion.drive.speed", N(1.5)),
        ("marker.crank.body", T("crank")),
    ];
    let planar = crate::common::body::model("planar-multibody");
    for formulation in FORMULATIONS {
        let given = values(&with(&composition, &[("formulation", T(formulation))]));
        let description = planar.describe_with(&given).unwrap();
        let setup = Setup::from_request(&description, given, None, 1.25).unwrap();
        let mut run = planar.initialize(&setup).unwrap();
        let inputs = Inputs::constant(&vec![0.0; description.inputs.len()]);
        let place = description
            .outputs
            .iter()
            .position(|own| own.name == "crank_angle");
        for step in 1..=7 {
            let t = 1.25 + 0.3 * f64::from(step);
            run.step(interval(t - 0.3, 0.3), &inputs).unwrap();
            let mut angle = [0.0];
            run.outputs(t, &[0.0; 3], &[place.unwrap()], &mut angle)
                .unwrap();
            assert!(
                (angle[0] - 0.25 - 1.5 * t).abs() < 1e-13,
                "{formulation} {t}"
            );
        }
    }
}

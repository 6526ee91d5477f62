//! Single bodies in space, on joints in the ground, against closed forms.

use std::f64::consts::{FRAC_PI_2, PI};

use linchpin_models::oscillator::OscillatorParameters;
use linchpin_models::reference::FreeOscillation;
use nalgebra::{Quaternion, Rotation3, Unit, UnitQuaternion, Vector3};

use crate::common::agm;
use crate::common::body::{Body, TIGHT, difference};
use crate::common::cases::CASES;
use crate::common::mechanisms::Given::{List as L, Number as N, Text as T};
use crate::common::mechanisms::{Given, list};
use crate::{FORMULATIONS, spatial};

const M: f64 = 1.3;
const INERTIA: Vector3<f64> = Vector3::new(0.17, 0.29, 0.23);

/// A body with its centre of mass at `position` and the angular velocity `omega` in inertial axes about the origin.
fn body_about_origin(
    inertia: Vector3<f64>,
    position: Vector3<f64>,
    attitude: UnitQuaternion<f64>,
    omega: Vector3<f64>,
) -> Vec<(&'static str, Given)> {
    let own = attitude.inverse() * omega;
    let q = attitude.quaternion();
    vec![
        ("body.top.m", N(M)),
        ("body.top.inertia", list(inertia.as_slice())),
        ("body.top.position", list(position.as_slice())),
        ("body.top.attitude", list(&[q.w, q.i, q.j, q.k])),
        ("body.top.velocity", list(omega.cross(&position).as_slice())),
        ("body.top.omega", list(own.as_slice())),
        ("marker.centre.body", T("top")),
    ]
}

fn attitude() -> UnitQuaternion<f64> {
    UnitQuaternion::new_normalize(Quaternion::new(0.9, 0.1, -0.2, 0.3))
}

fn read_vector(body: &mut Body, prefix: &str) -> Vector3<f64> {
    let names = ["x", "y", "z"].map(|part| format!("{prefix}{part}"));
    Vector3::from_vec(body.read(&names))
}

/// The model `spatial-body` has been compared with Euler's closed forms.
#[test]
fn a_free_body_moves_as_that_of_its_own_model() {
    let parameters = CASES[3].parameters;
    let value = |name: &str| {
        parameters
            .iter()
            .find(|(own, _)| *own == name)
            .map_or(0.0, |(_, value)| *value)
    };
    let turn = Vector3::new(value("rx0"), value("ry0"), value("rz0"));
    let attitude = UnitQuaternion::from_scaled_axis(turn);
    let omega = attitude * Vector3::new(value("omega1_0"), value("omega2_0"), value("omega3_0"));
    let mut composition = body_about_origin(INERTIA, Vector3::zeros(), attitude, omega);
    composition.retain(|(name, _)| *name != "body.top.position" && *name != "body.top.velocity");
    composition.extend([
        ("gravity", N(9.7)),
        ("body.top.position", L(&[0.3, -0.7, 0.2])),
        ("body.top.velocity", L(&[2.0, 0.9, -1.2])),
        ("marker.end.body", T("top")),
        ("marker.end.point", L(&[0.5, -0.3, 0.07])),
    ]);
    for formulation in FORMULATIONS {
        let mut own = spatial(&composition, formulation, TIGHT);
        let mut free = Body::of(CASES[3], TIGHT);
        let marker = own.model.markers[1].clone();
        for body in [&mut own, &mut free] {
            for (number, load) in marker.load.iter().enumerate() {
                body.drive(load, 0.9 - 0.5 * number as f64);
            }
        }
        let names = [marker.position, marker.velocity, marker.acceleration].concat();
        for _ in 0..30 {
            let error = difference(&own.read(&names), &free.read(&names));
            assert!(error < 1e-8, "{formulation}: {error:e} at t = {}", own.t);
            own.advance(0.05);
            free.advance(0.05);
        }
    }
}

/// On a hinge with a tilted axis `e`: `I phi'' = -m g d sin(tilt) sin phi`, with the moment of inertia
/// `I = e J e + m d^2` about the axis, whatever the principal axes. Period as for every pendulum.
#[test]
fn a_physical_pendulum_on_a_tilted_axis_has_the_period_of_the_elliptic_integral() {
    let amplitude: f64 = 2.1;
    let axis = Vector3::new(0.3, -0.5, 0.6).normalize();
    let down = (-Vector3::z() + axis * axis.z).normalize();
    let distance = 0.47;
    let along = 0.21;
    let start = Rotation3::from_axis_angle(&Unit::new_unchecked(axis), amplitude) * down;
    let position = distance * start + along * axis;
    let own_axis = attitude().inverse() * axis;
    let inertia = own_axis.dot(&INERTIA.component_mul(&own_axis)) + M * distance * distance;
    let gravity = 9.81 * (1.0 - axis.z * axis.z).sqrt();
    let small = 2.0 * PI * (inertia / (M * gravity * distance)).sqrt();
    let period = small / agm(1.0, (0.5 * amplitude).cos());
    let mut composition = body_about_origin(INERTIA, position, attitude(), Vector3::zeros());
    composition.extend([
        ("joint.hinge.kind", T("revolute")),
        ("joint.hinge.a", T("ground")),
        ("joint.hinge.b", T("top")),
        ("joint.hinge.point", L(&[0.0, 0.0, 0.0])),
        ("joint.hinge.axis", L(&[0.3, -0.5, 0.6])),
    ]);
    for formulation in FORMULATIONS {
        let mut own = spatial(&composition, formulation, TIGHT);
        for turned in [-2.0 * amplitude, 0.0, -2.0 * amplitude] {
            (0..7).for_each(|_| own.advance(0.5 * period / 7.0));
            let [angle, rate] = own.read_all(["hinge_angle", "hinge_rate"]);
            assert!((angle - turned).abs() < 1e-9, "{formulation}: {angle}");
            assert!(rate.abs() < 1e-9, "{formulation}: {rate}");
        }
    }
}

/// A symmetric top on a ball joint precesses steadily at `W` under the angle `theta` from the upright if its spin is
/// `w3 = (A W^2 cos(theta) + m g l) / (C W)`, with the moments of inertia `A` about the joint and `C` about its axis.
#[test]
fn tops_precess_steadily() {
    let (theta, length): (f64, f64) = (0.7, 0.4);
    let about_joint = 0.21 + M * length * length;
    for (theta, rate) in [(theta, 0.9), (PI - theta, 5.0), (FRAC_PI_2, 2.3)] {
        let axis = Vector3::new(theta.sin(), 0.0, theta.cos());
        let turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), theta);
        let spin = (about_joint * rate * rate * theta.cos() + M * 9.81 * length) / (0.37 * rate);
        let across = rate * (Vector3::z() - axis.z * axis);
        let omega = across + spin * axis;
        let inertia = Vector3::new(0.21, 0.21, 0.37);
        let mut composition = body_about_origin(inertia, length * axis, turn, omega);
        composition.extend([
            ("joint.ball.kind", T("spherical")),
            ("joint.ball.a", T("top")),
            ("joint.ball.b", T("ground")),
            ("joint.ball.point", L(&[0.0, 0.0, 0.0])),
        ]);
        for formulation in FORMULATIONS {
            let mut own = spatial(&composition, formulation, TIGHT);
            for _ in 0..20 {
                let precessed = Rotation3::from_axis_angle(&Vector3::z_axis(), rate * own.t);
                let centre = read_vector(&mut own, "centre_");
                let error = (centre - precessed * (length * axis)).norm();
                assert!(
                    error < 1e-9,
                    "{formulation} {theta} {rate}: {error:e} at t = {}",
                    own.t
                );
                // The centre is drawn inwards; the rest of the force carries the weight. It is on the ground.
                let inward = -M * length * rate * rate * Vector3::new(axis.x, 0.0, 0.0);
                let force = precessed * inward + M * 9.81 * Vector3::z();
                let reaction = read_vector(&mut own, "ball_f");
                assert!(
                    (reaction + force).norm() < 1e-7,
                    "{formulation}: {reaction} {force}"
                );
                own.advance(0.11);
            }
        }
    }
}

/// Forced to turn steadily about an axis that is no principal one, a body needs the force `m w x (w x r)` and the moment
/// `w x J w` about its centre, besides what carries its weight.
#[test]
fn reactions_of_a_hinge_carry_weight_and_the_forces_of_turning() {
    let axis = Vector3::new(0.3, -0.5, 1.0).normalize();
    let position = Vector3::new(0.5, 0.2, -0.3);
    let omega = 3.0 * axis;
    let mut composition = body_about_origin(INERTIA, position, attitude(), omega);
    composition.extend([
        ("joint.hinge.kind", T("revolute")),
        ("joint.hinge.point", L(&[0.0, 0.0, 0.0])),
        ("joint.hinge.axis", L(&[0.3, -0.5, 1.0])),
        ("motion.drive.joint", T("hinge")),
    ]);
    for (a, b, sign) in [("ground", "top", 1.0), ("top", "ground", -1.0)] {
        let mut all = composition.clone();
        all.extend([
            ("joint.hinge.a", T(a)),
            ("joint.hinge.b", T(b)),
            ("motion.drive.speed", N(sign * 3.0)),
        ]);
        for formulation in FORMULATIONS {
            let mut own = spatial(&all, formulation, TIGHT);
            for _ in 0..9 {
                own.advance(0.17);
                let turned = Rotation3::from_axis_angle(&Unit::new_unchecked(axis), 3.0 * own.t);
                let arm = turned * position;
                let rotation = turned * attitude().to_rotation_matrix();
                let spin = rotation * INERTIA.component_mul(&(rotation.inverse() * omega));
                let force: Vector3<f64> =
                    M * (omega.cross(&omega.cross(&arm)) + 9.81 * Vector3::z());
                let moment: Vector3<f64> = omega.cross(&spin) + arm.cross(&force);
                let read = read_vector(&mut own, "hinge_f");
                let turning = read_vector(&mut own, "hinge_moment_");
                let error = (sign * read - force).norm() + (sign * turning - moment).norm();
                assert!(
                    error < 1e-9,
                    "{formulation} {a}: {error:e}: {read} {turning} {force} {moment}"
                );
                let [angle, rate] = own.read_all(["hinge_angle", "hinge_rate"]);
                assert!(
                    (angle - sign * 3.0 * own.t).abs() < 1e-11 && (rate - sign * 3.0).abs() < 1e-12
                );
            }
        }
    }
}

/// A torsional spring feels full turns: about a principal axis the body is a damped oscillator, here of five turns, and
/// one macro step is longer than half a turn.
#[test]
fn a_torsional_spring_in_space_counts_full_turns() {
    let own = OscillatorParameters {
        m: INERTIA.z,
        c: 0.7,
        d: 0.02,
        x0: -0.4,
        v0: 55.0,
    };
    let free = FreeOscillation::new(&own);
    let axis = attitude() * Vector3::z();
    let mut composition = body_about_origin(INERTIA, Vector3::zeros(), attitude(), own.v0 * axis);
    composition.extend([
        ("gravity", N(0.0)),
        ("joint.hinge.kind", T("revolute")),
        ("joint.hinge.a", T("top")),
        ("joint.hinge.b", T("ground")),
        ("joint.hinge.point", L(&[0.0, 0.0, 0.0])),
        ("joint.hinge.axis", list(axis.as_slice())),
        ("torsion-spring.t.joint", T("hinge")),
        ("torsion-spring.t.stiffness", N(own.c)),
        ("torsion-spring.t.damping", N(own.d)),
        ("torsion-spring.t.rest_angle", N(-0.4)),
    ]);
    for formulation in FORMULATIONS {
        let mut body = spatial(&composition, formulation, TIGHT);
        let mut largest: f64 = 0.0;
        for _ in 0..60 {
            body.advance(0.08);
            let motion = free.motion(body.t);
            let [angle, rate] = body.read_all(["hinge_angle", "hinge_rate"]);
            // The joint counts from the body to the ground.
            let error = (-angle - 0.4 - motion.x)
                .abs()
                .max((-rate - motion.v).abs());
            assert!(error < 1e-8, "{formulation}: {error:e} at t = {}", body.t);
            largest = largest.max(motion.x.abs());
        }
        assert!(largest > 5.0 * PI, "{largest} rad");
    }
}

//! Built-in subsystem solvers behind [`linchpin_worker::Model`].
//!
//! * [`oscillator`]: one mass on a spring and a damper;
//! * [`pendulum`], [`planar_body`]: rigid links in the plane, on a hinge and free;
//! * [`spatial_body`]: a free rigid body in space;
//! * [`ground`]: what does not move;
//! * [`dc_motor`], [`pi_controller`]: an electric drive, by signals and by its shaft;
//! * [`multibody`]: systems of bodies with joints of their own, as a scene composes them;
//! * [`nonsmooth`]: impacts and friction, rigid and flexible;
//! * [`integrators`]: time integration that several models share;
//! * [`mod@reference`]: solutions that coupled runs are compared with.

#![cfg_attr(test, allow(clippy::unwrap_used))]

pub mod dc_motor;
pub mod ground;
pub mod integrators;
mod mechanics;
pub mod multibody;
pub mod nonsmooth;
pub mod oscillator;
pub mod pendulum;
pub mod pi_controller;
pub mod planar_body;
pub mod reference;
pub mod spatial_body;

use linchpin_worker::Model;

/// The examples of the guide are compiled.
#[cfg(doctest)]
#[doc = include_str!("../../docs/guide/own-system.md")]
pub struct Guide;

/// All built-in models.
pub fn models() -> Vec<Box<dyn Model>> {
    vec![
        Box::new(oscillator::Oscillator),
        Box::new(pendulum::Pendulum),
        Box::new(planar_body::PlanarBody),
        Box::new(spatial_body::SpatialBody),
        Box::new(multibody::PlanarMultibody),
        Box::new(multibody::SpatialMultibody),
        Box::new(ground::Ground),
        Box::new(dc_motor::DcMotor),
        Box::new(pi_controller::PiController),
        Box::new(nonsmooth::SLIDER_CRANK),
        Box::new(nonsmooth::ROD_SLIDER),
        Box::new(nonsmooth::MASS_CHAIN),
        Box::new(nonsmooth::BOUNCING_BALL),
        Box::new(nonsmooth::BLOCK),
        Box::new(nonsmooth::WOODPECKER),
    ]
}

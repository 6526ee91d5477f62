//! The macro step keeps its memory: once a run is under way it allocates nothing.

#![allow(clippy::unwrap_used)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use linchpin::connect::{Connector, Place};
use linchpin_master::CoSimulation;
use linchpin_master::cosimulation::Options;
use linchpin_master::scene::{Override, Scene, parse};

const SCENE: &str = include_str!("../../scenes/oscillator.toml");

/// Steps until all memory has been taken: histories are full, replies have gone around once.
const WARM_UP: usize = 20;

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

struct Counting;

// SAFETY: every call is passed on unchanged to the system's allocator.
#[allow(unsafe_code)] // An allocator cannot be written without.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        unsafe { System.dealloc(memory, layout) }
    }

    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        unsafe { System.realloc(memory, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn allocations_per_100_steps(overrides: &[&str]) -> usize {
    let overrides: Vec<Override> = overrides.iter().map(|text| text.parse().unwrap()).collect();
    let scene = parse(SCENE, "oscillator.toml", &overrides).unwrap();
    let connector = Connector::new(Place::InProcess);
    let mut connect = |scene: &Scene, subsystem: &_| connector.connect(scene, subsystem);
    let mut simulation = CoSimulation::start(&scene, &mut connect, &Options::default()).unwrap();
    for _ in 0..WARM_UP {
        assert!(simulation.macro_step().unwrap());
    }
    let before = ALLOCATIONS.get();
    assert!(before > 0, "the counter does not count");
    for _ in 0..100 {
        assert!(simulation.macro_step().unwrap());
    }
    ALLOCATIONS.get() - before
}

#[test]
fn a_macro_step_allocates_nothing() {
    for method in [
        &["coupling.degree=0"][..],
        &[
            "coupling.method=baumgarte",
            "coupling.index=1",
            "coupling.beta=2H",
            "coupling.gamma=H^2",
            "coupling.degree=3",
        ],
        &[
            "coupling.method=weighted",
            "coupling.index=1",
            "coupling.degree=2",
        ],
        &["coupling.method=explicit", "coupling.mu=1e-2"],
        &[
            "coupling.method=jacobi",
            "coupling.stiffness=1e5",
            "coupling.damping=10",
        ],
        &[
            "coupling.method=gauss-seidel",
            "coupling.stiffness=1e5",
            "coupling.damping=10",
        ],
    ] {
        assert_eq!(allocations_per_100_steps(method), 0, "{method:?}");
    }
}

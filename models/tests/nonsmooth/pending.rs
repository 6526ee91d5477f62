//! Steps with given impacts, and perturbed steps that repeat those of another one.

use linchpin_models::nonsmooth::ROD_SLIDER;
use linchpin_worker::{
    Impact, Impacts, Inputs, Interval, Model, Setup, Snapshot, StepFailure, Subsystem,
};

/// Falls on the lower wall after about 1.1 ms.
fn falling(solver: &str) -> Box<dyn Subsystem> {
    let parameters = [("vy_0", 22.95), ("omega2_0", -78.0)];
    let solver = linchpin_proto::v1::Solver {
        kind: solver.into(),
        options: [(
            "step".into(),
            linchpin_proto::v1::Value {
                kind: Some(linchpin_proto::v1::value::Kind::Number(1e-5)),
            },
        )]
        .into(),
    };
    let setup = Setup::new(&ROD_SLIDER.describe(), &parameters, Some(solver), 0.0).unwrap();
    ROD_SLIDER.initialize(&setup).unwrap()
}

fn interval(start: f64) -> Interval {
    Interval {
        start,
        length: 1.3e-3,
    }
}

fn loads(fy: f64, moment: f64) -> Inputs {
    Inputs::constant(&[0.0, fy, moment])
}

fn read(run: &mut Box<dyn Subsystem>, names: &[&str]) -> Vec<f64> {
    let outputs = ROD_SLIDER.describe().outputs;
    let place = |name: &&str| outputs.iter().position(|own| own.name == **name).unwrap();
    let wanted: Vec<usize> = names.iter().map(place).collect();
    let mut values = vec![0.0; wanted.len()];
    run.outputs(1.3e-3, &[0.0; 3], &wanted, &mut values)
        .unwrap();
    values
}

const MOTION: [&str; 4] = ["pin_vx", "pin_vy", "omega2", "omega3"];

/// What a moment on the rod makes of the velocities over a step of this length, by a difference of this increment (N m).
fn column(length: f64, increment: f64, is_repeated: bool) -> Vec<f64> {
    let mut run = falling("generalized-alpha");
    run.treat_impacts(&Impacts::Alone).unwrap();
    let step = Interval { start: 0.0, length };
    let mut start = Snapshot::default();
    run.snapshot(&mut start);
    run.step(step, &loads(0.3, 0.02)).unwrap();
    assert_eq!(run.impacts().len(), 1);
    let base = read(&mut run, &MOTION);
    run.restore(&start).unwrap();
    let raised = loads(0.3, 0.02 + increment);
    match is_repeated {
        true => run.perturbed_step(step, &raised).unwrap(),
        false => run.step(step, &raised).unwrap(),
    }
    let raised = read(&mut run, &MOTION);
    let quotients = raised.iter().zip(&base);
    quotients
        .map(|(raised, base)| (raised - base) / increment)
        .collect()
}

/// With the pattern of the contacts held the response is smooth in the load, whatever the increment. Of its own the perturbed step
/// comes too late for the impact in the last internal step, and the quotient is none.
#[test]
fn a_perturbed_step_repeats_impacts() {
    let mut run = falling("generalized-alpha");
    run.step(interval(0.0), &loads(0.3, 0.02)).unwrap();
    let length = run.impacts()[0].at;
    let fine = column(length, 1e-5, true);
    for increment in [1e-3, 0.3, -0.7] {
        let own = column(length, increment, true);
        for (own, fine) in own.iter().zip(&fine).take(3) {
            let error = (own - fine).abs() / fine.abs();
            assert!(error < 0.05 * increment.abs(), "{increment}: {own} {fine}");
        }
    }
    let free = column(length, 0.7, false);
    let error = (free[2] - fine[2]).abs() / fine[2].abs();
    assert!(error > 5.0, "{free:?} {fine:?}");
}

/// Another instance goes on from a state as the first one does: its perturbed steps repeat impacts, although nobody has said anything to
/// it yet.
#[test]
fn a_state_says_that_impacts_are_coupled() {
    let (base, raised) = (loads(0.3, 0.02), loads(0.3, 0.72));
    let perturbed = |run: &mut Box<dyn Subsystem>, state: &Snapshot| {
        run.restore(state).unwrap();
        run.step(interval(1e-4), &base).unwrap();
        assert_eq!(run.impacts().len(), 1);
        run.restore(state).unwrap();
        run.perturbed_step(interval(1e-4), &raised).unwrap();
        read(run, &MOTION)
    };
    let state_of = |is_told: bool| {
        let mut run = falling("generalized-alpha");
        if is_told {
            run.treat_impacts(&Impacts::Alone).unwrap();
        }
        let short = Interval {
            start: 0.0,
            length: 1e-4,
        };
        run.step(short, &base).unwrap();
        let mut state = Snapshot::default();
        run.snapshot(&mut state);
        (run, state)
    };
    let (mut first, told) = state_of(true);
    let own = perturbed(&mut first, &told);
    let mut other = falling("generalized-alpha");
    assert_eq!(perturbed(&mut other, &told), own);
    // Where nobody has said anything perturbed steps find impacts of their own, which are others.
    let (_, untold) = state_of(false);
    let mut other = falling("generalized-alpha");
    assert_ne!(perturbed(&mut other, &untold), own);
}

/// A contact that closes where no impact is given stays open, and collides in the first internal step of the next free step.
#[test]
fn what_closes_without_an_impact_collides_later() {
    let mut run = falling("generalized-alpha");
    run.treat_impacts(&Impacts::Given(Vec::new())).unwrap();
    run.step(interval(0.0), &loads(0.0, 0.0)).unwrap();
    assert!(run.impacts().is_empty());
    let [before, gap, force] = read(&mut run, &["slider_vy", "gap_corner3", "normal_corner3"])
        .try_into()
        .unwrap();
    assert!(
        before < -0.5 && gap < 0.0 && force == 0.0,
        "{before} {gap} {force}"
    );

    let mut end = Snapshot::default();
    run.snapshot(&mut end);
    run.restore(&end).unwrap();
    run.treat_impacts(&Impacts::Alone).unwrap();
    let short = Interval {
        start: 1.3e-3,
        length: 1e-4,
    };
    run.step(short, &loads(0.0, 0.0)).unwrap();
    let impacts = run.impacts().to_vec();
    assert_eq!(impacts.len(), 1);
    assert!((impacts[0].at - 1e-5).abs() < 1e-12, "{impacts:?}");
    let [behind] = read(&mut run, &["slider_vy"]).try_into().unwrap();
    assert!((behind + 0.4 * before).abs() < 0.02, "{before} {behind}");
}

/// The impacts that a step has found, given to another one: the same bits, but for those that the loads come from.
#[test]
fn given_impacts_are_those_that_were_found() {
    let motion = |impacts: &Impacts| {
        let mut run = falling("bathe");
        run.treat_impacts(impacts).unwrap();
        run.step(interval(0.0), &loads(0.7, 0.3)).unwrap();
        let found = run.impacts().to_vec();
        (read(&mut run, &MOTION), found)
    };
    let (alone, found) = motion(&Impacts::Alone);
    let (given, again) = motion(&Impacts::Given(found.clone()));
    assert_eq!(alone, given);
    assert_eq!(found, again);
    assert_eq!(found[0].contacts, [2, 3]);
}

#[test]
fn what_is_not_offered_is_refused() {
    let mut run = falling("moreau");
    let refused = run.treat_impacts(&Impacts::Given(Vec::new())).unwrap_err();
    assert!(
        matches!(refused, StepFailure::NotOffered { .. }),
        "{refused}"
    );
    run.treat_impacts(&Impacts::Alone).unwrap();

    let mut run = falling("hets");
    let other = Impact {
        at: 1e-4,
        contacts: vec![1, 4],
        ..Impact::default()
    };
    let refused = run.treat_impacts(&Impacts::Given(vec![other])).unwrap_err();
    assert!(refused.to_string().contains("contact 4"), "{refused}");
}

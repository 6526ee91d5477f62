//! The woodpecker toy, all schemes, against published figures.
//!
//! Leine, Glocker & van Campen (2001) find a periodic motion with a period of about 0.145 s. The start below is a state
//! of it that circulates with their data: the sleeve slides down, closed at its lower edge, and the beak swings out.
//! With Moreau's rule other codes (Siconos, steps of 20 us) take 0.146 s from there to the same place of the bird and
//! fall by 19.5 mm.

use linchpin_models::nonsmooth::mechanics::Settings;
use linchpin_models::nonsmooth::systems::woodpecker::{Toy, Woodpecker};

use super::stand::{SCHEMES, Stand};

pub const START: [&[f64]; 2] = [&[0.0, -0.1036, -0.2788], &[-0.3411, 0.0, -7.4583]];

/// First rows of the contacts.
const BEAK: usize = 0;
const LOWER: usize = 2;
const UPPER: usize = 4;

/// An impact: time, height, row of the contact with the largest impulse.
struct Impact {
    time: f64,
    height: f64,
    row: usize,
}

fn impacts(stand: &mut Stand, end: f64, dt: f64) -> Vec<Impact> {
    let mut impacts = Vec::new();
    while stand.t() < end {
        let before = stand.integrator.log.impacts;
        stand.step(dt);
        if stand.integrator.log.impacts > before {
            let impulses = &stand.integrator.state.impulses;
            let row = [BEAK, LOWER, UPPER]
                .into_iter()
                .max_by(|&a, &b| impulses[a].total_cmp(&impulses[b]));
            impacts.push(Impact {
                time: stand.t(),
                height: stand.q()[0],
                row: row.unwrap(),
            });
        }
    }
    impacts
}

#[test]
fn it_pecks_with_the_published_period() {
    for case in SCHEMES {
        let system = Woodpecker::new(Toy::of_glocker());
        let mut stand = Stand::new(system, case.kind, Settings::default(), START);
        let dt = 1e-5;
        let impacts = impacts(&mut stand, 1.2, dt);
        let is_stroke = |impact: &&Impact| impact.row == BEAK;
        let strokes: Vec<&Impact> = impacts.iter().filter(is_stroke).collect();
        assert_eq!(strokes.len(), 8, "{case:?}");
        // The motion is attracted: from the third cycle on periods agree to the step.
        for pair in strokes[3..].windows(2) {
            let period = pair[1].time - pair[0].time;
            let fall = pair[0].height - pair[1].height;
            assert!((period - 0.14598).abs() < 1.6e-4, "{case:?}: {period}");
            assert!((fall - 0.01944).abs() < 1.6e-4, "{case:?}: {fall}");
        }
        let periods = (strokes[7].time - strokes[3].time) / 4.0;
        assert!((periods - 0.14598).abs() < 8e-5, "{case:?}: {periods}");
        // One cycle: the upper edge, the beak, the upper edge again, the lower edge twice.
        let cycle = impacts.iter().map(|impact| impact.row);
        let cycle: Vec<usize> = cycle.skip(impacts.len() - 10).collect();
        let expected = [UPPER, BEAK, UPPER, LOWER, LOWER];
        assert_eq!(cycle, [expected, expected].concat(), "{case:?}");
        let counters = stand.integrator.mechanics.counters;
        assert_eq!((counters.ambiguous, counters.jams), (0, 0), "{case:?}");
    }
}

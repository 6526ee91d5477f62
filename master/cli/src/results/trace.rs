//! A time series in bounded memory, for pictures.

use super::Thinned;

/// Most points that are kept.
const MOST_POINTS: usize = 1 << 16;

/// Points `(x, y)` of a long run: what a result column or several show over another one, such as the time.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// Name of the curve.
    pub name: String,
    /// Number of its panel in the picture.
    pub panel: usize,
    /// Whether it shows multipliers.
    pub shows_multipliers: bool,
    /// Times in s, or values of the other quantity, and values.
    pub points: Thinned<(f64, f64)>,
    over: Reading,
    shown: Reading,
}

/// What is read of a row.
#[derive(Debug, Clone, PartialEq)]
pub enum Reading {
    /// The sum of the columns at these places.
    Sum(Vec<usize>),
    /// The angle by which the unit quaternion at these places (w, x, y, z) has turned since the first row, 0 to pi, in rad.
    Turn {
        /// Where its components are.
        places: [usize; 4],
        /// That of the first row, once it is known.
        first: Option<[f64; 4]>,
    },
}

impl Reading {
    fn of(&mut self, values: &[f64]) -> f64 {
        match self {
            Self::Sum(places) => places.iter().map(|place| values[*place]).sum(),
            Self::Turn { places, first } => {
                let now = places.map(|place| values[place]);
                angle(*first.get_or_insert(now), now)
            }
        }
    }
}

/// Angle between two attitudes in rad: of `conj(a) b` with the vector part `v` and the real part `w`, `2 atan2(|v|, |w|)`.
fn angle(a: [f64; 4], b: [f64; 4]) -> f64 {
    let real: f64 = a.iter().zip(&b).map(|(a, b)| a * b).sum();
    let [aw, ax, ay, az] = a;
    let [bw, bx, by, bz] = b;
    let vector = [
        aw * bx - ax * bw - (ay * bz - az * by),
        aw * by - ay * bw - (az * bx - ax * bz),
        aw * bz - az * bw - (ax * by - ay * bx),
    ];
    let length = vector.iter().map(|own| own * own).sum::<f64>().sqrt();
    2.0 * length.atan2(real.abs())
}

impl Trace {
    /// An empty series of what is `shown` over something else.
    pub fn new(
        name: String,
        panel: usize,
        shows_multipliers: bool,
        [over, shown]: [Reading; 2],
    ) -> Self {
        Self {
            name,
            panel,
            shows_multipliers,
            points: Thinned::at_most(MOST_POINTS),
            over,
            shown,
        }
    }

    /// Takes the values of a row.
    pub fn record(&mut self, values: &[f64]) {
        let point = (self.over.of(values), self.shown.of(values));
        self.points.push(|| point);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// About a tilted axis by an angle, after a first turn about another one.
    #[test]
    fn a_turn_is_the_angle_since_the_first_row() {
        let about = |axis: [f64; 3], angle: f64| {
            let (sine, cosine) = (angle / 2.0).sin_cos();
            [cosine, sine * axis[0], sine * axis[1], sine * axis[2]]
        };
        let product = |a: [f64; 4], b: [f64; 4]| {
            [
                a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
                a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
                a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
                a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
            ]
        };
        let first = about([0.48, 0.6, 0.64], 1.1);
        let mut turn = Reading::Turn {
            places: [4, 1, 2, 3],
            first: None,
        };
        for expected in [0.0, 1e-7, 0.7, 3.0, std::f64::consts::PI] {
            let [w, x, y, z] = product(about([0.0, 0.6, -0.8], expected), first);
            // A quaternion and its opposite are the same attitude.
            for sign in [1.0, -1.0] {
                let row = [0.5, x, y, z, w].map(|own| sign * own);
                assert!((turn.of(&row) - expected).abs() < 1e-15 * 8.0);
            }
        }
    }
}

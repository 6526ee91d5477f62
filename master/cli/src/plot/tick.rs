use super::scale::Scale;

/// A labelled position on an axis.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tick {
    /// Place in the coordinate in which the scale is uniform.
    pub coordinate: f64,
    pub label: String,
}

/// Labelled positions and the unlabelled ones between them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Ticks {
    pub major: Vec<Tick>,
    pub minor: Vec<f64>,
}

impl Ticks {
    /// About `wanted` round positions in a range of the uniform coordinate, never more than twice as many.
    pub(crate) fn in_range(scale: Scale, (low, high): (f64, f64), wanted: i32) -> Self {
        match scale {
            Scale::Linear => Self {
                major: linear((low, high), wanted, Scale::Linear),
                minor: Vec::new(),
            },
            Scale::Logarithmic => logarithmic((low, high), wanted),
        }
    }
}

/// A number of the form `digits * 10^exponent`, so that its label is exact.
#[derive(Clone, Copy)]
struct Decimal {
    digits: i64,
    exponent: i32,
}

impl Decimal {
    fn value(self) -> f64 {
        if self.exponent < 0 {
            self.digits as f64 / 10f64.powi(-self.exponent)
        } else {
            self.digits as f64 * 10f64.powi(self.exponent)
        }
    }

    fn coordinate(self, scale: Scale) -> f64 {
        match scale {
            Scale::Linear => self.value(),
            Scale::Logarithmic => (self.digits as f64).log10() + f64::from(self.exponent),
        }
    }

    /// Power of ten of the leading digit.
    fn magnitude(self) -> i32 {
        self.digits
            .unsigned_abs()
            .checked_ilog10()
            .map_or(self.exponent, |places| self.exponent + places as i32)
    }

    fn plain(self) -> String {
        with_minus(format!("{:.*}", places(-self.exponent), self.value()))
    }

    /// Mantissa with as many decimals as the exponent asks for, times a power of ten.
    fn scientific(self, magnitude: i32) -> String {
        if self.digits == 0 {
            return "0".to_owned();
        }
        let mantissa = Self {
            digits: self.digits,
            exponent: self.exponent - magnitude,
        };
        format!("{}·{}", mantissa.plain(), power_of_ten(magnitude))
    }
}

fn places(decimals: i32) -> usize {
    usize::try_from(decimals).unwrap_or(0)
}

fn with_minus(text: String) -> String {
    text.replace('-', "−")
}

fn power_of_ten(exponent: i32) -> String {
    const SUPERSCRIPTS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digits = exponent.unsigned_abs().to_string();
    let raised = digits
        .bytes()
        .map(|digit| SUPERSCRIPTS[usize::from(digit - b'0')]);
    let sign = if exponent < 0 { "⁻" } else { "" };
    format!("10{sign}{}", raised.collect::<String>())
}

/// Equal steps between two values, on an axis of either scale.
fn linear((lower, upper): (f64, f64), wanted: i32, scale: Scale) -> Vec<Tick> {
    let step = round_step((upper - lower) / f64::from(wanted));
    let first = (lower / step.value() - 1e-9).ceil() as i64;
    let last = (upper / step.value() + 1e-9).floor() as i64;
    let positions: Vec<Decimal> = (first..=last)
        .map(|n| Decimal {
            digits: n * step.digits,
            exponent: step.exponent,
        })
        .collect();
    let magnitude = positions
        .iter()
        .map(|position| position.magnitude())
        .max()
        .unwrap_or(0);
    let readable = (-3..=4).contains(&magnitude);
    let label = |position: Decimal| {
        if readable {
            position.plain()
        } else {
            position.scientific(magnitude)
        }
    };
    positions
        .into_iter()
        .map(|position| Tick {
            coordinate: position.coordinate(scale),
            label: label(position),
        })
        .collect()
}

/// The smallest of 1, 2, 5 times a power of ten that is not below the raw step.
fn round_step(raw: f64) -> Decimal {
    let exponent = raw.log10().floor() as i32;
    let ratio = raw / 10f64.powi(exponent);
    match [1, 2, 5]
        .into_iter()
        .find(|digits| ratio <= *digits as f64 + 1e-9)
    {
        Some(digits) => Decimal { digits, exponent },
        None => Decimal {
            digits: 1,
            exponent: exponent + 1,
        },
    }
}

fn logarithmic(range: (f64, f64), wanted: i32) -> Ticks {
    let first = (range.0 - 1e-9).ceil() as i32;
    let last = (range.1 + 1e-9).floor() as i32;
    if last > first {
        return decades(first, last, range, wanted);
    }
    let between = |digits: &[i64]| multiples(digits, first - 1, last + 1, range);
    let values = (10f64.powf(range.0), 10f64.powf(range.1));
    let major = match between(&[1, 2, 5]) {
        sparse if sparse.len() < 3 => linear(values, wanted.min(4), Scale::Logarithmic),
        dense => labelled(&dense),
    };
    Ticks {
        major,
        minor: unlabelled(&between(&[1, 2, 3, 4, 5, 6, 7, 8, 9])),
    }
}

fn decades(first: i32, last: i32, range: (f64, f64), wanted: i32) -> Ticks {
    let count = last - first + 1;
    let mut strides = [1, 2, 3, 5, 10, 20, 50].into_iter();
    let stride = strides
        .find(|stride| count <= stride * wanted)
        .unwrap_or(200);
    let powers = |kept: &dyn Fn(&i32) -> bool| -> Vec<Decimal> {
        let exponents = (first..=last).filter(kept);
        exponents
            .map(|exponent| Decimal {
                digits: 1,
                exponent,
            })
            .collect()
    };
    let minor = match stride {
        1 => multiples(&[2, 3, 4, 5, 6, 7, 8, 9], first - 1, last, range),
        2..=5 => powers(&|exponent| exponent.rem_euclid(stride) != 0),
        _ => Vec::new(),
    };
    let major = labelled(&powers(&|exponent| exponent.rem_euclid(stride) == 0));
    Ticks {
        major,
        minor: unlabelled(&minor),
    }
}

fn multiples(digits: &[i64], first: i32, last: i32, (low, high): (f64, f64)) -> Vec<Decimal> {
    let decade = |exponent| {
        digits
            .iter()
            .map(move |&digits| Decimal { digits, exponent })
    };
    let inside =
        |position: &Decimal| (low..=high).contains(&position.coordinate(Scale::Logarithmic));
    (first..=last).flat_map(decade).filter(inside).collect()
}

fn unlabelled(positions: &[Decimal]) -> Vec<f64> {
    positions
        .iter()
        .map(|position| position.coordinate(Scale::Logarithmic))
        .collect()
}

fn labelled(positions: &[Decimal]) -> Vec<Tick> {
    let readable = positions
        .iter()
        .all(|position| (-2..=3).contains(&position.magnitude()));
    let label = |position: &Decimal| match *position {
        position if readable => position.plain(),
        Decimal {
            digits: 1,
            exponent,
        } => power_of_ten(exponent),
        position => position.scientific(position.magnitude()),
    };
    let tick = |position: &Decimal| Tick {
        coordinate: position.coordinate(Scale::Logarithmic),
        label: label(position),
    };
    positions.iter().map(tick).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn coordinates(scale: Scale, values: (f64, f64)) -> (f64, f64) {
        (scale.forward(values.0), scale.forward(values.1))
    }

    fn labels(scale: Scale, values: (f64, f64), wanted: i32) -> Vec<String> {
        Ticks::in_range(scale, coordinates(scale, values), wanted)
            .major
            .into_iter()
            .map(|tick| tick.label)
            .collect()
    }

    #[test]
    fn linear_labels_are_plain_where_readable_and_scientific_elsewhere() {
        assert_eq!(
            labels(Scale::Linear, (-0.13, 0.21), 4),
            ["−0.1", "0.0", "0.1", "0.2"]
        );
        assert_eq!(
            labels(Scale::Linear, (0.0, 1.3e-9), 3),
            ["0", "0.5·10⁻⁹", "1.0·10⁻⁹"]
        );
        assert_eq!(
            labels(Scale::Linear, (-1.7e-9, 1.2e-9), 3),
            ["−1·10⁻⁹", "0", "1·10⁻⁹"]
        );
        assert_eq!(
            labels(Scale::Linear, (0.0, 1.3e7), 5),
            ["0", "0.5·10⁷", "1.0·10⁷"]
        );
    }

    #[test]
    fn a_large_offset_keeps_every_digit() {
        assert_eq!(
            labels(Scale::Linear, (26.5567180009, 26.5567180031), 3),
            ["26.556718001", "26.556718002", "26.556718003"]
        );
    }

    #[test]
    fn logarithmic_labels_are_decades_or_their_multiples() {
        assert_eq!(
            labels(Scale::Logarithmic, (5e-5, 2e-2), 8),
            ["10⁻⁴", "10⁻³", "10⁻²"]
        );
        assert_eq!(
            labels(Scale::Logarithmic, (0.05, 200.0), 8),
            ["0.1", "1", "10", "100"]
        );
        assert_eq!(
            labels(Scale::Logarithmic, (9e-4, 6e-3), 8),
            ["10⁻³", "2·10⁻³", "5·10⁻³"]
        );
        assert_eq!(
            labels(Scale::Logarithmic, (1e-13, 1.0), 5),
            ["10⁻¹²", "10⁻⁹", "10⁻⁶", "10⁻³", "10⁰"]
        );
    }

    #[test]
    fn every_magnitude_gets_few_increasing_ticks_inside_the_range() {
        for exponent in -300..300 {
            let unit = 10f64.powi(exponent);
            for (scale, range) in [
                (Scale::Linear, (-0.37 * unit, 0.91 * unit)),
                (Scale::Linear, (7.77 * unit, 7.7701 * unit)),
                (Scale::Logarithmic, (1.1 * unit, 1.2 * unit)),
                (Scale::Logarithmic, (1e-305, 3.0 * unit)),
            ] {
                let range = coordinates(scale, range);
                let Ticks { major, minor } = Ticks::in_range(scale, range, 6);
                assert!(
                    (1..=12).contains(&major.len()),
                    "{scale:?} {range:?}: {major:?}"
                );
                let slack = 1e-8 * (range.1 - range.0);
                let inside = (range.0 - slack)..=(range.1 + slack);
                assert!(major.iter().all(|tick| inside.contains(&tick.coordinate)));
                assert!(
                    major
                        .windows(2)
                        .all(|pair| pair[0].coordinate < pair[1].coordinate)
                );
                assert!(minor.len() < 80);
            }
        }
    }
}

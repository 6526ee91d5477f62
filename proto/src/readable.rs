//! Numbers in messages for people.

/// Digits that a number may have to be shown whole: whoever wrote it finds it again.
const WHOLE: usize = 9;

/// Digits of other numbers, which were computed.
const DIGITS: usize = 4;

/// Digits of times that were computed: enough to find them in a table.
const DIGITS_OF_TIMES: usize = 9;

/// A number that is read and not calculated with: whole if it is short, otherwise with 4 digits.
pub fn number(value: f64) -> String {
    with_digits(value, DIGITS)
}

/// A time in s: whole if it is short, otherwise with 9 digits.
pub fn time(seconds: f64) -> String {
    with_digits(seconds, DIGITS_OF_TIMES)
}

fn with_digits(value: f64, digits: usize) -> String {
    if !value.is_finite() || value == 0.0 {
        return value.abs().to_string().replace("inf", infinity(value));
    }
    let shortest = format!("{value:e}");
    let mantissa = shortest.split('e').next().unwrap_or_default();
    let has_few = mantissa.bytes().filter(u8::is_ascii_digit).count() <= WHOLE;
    let shown = match has_few {
        true => value,
        // Through its text, so that no digits of rounding follow.
        false => format!("{value:.*e}", digits - 1).parse().unwrap_or(value),
    };
    match shown.abs() {
        1e-4..1e7 => shown.to_string(),
        _ => format!("{shown:e}"),
    }
}

fn infinity(value: f64) -> &'static str {
    match value.is_sign_negative() {
        true => "-inf",
        false => "inf",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn numbers_read_as_people_write_them() {
        for (value, expected) in [
            (1.6915224193078053, "1.692"),
            (-1.6915224193078053, "-1.692"),
            (0.00000000010000000000000002, "1e-10"),
            (0.1 + 0.2, "0.3"),
            (1e-3, "0.001"),
            (1e-9, "1e-9"),
            (0.0009765625, "0.0009765625"),
            (1e9, "1e9"),
            (5000.0, "5000"),
            (5e299, "5e299"),
            (0.0, "0"),
            (-0.0, "0"),
            (f64::NEG_INFINITY, "-inf"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(number(value), expected, "{value:e}");
        }
        assert_eq!(time(1234.567 + 1e-12), "1234.567");
        assert_eq!(time(0.017), "0.017");
    }

    proptest! {
        #[test]
        fn what_is_shown_is_near_and_short(value in proptest::num::f64::NORMAL) {
            for (shown, error) in [(number(value), 5e-4), (time(value), 5e-9)] {
                let back: f64 = shown.parse().unwrap();
                prop_assert!((back - value).abs() <= error * value.abs(), "{shown} {value:e}");
                prop_assert!(shown.len() < 20, "{shown}");
            }
        }
    }
}

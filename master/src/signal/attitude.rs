//! The rotation vector as a coupling variable: attitude relative to that at the present macro point.
//!
//! `q = exp(phi) q_N` with `phi` (rad) in inertial axes. Unlike three angles of fixed axes it has no attitude at which it
//! becomes singular, because it starts from 0 in every macro step.

use std::f64::consts::{PI, TAU};

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// `phi` of the attitude `q` relative to `reference`, of all that differ by whole turns the one nearest to `near`.
pub fn rotation_vector(
    reference: &UnitQuaternion<f64>,
    q: &UnitQuaternion<f64>,
    near: &Vector3<f64>,
) -> Vector3<f64> {
    let shortest = (q * reference.inverse()).scaled_axis();
    let angle = shortest.norm();
    if near.norm() + angle <= PI || angle == 0.0 {
        return shortest;
    }
    let axis = shortest / angle;
    let turns = ((axis.dot(near) - angle) / TAU).round();
    axis * (angle + TAU * turns)
}

/// The attitude `exp(phi) reference`.
pub fn attitude(reference: &UnitQuaternion<f64>, phi: &Vector3<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::from_scaled_axis(*phi) * reference
}

/// The unit quaternion of outputs `(w, x, y, z)`.
pub fn unit_quaternion([w, x, y, z]: [f64; 4]) -> UnitQuaternion<f64> {
    UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z))
}

/// Rotation vector, in inertial axes, of a small change of the quaternion `q = (w, x, y, z)`: twice the vector part of
/// `dq q*`.
pub fn small_rotation(q: [f64; 4], change: [f64; 4]) -> Vector3<f64> {
    let change = Quaternion::new(change[0], change[1], change[2], change[3]);
    let length = q.iter().map(|part| part * part).sum::<f64>().sqrt();
    let attitude = unit_quaternion(q);
    2.0 / length * (change * attitude.quaternion().conjugate()).imag()
}

/// The derivatives of a number with respect to the quaternion `q = (w, x, y, z)`, where `by` are those with respect to its
/// [`small_rotation`].
pub fn quaternion_gradient(q: [f64; 4], by: &Vector3<f64>) -> [f64; 4] {
    let length = q.iter().map(|part| part * part).sum::<f64>().sqrt();
    let factor = 2.0 / (length * length);
    let [w, x, y, z] = q;
    let vector = Vector3::new(x, y, z);
    let by_vector = w * by + by.cross(&vector);
    [-by.dot(&vector), by_vector.x, by_vector.y, by_vector.z].map(|part| factor * part)
}

/// Change of `phi` under a small further rotation `theta` (inertial axes):
/// `theta - phi x theta / 2 + c phi x (phi x theta)` with `c = (1 - (p/2) cot(p/2)) / p^2`, `p = |phi|`.
pub fn vector_change(phi: &Vector3<f64>, theta: &Vector3<f64>) -> Vector3<f64> {
    let angle = phi.norm();
    let c = if angle < SMALL {
        1.0 / 12.0 + angle * angle / 720.0
    } else {
        (1.0 - 0.5 * angle / (0.5 * angle).tan()) / (angle * angle)
    };
    let turned = phi.cross(theta);
    theta - 0.5 * turned + c * phi.cross(&turned)
}

/// Derivative of [`vector_change`] with respect to `phi` in the direction `d`, for the same `theta`:
/// `-d x theta / 2 + c (d x (phi x theta) + phi x (d x theta)) + (c'/p) (phi . d) phi x (phi x theta)`.
pub fn vector_change_rate(
    phi: &Vector3<f64>,
    theta: &Vector3<f64>,
    d: &Vector3<f64>,
) -> Vector3<f64> {
    let angle = phi.norm();
    let square = angle * angle;
    let (c, slope) = if angle < SMALL {
        (1.0 / 12.0 + square / 720.0, 1.0 / 360.0)
    } else {
        let half = 0.5 * angle;
        let c = (1.0 - half / half.tan()) / square;
        let of_square = (half / half.sin().powi(2) - 1.0 / half.tan()) / (4.0 * angle);
        (c, 2.0 * (of_square - c) / square)
    };
    let turned = phi.cross(theta);
    -0.5 * d.cross(theta)
        + c * (d.cross(&turned) + phi.cross(&d.cross(theta)))
        + slope * phi.dot(d) * phi.cross(&turned)
}

/// The small further rotation of a change of `phi`, the inverse of [`vector_change`]:
/// `d + a phi x d + b phi x (phi x d)` with `a = (1 - cos p) / p^2`, `b = (p - sin p) / p^3`.
pub fn rotation_of_change(phi: &Vector3<f64>, change: &Vector3<f64>) -> Vector3<f64> {
    let angle = phi.norm();
    let square = angle * angle;
    let (a, b) = if angle < SMALL {
        (0.5 - square / 24.0, 1.0 / 6.0 - square / 120.0)
    } else {
        (
            (1.0 - angle.cos()) / square,
            (angle - angle.sin()) / (square * angle),
        )
    };
    let turned = phi.cross(change);
    change + a * turned + b * phi.cross(&turned)
}

/// Below this angle (rad) the first terms of the series are exact to rounding.
const SMALL: f64 = 1e-3;

/// Attitudes as the components `w, x, y, z` of their quaternions, bit by bit.
pub mod quaternions {
    use nalgebra::{Quaternion, UnitQuaternion};
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    /// Writes them.
    ///
    /// # Errors
    /// Those of the serializer.
    pub fn serialize<S: Serializer>(
        attitudes: &[UnitQuaternion<f64>],
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        let components = attitudes.iter().map(|q| [q.w, q.i, q.j, q.k]);
        components.collect::<Vec<_>>().serialize(serializer)
    }

    /// Reads them.
    ///
    /// # Errors
    /// Those of the deserializer.
    pub fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Vec<UnitQuaternion<f64>>, D::Error> {
        let components = Vec::<[f64; 4]>::deserialize(deserializer)?;
        let attitude =
            |[w, x, y, z]: [f64; 4]| UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z));
        Ok(components.into_iter().map(attitude).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vector() -> impl Strategy<Value = Vector3<f64>> {
        proptest::array::uniform3(-1.7f64..1.7).prop_map(Vector3::from)
    }

    fn reference() -> UnitQuaternion<f64> {
        unit_quaternion([0.3, -0.5, 0.7, 0.2])
    }

    proptest! {
        #[test]
        fn the_vector_comes_back(phi in vector()) {
            let q = attitude(&reference(), &phi);
            let back = rotation_vector(&reference(), &q, &(phi * 1.1));
            prop_assert!((back - phi).norm() < 1e-12, "{back} {phi}");
        }

        #[test]
        fn changes_are_differences(phi in vector(), theta in vector(), scale in 1e-5f64..1.0) {
            let phi = phi * scale;
            let step = 1e-6;
            let at = |s: f64| {
                let q = UnitQuaternion::from_scaled_axis(s * theta) * attitude(&reference(), &phi);
                rotation_vector(&reference(), &q, &phi)
            };
            let difference = (at(step) - at(-step)) / (2.0 * step);
            let change = vector_change(&phi, &theta);
            prop_assert!((difference - change).norm() < 1e-7, "{difference} {change}");
            prop_assert!((rotation_of_change(&phi, &change) - theta).norm() < 1e-10);
        }

        #[test]
        fn changes_of_changes_are_differences(
            phi in vector(),
            theta in vector(),
            d in vector(),
            scale in 1e-5f64..1.0,
        ) {
            let phi = phi * scale;
            let step = 1e-6;
            let at = |s: f64| vector_change(&(phi + s * d), &theta);
            let difference = (at(step) - at(-step)) / (2.0 * step);
            let rate = vector_change_rate(&phi, &theta, &d);
            prop_assert!((difference - rate).norm() < 1e-7, "{difference} {rate}");
        }

        #[test]
        fn gradients_by_quaternions_are_those_by_their_rotations(
            by in vector(),
            q in proptest::array::uniform4(0.1f64..1.0),
            change in proptest::array::uniform4(-1.0f64..1.0),
        ) {
            let gradient = quaternion_gradient(q, &by);
            let own: f64 = gradient.iter().zip(&change).map(|(by, change)| by * change).sum();
            let expected = by.dot(&small_rotation(q, change));
            prop_assert!((own - expected).abs() < 1e-12 * (1.0 + 100.0 * by.norm()), "{own} {expected}");
        }

        #[test]
        fn quaternion_changes_are_rotations(theta in vector(), q in proptest::array::uniform4(0.1f64..1.0)) {
            let step = 1e-6;
            let at = |s: f64| {
                let turned = UnitQuaternion::from_scaled_axis(s * theta) * unit_quaternion(q);
                [turned.w, turned.i, turned.j, turned.k]
            };
            let (low, high) = (at(-step), at(step));
            let change = std::array::from_fn(|part| (high[part] - low[part]) / (2.0 * step));
            prop_assert!((small_rotation(at(0.0), change) - theta).norm() < 1e-8);
        }
    }
}

//! Activity rules: which contacts take part (S2 Sect. 2.3).

use super::system::{Contact, Side};

/// The contacts that are closed, `g_N <= 0` (S2 eqs. 5, 41), and all that are bilateral.
pub fn closed_contacts(contacts: &[Contact], gaps: &[f64], closed: &mut [bool]) {
    for ((closed, contact), &gap) in closed.iter_mut().zip(contacts).zip(gaps) {
        *closed = contact.side == Side::Bilateral || gap <= 0.0;
    }
}

/// Whether a contact was open at the start of the step and is closed at its end: an impact (S2 eq. 18).
pub fn closes_anew(before: &[bool], after: &[bool]) -> bool {
    before
        .iter()
        .zip(after)
        .any(|(&before, &after)| !before && after)
}

//! On what past the curves in which inputs are raised depend.

/// The past nodes of the curves in which inputs are raised, if these depend on them, and how many of them each uses.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Nodes<'a> {
    /// Times of past macro points relative to the present one in s.
    pub times: &'a [f64],
    /// Degrees of the polynomials of all coupling variables.
    pub degrees: &'a [usize],
}

//! A planar Euler-Bernoulli rod in a floating frame of reference (S2 App. C, D).
//!
//! The frame has its origin at the root of the rod and its x axis along the rod without deformation. A particle of that
//! rod is at `u = u_0 + S q_f` of the frame, with `u_0 = (x, y)` its place without deformation (115). The rod has
//! elements of the same length with `u`, `w` and `w'` at each node, in this order from the root on: linear along, cubic
//! across (110).
//!
//! * [`element`]: the integrals over one element in closed form;
//! * [`integrals`]: those over the rod, in the coordinates asked for;
//! * [`coordinates`]: which nodal values are coordinates, and how to get all of them back;
//! * [`modes`]: eigenvectors; [`body`]: the rod with a mass at its end, as a mechanism needs it.

pub mod body;
pub mod coordinates;
pub mod element;
pub mod integrals;
pub mod modes;

pub use body::RodBody;

/// A rod of constant section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rod {
    /// Length (m).
    pub length: f64,
    /// Elements, 1 or more.
    pub elements: usize,
    /// Young's modulus (N/m^2).
    pub youngs_modulus: f64,
    /// Density (kg/m^3).
    pub density: f64,
    /// Cross-section.
    pub section: Section,
    /// Where the inertia of rotating sections counts.
    pub rotary_inertia: RotaryInertia,
    /// What the frame is tied to.
    pub reference: Reference,
    /// Modes that are kept, the lowest ones; `None`: all nodal values are coordinates.
    pub modes: Option<usize>,
    /// Damping of the material (s): a rate of strain stresses it like the strain over this time would. 0 or greater.
    pub material_damping: f64,
}

/// A cross-section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Section {
    /// Area `A` (m^2).
    pub area: f64,
    /// Second moment of area `I` about the axis of bending (m^4).
    pub second_moment: f64,
}

/// A rectangular cross-section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rectangle {
    /// Across the plane of motion, `H` (m).
    pub width: f64,
    /// In the plane of motion, `D` (m).
    pub depth: f64,
}

/// Where the inertia `rho I` of sections that rotate counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RotaryInertia {
    /// Only for the rotation of the frame, by the term `y^2` of S2 (134). Then the motion depends on the reference,
    /// slightly.
    Frame,
    /// For the rotation `w'` of the sections too: a particle is at `(x + u - y w', y + w)`, and all integrals are those
    /// of this field.
    Consistent,
}

/// What the frame is tied to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reference {
    /// To the tangent at the root, S2 (182): `u = w = w' = 0` there.
    Tangential,
    /// To both ends, S2 (183): `u = w = 0` at the root, `w = 0` at the end.
    Pinned,
}

/// What is wrong with the description of a rod.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum RodError {
    /// A value out of range.
    #[error("{what} of the rod is {value}: it must be greater than 0")]
    NotPositive {
        /// Of what.
        what: &'static str,
        /// As given.
        value: f64,
    },
    /// Damping out of range.
    #[error("the material damping of the rod is {0} s: it must be 0 or greater")]
    Damping(f64),
    /// Elements.
    #[error("the rod has no elements: 1 or more are needed")]
    NoElements,
    /// Modes.
    #[error("the rod has {available} modes, {modes} are asked for: take 1 to {available}")]
    Modes {
        /// As given.
        modes: usize,
        /// As many as coordinates.
        available: usize,
    },
    /// No rectangle has this inertia.
    #[error(
        "a rod of {mass} kg and {length} m has an inertia above {thin} kg m^2, but {inertia} is given"
    )]
    TooThin {
        /// Mass (kg).
        mass: f64,
        /// Length (m).
        length: f64,
        /// Inertia (kg m^2).
        inertia: f64,
        /// The same of a line: `m l^2 / 12`.
        thin: f64,
    },
    /// The eigenvectors were not found.
    #[error(
        "the modes of the rod were not found: its mass or stiffness matrix is not positive definite"
    )]
    NoModes,
}

impl Rectangle {
    /// The section of S2 Table 1: that with which a rod of length `l` has mass `m` and moment of inertia `J` about its
    /// centre,
    /// `D^2 = 12 J/m - l^2`, `H = m / (rho l D)`.
    ///
    /// # Errors
    /// [`RodError::TooThin`].
    pub fn of_inertia(
        mass: f64,
        inertia: f64,
        length: f64,
        density: f64,
    ) -> Result<Self, RodError> {
        let square = 12.0 * inertia / mass - length * length;
        if square > 0.0 && square.is_finite() {
            let depth = square.sqrt();
            let width = mass / (density * length * depth);
            return Ok(Self { width, depth });
        }
        let thin = mass * length * length / 12.0;
        Err(RodError::TooThin {
            mass,
            length,
            inertia,
            thin,
        })
    }

    /// `A = H D`, `I = H D^3 / 12`.
    pub fn section(&self) -> Section {
        Section {
            area: self.width * self.depth,
            second_moment: self.width * self.depth.powi(3) / 12.0,
        }
    }
}

impl Rod {
    /// Elastic, all nodal values as coordinates, with the choices of S2: tangential, `y^2` term.
    pub fn new(
        length: f64,
        elements: usize,
        [youngs_modulus, density]: [f64; 2],
        section: Section,
    ) -> Self {
        Self {
            length,
            elements,
            youngs_modulus,
            density,
            section,
            rotary_inertia: RotaryInertia::Frame,
            reference: Reference::Tangential,
            modes: None,
            material_damping: 0.0,
        }
    }

    /// Mass (kg).
    pub fn mass(&self) -> f64 {
        self.density * self.section.area * self.length
    }

    /// Nodes.
    pub fn nodes(&self) -> usize {
        self.elements + 1
    }

    /// What is wrong with it, if anything.
    ///
    /// # Errors
    /// [`RodError`].
    pub fn check(&self) -> Result<(), RodError> {
        let positive = [
            ("the length", self.length),
            ("Young's modulus", self.youngs_modulus),
            ("the density", self.density),
            ("the area of the section", self.section.area),
            ("the second moment of area", self.section.second_moment),
        ];
        for (what, value) in positive {
            if !(value > 0.0 && value.is_finite()) {
                return Err(RodError::NotPositive { what, value });
            }
        }
        if !(self.material_damping >= 0.0 && self.material_damping.is_finite()) {
            return Err(RodError::Damping(self.material_damping));
        }
        if self.elements == 0 {
            return Err(RodError::NoElements);
        }
        // Three nodal values are tied to the frame.
        let available = 3 * self.nodes() - 3;
        match self.modes {
            Some(modes) if modes == 0 || modes > available => {
                Err(RodError::Modes { modes, available })
            }
            _ => Ok(()),
        }
    }
}

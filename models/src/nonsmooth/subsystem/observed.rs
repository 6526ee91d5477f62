//! What a system shows besides coordinates and contacts.

/// Motion of a system at an instant.
#[derive(Debug, Clone, Copy)]
pub struct Motion<'a> {
    /// Coordinates.
    pub q: &'a [f64],
    /// Velocities.
    pub v: &'a [f64],
    /// Accelerations; zeros where they were not asked for.
    pub a: &'a [f64],
}

/// Motion of a marker in the plane: `(x, y, angle)`, its rates, and their rates.
pub type PointMotion = [[f64; 3]; 3];

/// What looks at the motion of a system for its own outputs and markers.
pub trait Observer: Send {
    /// Value of the system's own output number `output`, in the order of its face.
    fn own_output(&self, _output: usize, _motion: Motion<'_>) -> f64 {
        f64::NAN
    }

    /// Motion of marker number `marker`, in the order of its face.
    fn marker(&self, _marker: usize, _motion: Motion<'_>) -> PointMotion {
        [[0.0; 3]; 3]
    }
}

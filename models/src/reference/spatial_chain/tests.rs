use super::*;

fn chains() -> [SpatialChain; 2] {
    [
        SpatialChain::universal_double_pendulum(),
        SpatialChain::revolute_double_pendulum(),
    ]
}

/// `q' M q' / 2` is the kinetic energy of the bodies, by the velocities that their frames have found.
#[test]
fn the_mass_matrix_is_that_of_the_kinetic_energy() {
    for chain in chains() {
        let now = Configuration::new(&chain, &chain.coordinates, &chain.rates);
        let rates = nalgebra::DVector::from_column_slice(&chain.rates);
        let own = 0.5 * rates.dot(&(now.mass_matrix() * &rates));
        let bodies = chain.bodies.iter().map(|body| body.body);
        let energies = bodies.zip(now.motions());
        let energy: f64 = energies
            .map(|(body, motion)| body.kinetic_energy(&motion))
            .sum();
        assert!((own / energy - 1.0).abs() < 1e-14, "{own} {energy}");
    }
}

#[test]
fn the_mass_matrix_is_symmetric_and_positive_definite() {
    for chain in chains() {
        let matrix = Configuration::new(&chain, &chain.coordinates, &chain.rates).mass_matrix();
        assert!((&matrix - matrix.transpose()).amax() < 1e-15);
        let eigenvalues = matrix.symmetric_eigenvalues();
        assert!(eigenvalues.min() > 1e-3, "{eigenvalues}");
    }
}

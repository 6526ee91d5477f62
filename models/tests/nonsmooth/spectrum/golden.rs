//! Spectra against golden data.

use std::path::Path;

use linchpin_models::nonsmooth::schemes::SchemeKind;

use super::{NEWMARK, ed, optimal, spectra};

const TOLERANCE: f64 = 1e-9;

fn scheme(name: &str) -> SchemeKind {
    match name {
        "Newmark (1/2,1/4)" => NEWMARK,
        "Bathe" => SchemeKind::Bathe,
        "HETS" => SchemeKind::Hets,
        "Moreau" => SchemeKind::Moreau,
        _ => match name.split_once(" rho=").unwrap() {
            ("gen-a", rho) => optimal(rho.parse().unwrap()),
            ("ED-a", rho) => ed(rho.parse().unwrap()),
            _ => panic!("no scheme {name}"),
        },
    }
}

fn agrees(own: Option<f64>, golden: f64) -> bool {
    match own {
        None => golden.is_nan(),
        Some(own) => (own - golden).abs() <= TOLERANCE * golden.abs().max(1.0),
    }
}

#[test]
fn all_schemes() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/golden/s2/spectral.csv");
    let text = std::fs::read_to_string(file).unwrap();
    let mut count = 0;
    for line in text.lines().skip(1) {
        // Numbers from the right: a name may have a comma.
        let fields: Vec<&str> = line.rsplitn(5, ',').collect();
        let [period_error, principal, radius, ratio] =
            [0, 1, 2, 3].map(|field| fields[field].parse::<f64>().unwrap());
        let own = spectra(scheme(fields[4]), &[ratio])[0];
        assert!(agrees(Some(own.radius), radius), "{line}: {own:?}");
        assert!(
            agrees(own.principal_modulus(), principal),
            "{line}: {own:?}"
        );
        assert!(agrees(own.period_error(), period_error), "{line}: {own:?}");
        count += 1;
    }
    assert_eq!(count, 451);
}

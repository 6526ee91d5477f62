//! The stability rules against the facts they state and against the macro-step map of a free coordinate.

use super::super::{highest_stable_degree, warnings};
use super::coupled;

const H: f64 = 1e-3;

fn warned_keys(settings: &str) -> Vec<&'static str> {
    let scene = coupled(settings).unwrap_or_else(|errors| panic!("{errors}"));
    warnings(&scene).iter().map(|warning| warning.key).collect()
}

#[test]
fn good_combinations_are_not_warned_about() {
    for settings in [
        "method = 'baumgarte'\nindex = 2\ndegree = 0",
        "method = 'baumgarte'\nindex = 3\ndegree = 0",
        "method = 'weighted'\na = 1\nb = 1\ndegree = 1",
        "method = 'weighted'\na = 2\nb = 4\ndegree = 3",
        "method = 'weighted'\na = 2\nb = 0.5\ndegree = 1",
        "method = 'penalty'\nstiffness = 1e6\ndegree = 2",
    ] {
        assert_eq!(warned_keys(settings), [""; 0], "{settings}");
    }
    for degree in 0..=3 {
        let defaults = format!("method = 'weighted'\ndegree = {degree}");
        assert_eq!(warned_keys(&defaults), [""; 0], "{defaults}");
        let defaults = format!("method = 'baumgarte'\ndegree = {degree}");
        assert_eq!(warned_keys(&defaults), [""; 0], "{defaults}");
    }
}

#[test]
fn known_instabilities_are_warned_about() {
    for (settings, key) in [
        (
            "method = 'weighted'\na = 1\nb = 1\ndegree = 2",
            "coupling.b",
        ),
        (
            "method = 'weighted'\na = 2\nb = 0.49\ndegree = 1",
            "coupling.b",
        ),
        (
            "method = 'weighted'\na = 2\nb = 2.51\ndegree = 3",
            "coupling.b",
        ),
        (
            "method = 'baumgarte'\nbeta = 2e-1\ngamma = 8e-8\ndegree = 1",
            "coupling.gamma",
        ),
        (
            "method = 'baumgarte'\nbeta = '5H'\ngamma = '0.9 H^2'\ndegree = 2",
            "coupling.gamma",
        ),
        (
            "method = 'baumgarte'\nindex = 2\ndegree = 1",
            "coupling.degree",
        ),
        (
            "method = 'weighted'\nindex = 2\ndegree = 2",
            "coupling.degree",
        ),
        (
            "method = 'weighted'\nindex = 3\ndegree = 1",
            "coupling.degree",
        ),
    ] {
        assert_eq!(warned_keys(settings), [key], "{settings}");
    }
}

#[test]
fn a_warning_names_rule_numbers_remedy_and_place() {
    let scene = coupled("method = 'weighted'\na = 1\nb = 1\ndegree = 2").unwrap();
    let shown = warnings(&scene)[0].to_string();
    for words in [
        "scene.toml:",
        "index 1, degree 2",
        "b = 1.0",
        "0.6667 + 0.4000 a = 1.0667",
        "a = 2 and b = 2.6",
    ] {
        assert!(shown.contains(words), "{words:?} is missing in {shown}");
    }
    let place = warnings(&scene)[0].place.clone().unwrap();
    assert_eq!(&place.text()[place.span.clone()], "1");
    let default_degree = coupled("method = 'baumgarte'\nindex = 3").unwrap();
    assert!(warnings(&default_degree)[0].place.is_some());
}

/// Position and velocity after a unit step of a free unit mass, for each node of the multiplier, newest first.
fn responses(degree: usize) -> Vec<(f64, f64)> {
    let nodes: Vec<f64> = (0..=degree).map(|j| 1.0 - j as f64).collect();
    nodes
        .iter()
        .map(|&node| {
            let mut basis = vec![1.0];
            for &other in nodes.iter().filter(|&&other| other != node) {
                let mut product = vec![0.0; basis.len() + 1];
                for (power, c) in basis.iter().enumerate() {
                    product[power] -= c * other / (node - other);
                    product[power + 1] += c / (node - other);
                }
                basis = product;
            }
            let integral = |order: f64| -> f64 {
                let terms = basis.iter().enumerate();
                terms
                    .map(|(n, c)| c / (n as f64 + 1.0) / (n as f64 + 2.0).powf(order))
                    .sum()
            };
            (integral(1.0), integral(0.0))
        })
        .collect()
}

/// Size of a free relative coordinate after many macro steps of length 1 under g + beta g' + gamma g'' = 0.
fn size_after(steps: usize, degree: usize, beta: f64, gamma: f64) -> f64 {
    let responses = responses(degree);
    let (mut g, mut v) = (1.0, 0.3);
    let mut history = vec![0.2; degree];
    for _ in 0..steps {
        let known = |pick: fn(&(f64, f64)) -> f64| -> f64 {
            responses[1..]
                .iter()
                .zip(&history)
                .map(|(r, l)| pick(r) * l)
                .sum()
        };
        let (free_g, free_v) = (g + v + known(|r| r.0), v + known(|r| r.1));
        let (x_new, v_new) = responses[0];
        let multiplier = -(free_g + beta * free_v) / (x_new + beta * v_new + gamma);
        (g, v) = (free_g + x_new * multiplier, free_v + v_new * multiplier);
        history.insert(0, multiplier);
        history.truncate(degree);
        if g.abs() > 1e100 {
            break;
        }
    }
    g.abs() + v.abs()
}

#[test]
fn the_rules_are_the_limits_of_the_macro_step_map() {
    for degree in 1..=3 {
        for beta in [0.57, 1.3, 2.0, 4.7] {
            let warned = |gamma: f64| {
                let settings = format!(
                    "method = 'baumgarte'\nbeta = {:e}\ngamma = {:e}\ndegree = {degree}",
                    beta * H,
                    gamma * H * H
                );
                !warned_keys(&settings).is_empty()
            };
            let (mut unstable, mut stable) = (0.01, 10.0);
            for _ in 0..30 {
                let middle = 0.5 * (unstable + stable);
                if warned(middle) {
                    unstable = middle;
                } else {
                    stable = middle;
                }
            }
            let size = |gamma| size_after(20_000, degree, beta, gamma);
            let (below, above) = (size(0.97 * unstable), size(1.03 * stable));
            assert!(
                below > 1e3,
                "degree {degree}, beta {beta}: {below} below {unstable}"
            );
            assert!(
                above < 1.0,
                "degree {degree}, beta {beta}: {above} above {stable}"
            );
        }
    }
}

#[test]
fn index_2_and_3_grow_at_every_higher_degree() {
    for degree in 1..=3 {
        assert!(size_after(300, degree, 0.0, 0.0) > 1e100);
        assert!(size_after(300, degree, 20.0, 0.0) > 1e1);
    }
}

#[test]
fn an_automatic_degree_keeps_the_rules() {
    for (settings, highest) in [
        ("method = 'weighted'", 3),
        ("method = 'weighted'\na = 1\nb = 1", 1),
        ("method = 'weighted'\nindex = 2", 0),
        ("method = 'weighted'\nindex = 3", 0),
        ("method = 'baumgarte'", 3),
        ("method = 'baumgarte'\nindex = 2", 0),
        ("method = 'baumgarte'\nindex = 3", 0),
        ("method = 'baumgarte'\nbeta = '5H'\ngamma = '0.9 H^2'", 1),
        ("method = 'baumgarte'\nbeta = '5H'\ngamma = '0.08 H^2'", 0),
        (
            "method = 'baumgarte'\nbeta = '5H'\ngamma = '0.95 H^2'\ntolerance = 1e-6",
            2,
        ),
    ] {
        let scene = coupled(&format!("{settings}\ndegree = 'automatic'")).unwrap();
        let found = highest_stable_degree(scene.coupling.method, H);
        assert_eq!(found, highest, "{settings}");
        assert!(warnings(&scene).is_empty(), "{settings}");
        for degree in 0..=3 {
            let warned = warned_keys(&format!("{settings}\ndegree = {degree}"));
            assert_eq!(warned.is_empty(), degree <= highest, "{settings}: {degree}");
        }
    }
}

/// gamma = 1e-6 against H^2/12 + beta H/6 and 7/90 H^2 + beta H/3 for beta = 2e-3.
#[test]
fn parameters_that_do_not_follow_the_step_allow_lower_degrees_for_longer_ones() {
    let settings = "method = 'baumgarte'\nbeta = 2e-3\ngamma = 1e-6\ntolerance = 1e-6";
    let method = coupled(settings).unwrap().coupling.method;
    for (length, highest) in [
        (1.29e-3, 3),
        (1.31e-3, 2),
        (1.99e-3, 2),
        (2.01e-3, 1),
        (3.45e-3, 1),
        (3.48e-3, 0),
    ] {
        assert_eq!(highest_stable_degree(method, length), highest, "{length}");
    }
}

#[test]
fn the_explicit_method_needs_a_time_constant_of_at_least_one_macro_step() {
    assert_eq!(warned_keys("method = 'explicit'\nmu = '1H'"), [""; 0]);
    assert_eq!(
        warned_keys("method = 'explicit'\nmu = '0.99H'"),
        ["coupling.mu"]
    );
}

//! Users' mistakes in `[coupling]`: methods, their parameters and the index.

use super::{assert_mistake, assert_words, coupled, line_of, only};

/// One mistake in the `[coupling]` section: the text at which it must show, and words of its message.
fn assert_coupling_mistake(settings: &str, at: &str, words: &[&str]) {
    let error = only(coupled(settings).unwrap_err());
    assert_words(&error, words);
    let place = error.place.unwrap();
    assert_eq!(place.line, line_of(place.text(), at), "{settings}");
}

#[test]
fn an_unknown_method_is_told_with_all_methods() {
    let all = ["hermite, baumgarte, weighted, explicit, penalty"];
    assert_mistake(
        &[("\"baumgarte\" ", "\"newmark\" ")],
        "method",
        &[&["\"newmark\""], &all[..]].concat(),
    );
    assert_mistake(
        &[("\"baumgarte\" ", "\"Baumgart\" ")],
        "method",
        &["did you mean `baumgarte`?"],
    );
}

#[test]
fn a_variant_of_hermite_coupling_has_its_name_and_its_degree() {
    assert_coupling_mistake(
        "method = 'hermite'\nvariant = 'apc'",
        "variant",
        &["\"apc\"", "apv, c0pv", "did you mean `apv`?"],
    );
    assert_coupling_mistake(
        "method = 'hermite'\ndegree = 6",
        "degree",
        &["from 2 to 5", "6"],
    );
}

#[test]
fn only_correctors_that_interpolate_have_a_degree_that_follows_the_estimates() {
    for (method, key, help) in [
        (
            "'explicit'\nmu = 1",
            "degree",
            "choose 0, or remove the key",
        ),
        ("'penalty'\nstiffness = 1", "degree", "from 0 to 3"),
        (
            "'penalty'\nstiffness = 1",
            "exchanged_degree",
            "from 0 to 3",
        ),
        ("'hermite'", "exchanged_degree", "from 0 to 3"),
    ] {
        assert_coupling_mistake(
            &format!("method = {method}\n{key} = 'automatic'"),
            key,
            &[
                "\"automatic\" comes with baumgarte and weighted",
                "takes a whole number",
                help,
            ],
        );
    }
    assert_coupling_mistake(
        "method = 'hermite'\ndegree = 'autmatic'",
        "degree",
        &["did you mean `automatic`?"],
    );
    assert_coupling_mistake(
        "method = 'hermite'\ndegree = 4\ninstants = 2",
        "instants",
        &["from 3 to 16", "2"],
    );
    assert_coupling_mistake(
        "method = 'weighted'\ndegree = 'automatc'",
        "degree",
        &["\"automatc\"", "did you mean `automatic`?"],
    );
}

#[test]
fn a_key_of_another_method_is_told_with_its_owner() {
    assert_coupling_mistake(
        "method = 'weighted'\nbeta = 1",
        "beta",
        &["`weighted` has no `beta`", "belongs to baumgarte"],
    );
    assert_coupling_mistake(
        "method = 'baumgarte'\nmu = 1",
        "mu = ",
        &["belongs to explicit"],
    );
    assert_coupling_mistake(
        "method = 'explicit'\nmu = 1\nindex = 1",
        "index",
        &["baumgarte, weighted"],
    );
    assert_coupling_mistake(
        "method = 'penalty'\nstiffness = 1\na = 1",
        "a = 1",
        &["belongs to weighted"],
    );
    assert_coupling_mistake(
        "method = 'weighted'\norder = 'jacobi'",
        "order",
        &["belongs to penalty"],
    );
    for method in ["'explicit'\nmu = 1", "'penalty'\nstiffness = 1"] {
        assert_coupling_mistake(
            &format!("method = {method}\ntolerance = 1e-4"),
            "tolerance",
            &["belongs to hermite, baumgarte, weighted"],
        );
    }
}

#[test]
fn an_index_that_contradicts_the_parameters_is_told_with_the_one_that_fits() {
    for (settings, words) in [
        (
            "method = 'baumgarte'\nindex = 3\nbeta = 2e-3",
            [
                "needs beta = 0 and gamma = 0",
                "beta = 0.002",
                "index = 2 fits",
            ],
        ),
        (
            "method = 'baumgarte'\nindex = 2\ngamma = 'H^2'",
            [
                "beta > 0 and gamma = 0",
                "gamma = \"1.0 H^2\"",
                "index = 1 fits",
            ],
        ),
        (
            "method = 'baumgarte'\nindex = 2\nbeta = 0",
            ["beta > 0 and gamma = 0", "beta = 0.0", "index = 3 fits"],
        ),
        (
            "method = 'baumgarte'\nindex = 1\nbeta = 0",
            ["beta > 0 and gamma > 0", "beta = 0.0", "to get its default"],
        ),
        (
            "method = 'weighted'\nindex = 1\nb = 0",
            ["a > 0 and b > 0", "b = 0.0", "index = 2 fits"],
        ),
        (
            "method = 'weighted'\nindex = 3\na = 1\nb = 1",
            ["a = 0 and b = 0", "a = 1.0", "index = 1 fits"],
        ),
    ] {
        assert_coupling_mistake(settings, "index", &words);
    }
    let no_index = "method = 'baumgarte'\ngamma = 1e-6";
    assert_coupling_mistake(
        no_index,
        "gamma",
        &["gamma = 1e-6", "beta = 0", "\"2.0 H\""],
    );
    assert_coupling_mistake(
        "method = 'weighted'\nindex = 4",
        "index",
        &["from 1 to 3", "found 4"],
    );
}

#[test]
fn parameters_of_a_method_have_ranges_and_forms() {
    for (settings, at, words) in [
        (
            "method = 'baumgarte'\nbeta = -1e-3",
            "beta",
            ["0 or greater", "-0.001"],
        ),
        (
            "method = 'baumgarte'\nbeta = '-2H'",
            "beta",
            ["0 or greater", "-2H"],
        ),
        (
            "method = 'baumgarte'\nbeta = 'H^2'",
            "beta",
            ["such as \"2H\"", "H^2"],
        ),
        (
            "method = 'baumgarte'\nbeta = 1\ngamma = '2H'",
            "gamma",
            ["such as \"0.5 H^2\"", "2H"],
        ),
        (
            "method = 'baumgarte'\nbeta = 'infH'",
            "beta",
            ["such as \"2H\"", "infH"],
        ),
        (
            "method = 'baumgarte'\nbeta = true",
            "beta",
            ["a number", "found true"],
        ),
        (
            "method = 'baumgarte'\nbeta = '1e-322H'",
            "beta",
            ["\"1e-322 H\"", "0.001"],
        ),
        (
            "method = 'weighted'\na = '2H'",
            "a = ",
            ["must be a number", "2H"],
        ),
        (
            "method = 'explicit'\nmu = 0",
            "mu = ",
            ["greater than 0", "found 0"],
        ),
        (
            "method = 'explicit'\nmu = '0H'",
            "mu = ",
            ["greater than 0", "0H"],
        ),
        (
            "method = 'explicit'\nmu = 1\ndegree = 1",
            "degree",
            ["must be 0", "found 1"],
        ),
        ("method = 'explicit'", "[coupling]", ["lacks `mu`", "10H"]),
        (
            "method = 'penalty'",
            "[coupling]",
            ["lacks `stiffness`", "1e6"],
        ),
        (
            "method = 'penalty'\ndamping = 7\nangular_stiffness = 1",
            "[coupling]",
            ["lacks `stiffness`", "1e6"],
        ),
        (
            "method = 'penalty'\nstiffness = 1\nangular_damping = 3",
            "[coupling]",
            ["lacks `angular_stiffness`", "1e4"],
        ),
        (
            "method = 'penalty'\nstiffness = -3",
            "stiffness",
            ["greater than 0", "-3"],
        ),
        (
            "method = 'penalty'\nangular_stiffness = 0",
            "angular_stiffness",
            ["greater than 0", "found 0"],
        ),
        (
            "method = 'penalty'\nstiffness = 1\ndamping = -0.5",
            "damping",
            ["0 or greater", "-0.5"],
        ),
        (
            "method = 'penalty'\nangular_stiffness = 1\nangular_damping = -0.5",
            "angular_damping",
            ["0 or greater", "-0.5"],
        ),
        (
            "method = 'penalty'\nstiffness = 1\norder = 'jacoby'",
            "order",
            ["\"jacoby\"", "jacobi"],
        ),
        (
            "method = 'penalty'\nstiffness = '2H'",
            "stiffness",
            ["a mass over the squared macro step", "2H"],
        ),
        (
            "method = 'penalty'\nstiffness = 1\ndamping = '-3/H'",
            "damping",
            ["0 or greater", "-3/H"],
        ),
    ] {
        assert_coupling_mistake(settings, at, &words);
    }
}

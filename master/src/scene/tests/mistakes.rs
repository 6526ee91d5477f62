//! Users' mistakes in a scene file: each is told with its line, the value, what is allowed, and a remedy.

use super::super::{SceneErrorKind, load, parse};
use super::{EXAMPLE, ORIGIN, assert_mistake, assert_words, edited, line_of, only};

const BETA: &str = "beta = 2e-3";
const MASS1: &str = "name = \"mass1\"";
const B_SIDE: &str = "b = \"mass2\"";

#[test]
fn unknown_keys_are_told_with_the_nearest_one() {
    assert_mistake(
        &[("macro_step =", "macrostep = 2\nmacro_step =")],
        "macrostep",
        &[
            "`coupling` has no key `macrostep`",
            "did you mean `macro_step`?",
            "increment",
        ],
    );
    assert_mistake(
        &[("t_end", "t_stop = 1\nt_end")],
        "t_stop",
        &["name, t_start, t_end"],
    );
    assert_mistake(
        &[(MASS1, "name = \"mass1\"\nparametres = {}")],
        "parametres",
        &["subsystem.mass1", "did you mean `parameters`?"],
    );
    assert_mistake(
        &[("a = \"mass1\"", "a = \"mass1\"\nc = 3")],
        "c = 3",
        &["joint.link", "multiplier"],
    );
    assert_mistake(
        &[("[output]", "[ouput]")],
        "[ouput]",
        &["scene file", "did you mean `output`?"],
    );
    assert_mistake(
        &[("[output]", "[run]\nthreads = 3\n[output]")],
        "threads",
        &["deadline, start_timeout"],
    );
}

#[test]
fn the_keys_of_other_methods_are_not_offered() {
    let text = edited(&[(BETA, "beta = 2e-3\nzzz = 1\nmu = 1")]);
    let shown = parse(&text, ORIGIN, &[]).unwrap_err().to_string();
    let offered = "it has method, exchanged_degree, loads, macro_step, increment, impacts, start_tolerance, degree, index, beta, gamma, jacobian, iterations, \
                   tolerance, absolute_tolerance, least_step, greatest_step\n";
    assert!(shown.contains(offered), "{shown}");
}

#[test]
fn a_name_that_is_not_near_is_not_suggested() {
    let text = edited(&[(BETA, "beta = 2e-3\nzzz = 1")]);
    let error = only(parse(&text, ORIGIN, &[]).unwrap_err());
    assert_eq!(error.help(), None);
}

#[test]
fn wrong_types_tell_what_was_found() {
    assert_mistake(
        &[("t_end = 1.0", "t_end = \"1\"")],
        "t_end = ",
        &["`scene.t_end`", "a finite number", "the text \"1\""],
    );
    assert_mistake(
        &[("degree = 0 ", "degree = 0.5 ")],
        "degree = 0.5",
        &["a whole number", "0.5"],
    );
    assert_mistake(
        &[("name = \"oscillator\"", "name = 7")],
        "name = 7",
        &["`scene.name`", "a text", "7"],
    );
    assert_mistake(
        &[("m = 1.0", "m = 1979-05-27")],
        "1979-05-27",
        &["subsystem.mass1.parameters.m", "the date 1979-05-27"],
    );
    assert_mistake(
        &[("m = 1.0", "m = [1, \"x\"]")],
        "[1, \"x\"]",
        &["parameters.m[1]", "the text \"x\""],
    );
    assert_mistake(
        &[("{ kind = \"exact\" }", "\"exact\"")],
        "= \"exact\"",
        &["`subsystem.mass1.solver` must be a table"],
    );
    assert_mistake(
        &[("[[joint]]", "[joint]")],
        "[joint]",
        &["[[joint]]", "a table"],
    );
    assert_mistake(
        &[("every = 1 ", "every = 1\nvariables = \"mass1.v\" ")],
        "variables = ",
        &["a list of outputs"],
    );
}

const PARAMETERS: &str = "parameters = { m = 1.0, c = 1000.0, d = 10.0, x0 = 0.0, v0 = 100.0 }";

/// Asserts a mistake in the parameters of the first subsystem, in the line of `at`.
fn assert_parameter_mistake(parameters: &str, at: &str, words: &[&str]) {
    let table = format!("parameters = {{ {parameters} }}");
    assert_mistake(&[(PARAMETERS, &table)], at, words);
}

#[test]
fn nested_parameters_keep_the_place_of_a_mistake() {
    let with_table =
        |table: &str| format!("[subsystem.parameters.body.crank]\n{table}\n[[subsystem]]");
    let second = "[[subsystem]]\nname = \"mass2\"";
    assert_mistake(
        &[
            (PARAMETERS, ""),
            (
                second,
                &format!(
                    "{}\nname = \"mass2\"",
                    with_table("m = 1.0\nposition = [0, nan]")
                ),
            ),
        ],
        "position =",
        &["mass1.parameters.body.crank.position[1]", "finite", "NaN"],
    );
    assert_parameter_mistake(
        "body.crank.m = 1979-05-27",
        "body.crank",
        &["mass1.parameters.body.crank.m", "1979-05-27"],
    );
}

#[test]
fn names_in_nested_parameters_have_letters_digits_and_two_signs() {
    for (parameters, words) in [
        (
            "body.\"my crank\".m = 1",
            ["`subsystem.mass1.parameters.body`", "\"my crank\""],
        ),
        (
            "body.crank.\"m.1\" = 1",
            ["`subsystem.mass1.parameters.body.crank`", "\"m.1\""],
        ),
        (
            "\"b.c\" = { m = 1 }",
            ["`subsystem.mass1.parameters`", "\"b.c\""],
        ),
        (
            "body.\"\".m = 1",
            ["`subsystem.mass1.parameters.body`", "\"\""],
        ),
    ] {
        let words = [words[0], words[1], "A-Z a-z 0-9 _ -"];
        assert_parameter_mistake(parameters, "parameters = {", &words);
    }
}

#[test]
fn nested_parameters_are_neither_empty_nor_given_twice() {
    assert_parameter_mistake(
        "joint.hinge = {}",
        "parameters = {",
        &["mass1.parameters.joint.hinge", "at least one key"],
    );
    assert_parameter_mistake(
        "\"a.b\" = 1, a.b = 2",
        "parameters = {",
        &["\"a.b\"", "taken already by a parameter"],
    );
}

#[test]
fn numbers_out_of_range_tell_the_range() {
    assert_mistake(
        &[("degree = 0 ", "degree = 4 ")],
        "degree = 4",
        &["from 0 to 3", "found 4"],
    );
    assert_mistake(
        &[("degree = 0 ", "degree = -1 ")],
        "degree = -1",
        &["from 0 to 3", "found -1"],
    );
    assert_mistake(
        &[("macro_step = 1e-3", "macro_step = 0")],
        "macro_step = 0",
        &["greater than 0", "found 0"],
    );
    assert_mistake(
        &[("t_end = 1.0", "t_end = inf")],
        "t_end = inf",
        &["finite", "inf"],
    );
    assert_mistake(
        &[("v0 = 100.0", "v0 = nan")],
        "nan",
        &["mass1.parameters.v0", "finite", "NaN"],
    );
    assert_mistake(
        &[("m = 1.0", "m = 9007199254740993")],
        "m = 900",
        &["2^53", "9007199254740993"],
    );
    assert_mistake(
        &[("m = 1.0", "m = 99999999999999999999")],
        "m = 999",
        &["more than 64 bits"],
    );
    assert_mistake(
        &[("every = 1 ", "every = 0 ")],
        "every = 0",
        &["1 or greater", "found 0"],
    );
    assert_mistake(
        &[("[output]", "[run]\ndeadline = 0\n[output]")],
        "deadline",
        &["greater than 0 s", "found 0"],
    );
    assert_mistake(
        &[("[output]", "[run]\nstart_timeout = 1e300\n[output]")],
        "start_timeout",
        &["1e6 s"],
    );
    assert_mistake(
        &[(BETA, "beta = 2e-3\nincrement = 0")],
        "increment",
        &["greater than 0"],
    );
}

#[test]
fn the_end_lies_after_the_start_and_holds_a_macro_step() {
    assert_mistake(
        &[("t_end = 1.0", "t_start = 1.5\nt_end = 1.0")],
        "t_end",
        &["t_end = 1 s", "t_start = 1.5"],
    );
    assert_mistake(
        &[("t_end = 1.0", "t_start = -1e308\nt_end = 1e308")],
        "t_end",
        &["finite"],
    );
    assert_mistake(
        &[
            ("t_end = 1.0", "t_start = 0.25\nt_end = 1.0"),
            ("macro_step = 1e-3", "macro_step = 0.8"),
        ],
        "macro_step =",
        &["0.8 s", "= 0.75 s", "smaller macro step"],
    );
}

#[test]
fn missing_keys_are_told_with_an_example() {
    assert_mistake(
        &[("t_end = 1.0", "")],
        "[scene]",
        &["`scene` lacks `t_end`", "t_end = 1.0"],
    );
    assert_mistake(
        &[("macro_step = 1e-3", "")],
        "[coupling]",
        &["lacks `macro_step`"],
    );
    assert_mistake(&[(B_SIDE, "")], "[[joint]]", &["`joint.link` lacks `b`"]);
    assert_mistake(
        &[("{ kind = \"exact\" }", "{ rtol = 1 }")],
        "{ rtol",
        &["lacks `kind`"],
    );
    assert_mistake(
        &[("[output]", "[converge]\n[output]")],
        "[converge]",
        &["lacks `macro_steps`"],
    );
}

#[test]
fn an_empty_file_lacks_everything() {
    let errors = parse("", ORIGIN, &[]).unwrap_err().to_string();
    for words in [
        "scene.toml:1:1: `scene file` lacks `scene`",
        "lacks `coupling`",
        "at least one [[subsystem]]",
    ] {
        assert!(errors.contains(words), "{errors}");
    }
}

#[test]
fn what_is_not_toml_is_told_with_its_place() {
    assert_mistake(&[(BETA, "beta = = 2")], "beta = =", &["this is not TOML"]);
    assert_mistake(
        &[(BETA, "beta = 1\nbeta = 2")],
        "beta = 2",
        &["duplicate key"],
    );
    let errors = parse("a = \nb = \"", ORIGIN, &[]).unwrap_err();
    assert_eq!(errors.iter().count(), 2, "{errors}");
}

#[test]
fn all_mistakes_are_reported_together_in_the_order_of_the_text() {
    let text = edited(&[
        ("t_end = 1.0", "t_end = -1"),
        ("degree = 0 ", "degree = 9 "),
        (MASS1, "name = \"mass1\"\ncolour = 3"),
        (B_SIDE, "b = \"nobody\""),
        ("every = 1 ", "every = -1 "),
    ]);
    let errors = parse(&text, ORIGIN, &[]).unwrap_err();
    let lines: Vec<usize> = errors
        .iter()
        .map(|e| e.place.as_ref().unwrap().line)
        .collect();
    let expected = ["t_end = -1", "degree = 9", "colour", "nobody", "every = -1"];
    assert_eq!(lines, expected.map(|part| line_of(&text, part)), "{errors}");
}

#[test]
fn a_file_that_cannot_be_read_is_told_with_its_path() {
    let folder = tempfile::tempdir().unwrap();
    let absent = folder.path().join("absent.toml");
    let error = only(load(&absent, &[]).unwrap_err());
    assert!(matches!(error.kind, SceneErrorKind::NotFound { .. }));
    assert_words(&error, &["absent.toml", "check the path"]);
    let error = only(load(folder.path(), &[]).unwrap_err());
    assert!(matches!(error.kind, SceneErrorKind::Unreadable { .. }));
    let binary = folder.path().join("binary.toml");
    std::fs::write(&binary, [EXAMPLE.as_bytes(), b"\xff"].concat()).unwrap();
    let error = only(load(&binary, &[]).unwrap_err());
    assert_words(&error, &["not UTF-8", &EXAMPLE.len().to_string()]);
}

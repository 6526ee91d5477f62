//! Users' mistakes in overrides and cases.

use super::super::{Override, parse};
use super::overrides::overrides;
use super::{EXAMPLE, ORIGIN, assert_mistake, assert_words, only};

fn assert_refused(setting: &str, words: &[&str]) {
    let error = only(parse(EXAMPLE, ORIGIN, &overrides(&[setting])).unwrap_err());
    assert_words(&error, words);
    let place = error.place.unwrap();
    assert_eq!(place.to_string(), format!("--set {setting}"));
}

#[test]
fn an_override_is_key_and_value() {
    for text in ["coupling.degree", "=3", ""] {
        let error = text.parse::<Override>().unwrap_err().to_string();
        assert!(
            error.contains("KEY=VALUE") && error.contains(text),
            "{error}"
        );
    }
}

#[test]
fn mistakes_in_values_are_told_like_those_in_the_file() {
    assert_refused(
        "coupling.degree=7",
        &["--set coupling.degree=7: ", "from 0 to 3", "found 7"],
    );
    assert_refused(
        "coupling.macro_step=fast",
        &["a finite number", "the text \"fast\""],
    );
    assert_refused("coupling.macro_step=2", &["2 s", "1 s"]);
    assert_refused(
        "coupling.index=3",
        &["needs beta = 0", "beta = 0.002", "index = 2 fits"],
    );
    assert_refused(
        "coupling.beta=0",
        &["index 2", "beta > 0", "index = 3 fits"],
    );
    assert_refused("coupling.mu=1", &["belongs to explicit"]);
    assert_refused("joint.link.b=mass1", &["both sides"]);
    assert_refused("scene.name=[1, 2", &["not a TOML value", "[1, 2"]);
    assert_refused("coupling.method=baumgart", &["did you mean `baumgarte`?"]);
    assert_refused("run.deadlin=3", &["did you mean `deadline`?"]);
}

#[test]
fn keys_must_lead_somewhere() {
    assert_refused(
        "subsystem.mas1.parameters.c=3",
        &["\"mas1\"", "did you mean `mass"],
    );
    assert_refused("case.fine.set=3", &["\"fine\"", "known: none"]);
    assert_refused("coupling.beta.x=3", &["a part of it is 0.002"]);
    for setting in [
        "degree=3",
        "coupling={}",
        "subsystem.mass1=3",
        "coupling..x=3",
        "a.b.c.d.e.f.g.h.i=3",
        "coupling.*=3",
    ] {
        assert_refused(setting, &["is not the key of a setting", "SECTION.KEY"]);
    }
}

#[test]
fn a_parameter_beside_another_method_in_one_batch_is_a_mistake() {
    let settings = overrides(&["coupling.method=weighted", "coupling.gamma=1"]);
    let error = only(parse(EXAMPLE, ORIGIN, &settings).unwrap_err());
    assert_words(&error, &["--set coupling.gamma=1", "belongs to baumgarte"]);
}

#[test]
fn the_place_of_an_override_marks_its_value() {
    let settings = overrides(&["subsystem.mass1.solver={kind = 3}"]);
    let error = only(parse(EXAMPLE, ORIGIN, &settings).unwrap_err());
    let place = error.place.unwrap();
    assert_eq!(&place.text()[place.span.clone()], "3");
}

#[test]
fn mistakes_in_cases_are_told_with_their_line_and_name() {
    let case =
        |set: &str| format!("[[case]]\nname = \"finer, k = 2\"\nset = {{ {set} }}\n[output]");
    for (set, words) in [
        (
            "\"coupling.degree\" = 8",
            ["case \"finer, k = 2\"", "found 8"],
        ),
        (
            "\"subsystem.mass9.parameters.c\" = 8",
            ["case \"finer, k = 2\"", "\"mass9\""],
        ),
        (
            "coupling.degree = 2",
            ["\"coupling\" is not the key of a setting", "SECTION.KEY"],
        ),
    ] {
        assert_mistake(&[("[output]", &case(set))], "set = {", &words);
    }
    let twice = format!("{}\n", case("")).replace("[output]", &case(""));
    assert_mistake(
        &[("[output]", &twice.replacen("k = 2\"", "k = 2\" # first", 1))],
        "name = \"finer, k = 2\"\n",
        &["taken already by a case"],
    );
    assert_mistake(
        &[("[output]", "[[case]]\nname = \"\"\n[output]")],
        "name = \"\"",
        &["not empty"],
    );
}

#[test]
fn an_override_that_a_case_cannot_bear_is_refused() {
    let text = EXAMPLE.replace(
        "[output]",
        "[[case]]\nname = \"k = 1\"\nset = { \"coupling.degree\" = 1 }\n[output]",
    );
    let settings = overrides(&["coupling.method=explicit", "coupling.mu=10H"]);
    let error = only(parse(&text, ORIGIN, &settings).unwrap_err());
    assert_words(&error, &["case \"k = 1\"", "coupling.degree", "must be 0"]);
}

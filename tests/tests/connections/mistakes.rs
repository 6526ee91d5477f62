//! Mistakes in connections: place, value, what is allowed, what to do.

use linchpin::connect::Place;
use linchpin_master::scene::parse;
use linchpin_master::setup::Options;
use linchpin_tests::runs::try_run;

const SCENE: &str = include_str!("../../../scenes/motor/driven-link.toml");
const ORIGIN: &str = "scene.toml";

/// The scene with pieces of its text replaced is refused at the line with `piece`, by words.
#[track_caller]
fn refused(changes: &[(&str, &str)], piece: &str, words: &[&str]) {
    let mut text = SCENE.to_owned();
    for (from, to) in changes {
        assert!(text.contains(from), "the scene has no {from:?}");
        text = text.replacen(from, to, 1);
    }
    let line = text.lines().position(|line| line.contains(piece)).unwrap() + 1;
    let shown = match parse(&text, ORIGIN, &[]) {
        Err(errors) => errors.to_string(),
        Ok(scene) => try_run(&scene, Place::InProcess, &Options::default())
            .err()
            .map_or_else(String::new, |error| error.to_string()),
    };
    let place = format!("{ORIGIN}:{line}:");
    for word in [&[place.as_str()], words].concat() {
        assert!(shown.contains(word), "{word:?} is missing in\n{shown}");
    }
}

#[test]
fn an_unknown_subsystem() {
    refused(
        &[("from = \"motor.rate\"", "from = \"moter.rate\"")],
        "moter",
        &[
            "connection.speed.from",
            "\"moter\"",
            "did you mean `motor`?",
        ],
    );
    refused(
        &[("to = \"motor.voltage\"", "to = \"motr.voltage\"")],
        "motr",
        &["connection.voltage.to", "\"motr\"", "did you mean `motor`?"],
    );
}

#[test]
fn an_unknown_output_or_input() {
    refused(
        &[("from = \"motor.rate\"", "from = \"motor.rat\"")],
        "motor.rat\"",
        &[
            "model \"dc-motor\" has no output \"rat\"",
            "stored_energy",
            "did you mean \"rate\"?",
        ],
    );
    refused(
        &[("to = \"motor.voltage\"", "to = \"motor.voltag\"")],
        "motor.voltag",
        &[
            "model \"dc-motor\" has no input \"voltag\"",
            "shaft_moment",
            "did you mean \"voltage\"?",
        ],
    );
    // An output is no input.
    refused(
        &[("to = \"motor.voltage\"", "to = \"motor.current\"")],
        "to = \"motor.current\"",
        &["model \"dc-motor\" has no input \"current\"", "voltage"],
    );
}

#[test]
fn a_side_without_a_variable() {
    for side in ["motor", "motor.", ".rate", "rate"] {
        let changed = format!("from = \"{side}\"");
        refused(
            &[("from = \"motor.rate\"", &changed)],
            &changed,
            &["connection.speed.from"],
        );
    }
    refused(
        &[("from = \"motor.rate\"\n", "")],
        "[[connection]]",
        &["lacks `from`", "crank.rate"],
    );
    refused(
        &[("from = \"motor.rate\"", "frm = \"motor.rate\"")],
        "frm",
        &["did you mean `from`?"],
    );
}

#[test]
fn an_input_that_is_driven_twice() {
    let again = "[[connection]]\nname = \"again\"\nfrom = \"link1.rate\"\nto = \"motor.voltage\" # again\n\n[[joint]]";
    refused(
        &[("[[joint]]", again)],
        "# again",
        &[
            "connection.again.to",
            "\"motor.voltage\" is driven by another connection already",
            "an input takes one signal",
        ],
    );
}

#[test]
fn a_subsystem_with_itself() {
    refused(
        &[("to = \"controller.measured\"", "to = \"motor.voltage\"")],
        "to = \"motor.voltage\"",
        &["\"speed\"", "both sides on subsystem \"motor\""],
    );
}

#[test]
fn a_name_that_is_taken() {
    refused(
        &[("name = \"voltage\"", "name = \"speed\" # again")],
        "# again",
        &["taken already by a connection"],
    );
}

/// Both would be of degrees of their own.
#[test]
fn a_signal_and_a_load_of_automatic_degrees_at_one_input() {
    let moment = "[[connection]]\nname = \"brake\"\nfrom = \"link2.rate\"\nto = \"motor.shaft_moment\" # both\n\n[[joint]]";
    refused(
        &[
            ("[[joint]]", moment),
            ("degree = 1 ", "degree = \"automatic\"\nloads = \"master\" "),
            ("exchanged_degree = 2 ", "# "),
        ],
        "# both",
        &[
            "coupling.degree = \"automatic\"",
            "follow estimates of their own",
            "give both the same whole number",
        ],
    );
}

/// The moment at the shaft would be a polynomial of degree 1 and one of degree 2.
#[test]
fn a_signal_and_a_load_of_other_degrees_at_one_input() {
    let moment = "[[connection]]\nname = \"brake\"\nfrom = \"link2.rate\"\nto = \"motor.shaft_moment\" # both\n\n[[joint]]";
    refused(
        &[
            ("[[joint]]", moment),
            ("degree = 1 ", "degree = 1\nloads = \"master\" "),
        ],
        "# both",
        &[
            "\"motor.shaft_moment\" takes this signal and the load of a joint",
            "coupling.degree = 1",
            "coupling.exchanged_degree = 2",
            "give both the same whole number",
        ],
    );
}

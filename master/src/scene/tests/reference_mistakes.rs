//! Users' mistakes in names and in what refers to them: subsystems, joints, outputs and studies.

use super::{assert_mistake, edited, line_of};

const MODEL: &str = "model = \"oscillator\" ";
const MASS1: &str = "name = \"mass1\"";
const B_SIDE: &str = "b = \"mass2\"";

#[test]
fn names_are_well_formed() {
    for name in ["a b", "", "mass.1", "*", "größe"] {
        let line = format!("name = \"{name}\"");
        assert_mistake(
            &[("name = \"link\"", &line)],
            &line,
            &[&format!("{name:?} is not a name"), "A-Z a-z 0-9 _ -"],
        );
    }
}

#[test]
fn names_do_not_collide() {
    let text = edited(&[("name = \"link\"", "name = \"mass2\" # again")]);
    let first = format!("in line {}", line_of(&text, "name = \"mass2\""));
    assert_mistake(
        &[("name = \"link\"", "name = \"mass2\" # again")],
        "# again",
        &["joint.mass2.name", "taken already by a subsystem", &first],
    );
    let third = "[[subsystem]]\nname = \"mass1\" # again\nmodel = \"m\"\n[[joint]]";
    assert_mistake(&[("[[joint]]", third)], "# again", &["by a subsystem"]);
    let second = "[[joint]]\nname = \"link\" # again\nkind = \"rigid-link\"\na = \"mass2\"\nb = \"mass1\"\n[output]";
    assert_mistake(&[("[output]", second)], "# again", &["by a joint"]);
}

#[test]
fn a_joint_connects_two_known_subsystems() {
    assert_mistake(
        &[(B_SIDE, "b = \"mas2\"")],
        "mas2",
        &[
            "joint.link.b",
            "\"mas2\"",
            "mass1, mass2",
            "did you mean `mass",
        ],
    );
    assert_mistake(
        &[(B_SIDE, "b = \"mass1.tip\"")],
        "mass1.tip",
        &["both sides on subsystem \"mass1\"", "\"link\""],
    );
    assert_mistake(
        &[(B_SIDE, "b = \"mass2.\"")],
        "\"mass2.\"",
        &["SUBSYSTEM.MARKER"],
    );
    assert_mistake(
        &[("\"rigid-link\"", "\"rigid_link\"")],
        "rigid_link",
        &["did you mean `rigid-link`?"],
    );
}

#[test]
fn a_subsystem_is_served_in_exactly_one_way() {
    assert_mistake(
        &[(MODEL, "")],
        "[[subsystem]]",
        &[
            "neither model nor address, command or fmu",
            "http://HOST:PORT",
        ],
    );
    let both = "command = [\"w\"]\naddress = \"http://h:1\" ";
    assert_mistake(
        &[(MODEL, both)],
        "address",
        &["both address and command", "remove one"],
    );
    assert_mistake(
        &[(MODEL, "address = \"https://h:1\" ")],
        "https",
        &[
            "names no certificates",
            "https://h:1",
            "linchpin certificates",
        ],
    );
    assert_mistake(
        &[(MODEL, "address = \"http://h:1\" ")],
        "http",
        &["in plain text", "http://h:1", "security.plain_text = true"],
    );
    for address in [
        "tcp://h:1",
        "h:1",
        "http://",
        "http://a b",
        "unix:/",
        "unix:relative",
        "http://h:1/path",
    ] {
        let line = format!("address = \"{address}\" ");
        assert_mistake(
            &[(MODEL, &line)],
            &line,
            &["http://HOST:PORT or unix:/PATH", address],
        );
    }
    for command in ["\"w\"", "[]", "[3]", "[\"\"]"] {
        let line = format!("command = {command} ");
        assert_mistake(&[(MODEL, &line)], &line, &["the program first"]);
    }
    assert_mistake(
        &[(MODEL, "model = \"\" ")],
        "model = \"\"",
        &["the name of a model"],
    );
    assert_mistake(
        &[(MASS1, "name = \"mass1\"\ncalls = \"stream\"")],
        "calls",
        &["automatic, unary"],
    );
}

#[test]
fn recorded_outputs_belong_to_known_subsystems() {
    let output = |list: &str| format!("every = 1\nvariables = {list} ");
    let unknown = output("[\"mass3.v\"]");
    assert_mistake(
        &[("every = 1 ", &unknown)],
        "variables = ",
        &["output.variables[0]", "\"mass3\"", "mass1, mass2"],
    );
    let bare = output("[\"mass1\"]");
    assert_mistake(
        &[("every = 1 ", &bare)],
        "variables = ",
        &["SUBSYSTEM.OUTPUT"],
    );
    let twice = output("[\"mass1.v\", \"mass1.v\"]");
    assert_mistake(
        &[("every = 1 ", &twice)],
        "variables = ",
        &["output.variables[1]", "recorded output"],
    );
}

#[test]
fn studies_have_sensible_values() {
    for (study, at, words) in [
        (
            "[converge]\nmacro_steps = [1e-2]",
            "macro_steps",
            ["two or more different", "a list"],
        ),
        (
            "[converge]\nmacro_steps = [1e-2, 1e-2]",
            "macro_steps",
            ["two or more different", "a list"],
        ),
        (
            "[converge]\nmacro_steps = [1e-2, 2]",
            "macro_steps",
            ["macro_steps[1]", "2 s"],
        ),
        (
            "[converge]\nmacro_steps = [1e-2, 1e-3]\nreference = 'closed'",
            "reference",
            ["automatic, closed-form, monolithic, finest", "\"closed\""],
        ),
        (
            "[stability]\nx = { key = 'run.deadline', values = [1, 2] }",
            "[stability]",
            ["lacks `y`", "points = 25"],
        ),
    ] {
        let text = format!("{study}\n[output]");
        assert_mistake(&[("[output]", &text)], at, &words);
    }
    for (axis, words) in [
        (
            "key = 'coupling.macro_step', from = 0, to = 1, points = 3, scale = 'log'",
            ["stability.x.from", "greater than 0"],
        ),
        (
            "key = 'coupling.macro_step', from = 1, to = 1, points = 3",
            ["stability.x.to", "another number"],
        ),
        (
            "key = 'coupling.macro_step', from = 1, to = 2, points = 1001",
            ["from 2 to 1000", "1001"],
        ),
        (
            "key = 'coupling.macro_step', values = [1e-3]",
            ["two or more numbers", "stability.x.values"],
        ),
        (
            "key = 'coupling.macro_step', values = [1, 2], points = 3",
            ["no key `points`", "key, label, values"],
        ),
        (
            "key = 'coupling.macro_step', from = 1, to = 2, points = 3, scale = 'lin'",
            ["linear, log", "\"lin\""],
        ),
        ("key = 3, values = [1, 2]", ["a key such as", "found 3"]),
        (
            "key = 'coupling.degree', values = [0, 5]",
            ["coupling.degree", "found 5"],
        ),
        (
            "key = 'subsystem.mass7.parameters.c', values = [0, 5]",
            ["\"mass7\"", "mass1, mass2"],
        ),
        (
            "key = 'c', values = [0, 5]",
            ["not the key of a setting", "SECTION.KEY"],
        ),
    ] {
        let text = format!(
            "[stability]\ny = {{ key = 'run.deadline', values = [1, 2] }}\nx = {{ {axis} }}\n[output]"
        );
        assert_mistake(&[("[output]", &text)], "x = { key", &words);
    }
}

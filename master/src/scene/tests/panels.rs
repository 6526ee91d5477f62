//! What the picture of a run shows.

use super::super::{Over, parse};
use super::{ORIGIN, assert_mistake, edited};

const EVERY: &str = "every = 1 ";

/// The last section of the example with a panel that has these keys.
fn panel(keys: &str) -> String {
    format!("[[output.panel]]\nlabel = \"v\"\ncolumns = [\"mass1.v\"]\n{keys}\n#")
}

fn over(keys: &str) -> Option<Over> {
    let text = edited(&[(EVERY, &panel(keys))]);
    let scene = parse(&text, ORIGIN, &[]).unwrap_or_else(|errors| panic!("{errors}"));
    let [panel] = &scene.output.panels[..] else {
        panic!("{:?}", scene.output.panels)
    };
    assert_eq!(panel.curves, [["mass1.v"]]);
    panel.over.clone()
}

#[test]
fn panels_are_over_the_time_or_over_columns() {
    assert_eq!(over(""), None);
    let expected = |column: &[&str], label: &str| {
        Some(Over {
            column: column.iter().map(|&name| name.to_owned()).collect(),
            label: label.to_owned(),
        })
    };
    assert_eq!(
        over("over = \"mass1.x\""),
        expected(&["mass1.x"], "mass1.x")
    );
    assert_eq!(
        over("over = \"mass1.x+mass2.x\"\nover_label = \"x in m\""),
        expected(&["mass1.x", "mass2.x"], "x in m")
    );
}

#[test]
fn mistakes_in_panels_are_told() {
    assert_mistake(
        &[(EVERY, &panel("ovr = \"mass1.x\""))],
        "ovr",
        &[
            "output.panel[0]",
            "label, columns, over, over_label",
            "did you mean `over`?",
        ],
    );
    assert_mistake(
        &[(EVERY, &panel("over = 3"))],
        "over = 3",
        &["output.panel[0].over", "text"],
    );
    assert_mistake(
        &[(EVERY, &panel("over_label = \"x in m\""))],
        "[[output.panel]]",
        &["output.panel[0]", "lacks `over`"],
    );
}

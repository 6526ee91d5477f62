//! The checks of the conformance kit, as they describe themselves.

use linchpin::conformance::checks::all;

use super::prose;

pub fn page() -> String {
    let mut text = super::head("Conformance checks");
    text += "
What `linchpin conformance` checks, in its order. Why each holds and how to read the report:
[Is my worker right?](../guide/conformance.md).
";
    for check in all() {
        let about = check.about();
        text += &format!("\n## {}\n\n", about.name);
        text += &prose(&format!("{}.", capitalised(about.title)));
        text += &format!("\n```text\n{}\n```\n\n", wrapped(about.equation));
        text += &prose(&format!("**Tolerance:** {}.", about.tolerance));
        text += "\n";
        text += &prose(&format!("**If it fails, look at** {}.", about.look_at));
    }
    text
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_uppercase().chain(letters).collect()
    })
}

/// Lines of a block within the width of a page.
fn wrapped(text: &str) -> String {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let full = lines
            .last()
            .is_some_and(|line| line.len() + word.len() >= super::WIDTH);
        if full {
            lines.push(format!("  {word}"));
        } else if let Some(line) = lines.last_mut() {
            if !line.is_empty() {
                line.push(' ');
            }
            line.push_str(word);
        }
    }
    lines.join("\n")
}

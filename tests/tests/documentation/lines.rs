//! The length of lines.

use crate::page::pages;

/// Longest line of prose.
const LIMIT: usize = 120;

#[test]
fn no_line_of_prose_is_too_long() {
    let mut long = Vec::new();
    for page in pages() {
        for line in page.prose() {
            let is_table = line.text.trim_start().starts_with('|');
            if !is_table && length(line.text) > LIMIT {
                long.push(format!("{}:{}", page.name(), line.number));
            }
        }
    }
    assert!(long.is_empty(), "longer than {LIMIT}:\n{}", long.join("\n"));
}

/// Number of characters without the targets of links.
fn length(line: &str) -> usize {
    let mut length = 0;
    let mut rest = line;
    while let Some(start) = rest.find("](") {
        length += rest[..start].chars().count();
        rest = &rest[start..];
        rest = rest.find(')').map_or("", |end| &rest[end..]);
    }
    length + rest.chars().count()
}

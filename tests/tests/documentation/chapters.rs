//! The table of contents of the book.

use crate::page::{pages, repository};

/// Every page but this table itself is in it, so that links between pages hold in the book.
#[test]
fn every_page_is_a_chapter() {
    let summary = std::fs::read_to_string(repository().join("docs/SUMMARY.md")).unwrap();
    for page in pages() {
        let name = page.name();
        let Some(place) = name.strip_prefix("docs/") else {
            continue;
        };
        if place == "SUMMARY.md" {
            continue;
        }
        assert!(
            summary.contains(&format!("]({place})")),
            "docs/SUMMARY.md does not name {place}"
        );
    }
}

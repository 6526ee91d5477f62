//! Pages that are written from the program.

use std::fs;

use linchpin_tests::reference::{COMMAND, pages};

use crate::page::repository;

#[test]
fn the_pages_written_from_the_program_are_those_of_this_program() {
    for (name, text) in pages() {
        let path = repository().join("docs/reference").join(name);
        let found = fs::read_to_string(&path).unwrap_or_default();
        assert!(
            found == text,
            "docs/reference/{name} is not what the program says; write it anew: {COMMAND}"
        );
    }
}

//! The reader of imports, on small texts.

use super::graph::{Files, circles};
use super::source::Source;

fn mentions(text: &str) -> Vec<String> {
    let source = Source::read(text).unwrap();
    source
        .mentions
        .iter()
        .map(|mention| mention.text())
        .collect()
}

/// Arrows as `FROM > TO`.
fn arrows(files: &[(&str, &str)]) -> Vec<String> {
    let arrows = Files::read(files.iter().copied()).arrows();
    let mut told: Vec<_> = arrows
        .iter()
        .map(|arrow| format!("{} > {}", arrow.from, arrow.to))
        .collect();
    told.dedup();
    told
}

/// The files of every circle.
fn files_of_circles(files: &[(&str, &str)]) -> Vec<Vec<String>> {
    let circles = circles(&Files::read(files.iter().copied()).arrows());
    let files = circles.into_iter().map(|circle| {
        let mut files: Vec<_> = circle.into_iter().map(|arrow| arrow.from).collect();
        files.dedup();
        files
    });
    files.collect()
}

#[test]
fn groups_are_taken_apart() {
    let text = "use crate::a::{self, b::{C, D as E}, *};\npub(crate) use super::f;";
    assert_eq!(
        mentions(text),
        [
            "use crate::a",
            "use crate::a::b::C",
            "use crate::a::b::D",
            "use crate::a",
            "use super::f"
        ]
    );
    let source = Source::read(text).unwrap();
    assert_eq!(source.imported["E"], ["crate", "a", "b", "D"]);
    assert_eq!(source.imported["a"], ["crate", "a"]);
    assert_eq!(source.globs, [["crate", "a"]]);
}

#[test]
fn paths_in_code_count() {
    let text =
        "fn f() -> super::A { let x = vec![crate::b::g(1)]; format!(\"{}\", self::h::<c::D>()) }";
    assert_eq!(
        mentions(text),
        ["super::A", "crate::b::g", "self::h", "c::D"]
    );
}

#[test]
fn what_is_no_import_does_not_count() {
    let text = "
        // use crate::a::A;
        //! use crate::a::A;
        const TEXT: &str = \"use crate::a::A;\";
        use ::other::B;
        pub(super) struct C;
        #[cfg(test)]
        use crate::d::D;
        #[cfg(test)]
        mod tests { use super::*; use crate::e::E; }
        impl C { #[cfg(test)] fn f() { crate::g::h() } }
    ";
    let text = text.replace("//!", "//");
    assert_eq!(mentions(&text), [] as [&str; 0]);
}

#[test]
fn arrows_lead_to_the_file_that_defines() {
    let files = [
        ("lib.rs", "pub mod a; mod d; mod e; pub use a::B;"),
        (
            "a/mod.rs",
            "mod b; mod c; pub use b::B; pub use c::*; pub struct Own;",
        ),
        ("a/b.rs", "pub enum B { One }"),
        ("a/c.rs", "pub fn c() {}"),
        (
            "d.rs",
            "use crate::a::B; use crate::a::c; use std::fmt; fn f() { B::One; c() }",
        ),
        (
            "e.rs",
            "use crate::a; use super::a::Own; fn f(_: a::B) { a::c(); crate::B::One; }",
        ),
    ];
    assert_eq!(
        arrows(&files),
        [
            "a/mod.rs > a/b.rs",
            "a/mod.rs > a/c.rs",
            "d.rs > a/b.rs",
            "d.rs > a/c.rs",
            "e.rs > a/b.rs"
        ]
        .into_iter()
        .chain(["e.rs > a/c.rs", "e.rs > a/mod.rs", "lib.rs > a/b.rs"])
        .collect::<Vec<_>>()
    );
}

#[test]
fn a_folder_and_its_child_may_be_a_circle() {
    let files = [
        ("lib.rs", "mod a; mod d;"),
        ("a.rs", "mod b; mod c; pub use b::B; pub struct Own;"),
        ("a/b.rs", "use super::Own; pub struct B;"),
        ("a/c.rs", "use super::B;"),
        ("d.rs", "use crate::a::B;"),
    ];
    assert_eq!(files_of_circles(&files), [["a.rs", "a/b.rs"]]);
}

#[test]
fn every_circle_is_found_on_its_own() {
    let files = [
        (
            "lib.rs",
            "mod a; mod b; mod c; mod d; mod e; use a::A; use d::D;",
        ),
        ("a.rs", "use crate::b::B; pub struct A;"),
        ("b.rs", "use crate::c::C; pub struct B;"),
        ("c.rs", "use crate::{a::A, d::D}; pub struct C;"),
        ("d.rs", "use super::e::E; pub struct D;"),
        ("e.rs", "pub struct E(crate::d::D);"),
    ];
    let expected: [&[&str]; 2] = [&["a.rs", "b.rs", "c.rs"], &["d.rs", "e.rs"]];
    assert_eq!(files_of_circles(&files), expected);
    let (c, d) = ("use crate::d::D; pub struct C;", "pub struct D;");
    let untied = [
        files[0],
        files[1],
        files[2],
        ("c.rs", c),
        ("d.rs", d),
        files[5],
    ];
    assert_eq!(files_of_circles(&untied), [] as [Vec<String>; 0]);
}

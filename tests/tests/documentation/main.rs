//! The pages of the documentation: their links, their lines, their commands.

#![allow(clippy::unwrap_used)]

mod chapters;
mod lines;
mod links;
mod page;
mod reference;

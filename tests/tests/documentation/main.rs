//! The pages of the documentation: their links, their lines, their commands.

#![allow(clippy::unwrap_used)]

mod chapters;
mod command;
mod commands;
mod evidence;
mod lines;
mod links;
mod messages;
mod page;
mod reference;
mod schemas;
mod stations;
mod tasks;
mod walk;

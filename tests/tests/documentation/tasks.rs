//! The tasks of a new user need nothing that the book does not have.

use std::collections::BTreeSet;

use linchpin_tests::tasks::{Task, tasks};

use crate::command::{Command, commands, words};
use crate::page::{Page, pages, repository};

#[test]
fn every_command_of_a_task_is_in_its_page() {
    for task in tasks() {
        let page = Page::read(repository().join(&task.page));
        let shown = commands(&page);
        let lines: Vec<&str> = shell_lines(&page);
        for line in &task.commands {
            let typed = words(line.split(" || ").next().unwrap().trim_end_matches(" &"));
            let is_shown = match typed.as_slice() {
                [program, arguments @ ..] if program == "linchpin" => is_known(arguments, &shown),
                _ => lines.contains(&line.as_str()),
            };
            assert!(
                is_shown,
                "{}: {} does not tell `{line}`",
                task.name, task.page
            );
        }
    }
}

/// The page has the sub-command with these flags, or, where the flags are in another page, with some of them.
fn is_known(arguments: &[String], shown: &[Command]) -> bool {
    let wanted = flags(arguments);
    let same = shown
        .iter()
        .filter(|command| command.name() == arguments[0]);
    let told: BTreeSet<&str> = same
        .clone()
        .flat_map(|command| flags(&command.arguments))
        .collect();
    let elsewhere: Vec<Command> = pages().iter().flat_map(commands).collect();
    let is_told = |flag: &&str| {
        told.contains(flag)
            || elsewhere.iter().any(|command| {
                command.name() == arguments[0] && flags(&command.arguments).contains(flag)
            })
    };
    same.count() > 0 && wanted.iter().all(is_told)
}

fn flags(arguments: &[String]) -> BTreeSet<&str> {
    let flags = arguments.iter().filter(|word| word.starts_with("--"));
    flags.map(String::as_str).collect()
}

fn shell_lines(page: &Page) -> Vec<&str> {
    let blocks = page.blocks().into_iter();
    let shell = blocks.filter(|block| block.language == "sh");
    shell.flat_map(|block| block.lines).collect()
}

#[test]
fn every_file_of_a_task_is_in_its_page_as_it_is() {
    let mut found = 0;
    for Task {
        name, page, files, ..
    } in tasks()
    {
        let page = Page::read(repository().join(page));
        for file in files {
            let is_shown = page.blocks().iter().any(|block| block.lines == file.lines);
            assert!(
                is_shown,
                "{name}: {} does not have {}",
                page.name(),
                file.name
            );
            found += 1;
        }
    }
    assert!(found > 0, "no task has a file");
}

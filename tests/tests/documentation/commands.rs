//! Every command of the pages is one of the program, and every scene that it names is sound.

use std::os::unix::fs::symlink;

use clap::Parser;
use linchpin::command_line::Arguments;
use linchpin_tests::fmus;
use linchpin_tests::process::Workshop;

use crate::command::{Command, commands, inline_commands};
use crate::page::{Page, pages, repository};

#[test]
fn every_command_is_one_of_the_program() {
    let mut wrong = Vec::new();
    for command in pages().iter().flat_map(all) {
        let words = ["linchpin".to_owned()]
            .into_iter()
            .chain(command.arguments.clone());
        if let Err(error) = Arguments::try_parse_from(words)
            && error.use_stderr()
        {
            wrong.push(format!("{}: {error}", command.place));
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn every_scene_of_a_command_is_sound() {
    for page in pages() {
        let workshop = workshop(&page);
        for command in all(&page) {
            match command.name() {
                "run" | "check" | "converge" | "stability" => check(&workshop, &command),
                "report" | "spectrum" => {
                    for file in command
                        .arguments
                        .iter()
                        .filter(|word| word.ends_with(".toml"))
                    {
                        assert!(
                            workshop.path().join(file).is_file(),
                            "{}: there is no {file}",
                            command.place
                        );
                    }
                }
                _ => {}
            }
        }
    }
}

fn all(page: &Page) -> Vec<Command> {
    let mut all = commands(page);
    all.extend(inline_commands(page));
    all
}

/// A folder with the scenes of the repository, those that the page has, and the FMUs that it speaks of.
pub fn workshop(page: &Page) -> Workshop {
    let workshop = Workshop::new();
    symlink(repository().join("scenes"), workshop.path().join("scenes")).unwrap();
    for block in page
        .blocks()
        .iter()
        .filter(|block| block.language == "toml")
    {
        let name = block.lines.first().and_then(|line| line.strip_prefix("# "));
        if let Some(name) = name.filter(|name| name.ends_with(".toml") && !name.contains(' ')) {
            workshop.write(name, block.lines.join("\n") + "\n");
            if block.lines.iter().any(|line| line.starts_with("fmu = ")) {
                fmus::write_examples(workshop.path());
            }
        }
    }
    workshop
}

fn check(workshop: &Workshop, command: &Command) {
    let Some(scene) = command
        .arguments
        .iter()
        .find(|word| word.ends_with(".toml"))
    else {
        return;
    };
    let mut arguments = vec!["check", scene.as_str()];
    for setting in command.settings() {
        arguments.extend(["--set", setting]);
    }
    let outcome = workshop.run(&arguments);
    let code = command.exit_code();
    // Shown if the demand fails.
    println!("{}", command.place);
    outcome.exits_with(code);
}

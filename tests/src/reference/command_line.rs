//! Every sub-command with its help.

use clap::{Command, CommandFactory};
use linchpin::command_line::Arguments;

/// Columns of the help.
const WIDTH: usize = 100;

pub fn page() -> String {
    let mut program = Arguments::command()
        .mut_arg("log", |log| log.hide_env_values(true))
        .term_width(WIDTH);
    program.build();
    let mut text = super::head("Command line");
    text += "\nThe program is called `linchpin`. `linchpin --help` and `linchpin COMMAND --help` print what stands here.\n";
    text += &section("linchpin", &mut program);
    let names: Vec<String> = program
        .get_subcommands()
        .map(|command| command.get_name().to_owned())
        .filter(|name| name != "help")
        .collect();
    for name in names {
        if let Some(command) = program.find_subcommand_mut(&name) {
            text += &section(&format!("linchpin {name}"), command);
        }
    }
    text
}

fn section(title: &str, command: &mut Command) -> String {
    let help = command.render_help().to_string();
    let lines: Vec<&str> = help.lines().map(str::trim_end).collect();
    format!(
        "\n## {title}\n\n```text\n{}\n```\n",
        lines.join("\n").trim_end()
    )
}

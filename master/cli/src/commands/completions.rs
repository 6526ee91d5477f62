//! `linchpin completions`: what a shell needs to complete commands.

use clap::CommandFactory;
use clap_complete::Shell;

use super::CommandError;
use super::common::print;

/// Print the completions of a shell
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin completions bash > ~/.local/share/bash-completion/completions/linchpin
  linchpin completions zsh > ~/.zfunc/_linchpin
  linchpin completions fish > ~/.config/fish/completions/linchpin.fish")]
pub struct Arguments {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

/// Prints the completions.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let mut command = crate::command_line::Arguments::command();
    let mut text = Vec::new();
    clap_complete::generate(arguments.shell, &mut command, "linchpin", &mut text);
    print(String::from_utf8_lossy(&text))
}

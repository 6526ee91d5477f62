//! `linchpin man`: writes the manual pages.

use std::fs;
use std::path::PathBuf;

use clap::CommandFactory;

use super::CommandError;
use super::common::print;

/// Write the manual pages, one for each command
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin man ~/.local/share/man/man1
  man linchpin-run")]
pub struct Arguments {
    /// Folder; made if it does not exist
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

/// Writes the pages.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let folder = &arguments.folder;
    let unwritable = CommandError::unwritable(folder);
    fs::create_dir_all(folder).map_err(&unwritable)?;
    let command = crate::command_line::Arguments::command();
    clap_mangen::generate_to(command, folder).map_err(&unwritable)?;
    print(format_args!("manual pages in {}\n", folder.display()))
}

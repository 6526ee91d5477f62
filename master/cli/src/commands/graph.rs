//! `linchpin graph`: draws what a scene couples.

use std::path::PathBuf;

use clap::ValueEnum;

use super::CommandError;
use super::common::{SceneArguments, print};
use crate::files::write_text;
use crate::graph::{Graph, dot, svg};

/// Draw the subsystems, joints and signals of a scene
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin graph scenes/four-bar.toml > four-bar.svg
  linchpin graph scenes/motor/driven-link.toml --file drive.svg
  linchpin graph scenes/chain/8.toml --format dot | dot -Tpdf > chain.pdf

Nothing is started. Boxes are subsystems with their models, plain lines joints with their kinds and markers, dashed arrows signals.")]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,

    /// A picture, or a text for Graphviz
    #[arg(long, value_enum, default_value_t = Format::Svg)]
    format: Format,

    /// Write to a file instead of the standard output
    #[arg(long, short, value_name = "FILE")]
    file: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    Svg,
    Dot,
}

/// Draws the graph of the scene.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let graph = Graph::of(&arguments.scene.load()?);
    let text = match arguments.format {
        Format::Svg => svg(&graph),
        Format::Dot => dot(&graph),
    };
    match &arguments.file {
        Some(path) => write_text(path, &text),
        None => print(text),
    }
}

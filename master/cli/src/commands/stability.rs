//! `linchpin stability`: a map of stability over two settings.

use std::str::FromStr;

use super::CommandError;
use super::common::{OutputArguments, SceneArguments};
use super::sharing::{SharingArguments, Sweep};
use crate::files::write_table;
use crate::output::study::StudyAbout;
use crate::study::stability::{Grid, assemble, draw_map, number_of_points, points, rows, summary};

/// Map the stability of a scene over two of its settings
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin stability scenes/s1/fig07.toml --out out/fig07
  linchpin stability scenes/oscillator.toml --x 'subsystem.*.parameters.c=1e1:1e8:25:log' \\
      --y 'subsystem.*.parameters.d=1e-1:1e5:25:log'
  linchpin stability scenes/s1/fig07.toml --slurm 8 > fig07.sbatch     in 8 parts on a cluster

Runs in parallel and in this process. A point of a linear scene is stable if no position or velocity grows tenfold from the
first to the last tenth of the time, one of any other scene if its velocities stay near those of a reference run. Where the scene is linear, its solvers exact and its states described, the spectral radius of
the macro-step map is found as well. Writes DIR/stability.csv, DIR/stability.svg and .png. A scene with cases gives one
panel for each.")]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,

    /// Horizontal axis in place of stability.x of the scene; KEY may be several keys with commas between
    #[arg(long, value_name = "KEY=FROM:TO:POINTS[:log]")]
    x: Option<AxisRange>,

    /// Vertical axis in place of stability.y of the scene
    #[arg(long, value_name = "KEY=FROM:TO:POINTS[:log]")]
    y: Option<AxisRange>,

    #[command(flatten)]
    sharing: SharingArguments,

    #[command(flatten)]
    output: OutputArguments,
}

/// An axis as it is written on the command line.
#[derive(Debug, Clone, PartialEq)]
struct AxisRange {
    keys: Vec<String>,
    from: f64,
    to: f64,
    points: usize,
    is_log: bool,
}

/// Text that is no axis.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "{found:?} is {wrong}; write KEY=FROM:TO:POINTS or KEY=FROM:TO:POINTS:log, for example \
     subsystem.*.parameters.c=1e1:1e8:25:log"
)]
struct NotAnAxis {
    found: String,
    wrong: &'static str,
}

impl FromStr for AxisRange {
    type Err = NotAnAxis;

    fn from_str(text: &str) -> Result<Self, NotAnAxis> {
        let not = |found: &str, wrong| NotAnAxis {
            found: found.to_owned(),
            wrong,
        };
        let (keys, range) = text.split_once('=').ok_or_else(|| not(text, "no axis"))?;
        let parts: Vec<&str> = range.split(':').map(str::trim).collect();
        let (from, to, points, is_log) = match parts[..] {
            [from, to, points] => (from, to, points, false),
            [from, to, points, "log"] => (from, to, points, true),
            _ => return Err(not(range, "no range")),
        };
        let number = |text: &str| text.parse().map_err(|_| not(text, "no number"));
        Ok(Self {
            keys: keys.split(',').map(|key| key.trim().to_owned()).collect(),
            from: number(from)?,
            to: number(to)?,
            points: points.parse().map_err(|_| not(points, "no whole number"))?,
            is_log,
        })
    }
}

impl AxisRange {
    /// The same as a setting of the scene.
    fn as_setting(&self) -> String {
        let Self {
            keys,
            from,
            to,
            points,
            ..
        } = self;
        let scale = if self.is_log { "log" } else { "linear" };
        format!(
            "{{ key = {keys:?}, from = {from:?}, to = {to:?}, points = {points}, scale = {scale:?} }}"
        )
    }
}

impl Arguments {
    /// The scene with what the flags say; the flags are checked like the keys of the file.
    fn scene_with_flags(&self) -> SceneArguments {
        let x = self.x.iter().map(|axis| ("stability.x", axis.as_setting()));
        let y = self.y.iter().map(|axis| ("stability.y", axis.as_setting()));
        self.scene.with(x.chain(y))
    }
}

/// Maps the scene and writes table and picture.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let given = arguments.scene_with_flags();
    let scene = given.load()?;
    let flags = "--x KEY=FROM:TO:POINTS and --y KEY=FROM:TO:POINTS";
    let grid = Grid::new(given.section(&scene.stability, "stability", flags)?);
    let output = &arguments.output;
    let tasks = number_of_points(&scene, &grid);
    let sweep = Sweep {
        command: "stability",
        name: &scene.name,
        about: StudyAbout::of_scene("stability", &scene, &given),
        identity: given.identity("stability", &scene),
        tasks,
        unit: "points",
        progress: (tasks, "points"),
    };
    arguments.sharing.carry_out(
        sweep,
        output,
        |share, tick| points(&scene, &grid, share, tick),
        |pieces, told, folder| {
            let found = assemble(&scene, &grid, pieces)?;
            let maps = &found.results;
            told.missing(found.missing);
            write_table(&told.file("stability.csv"), rows(maps))?;
            if maps.iter().any(|map| map.missing == 0) {
                draw_map(maps, &grid, &told.picture("stability"))?;
            }
            output.conclude(&summary(maps), folder.path())?;
            Ok(found.stopped)
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_is_keys_and_a_range() {
        let axis: AxisRange = "coupling.beta,coupling.gamma = 1e-4:0.5:7:log"
            .parse()
            .unwrap();
        assert_eq!(axis.keys, ["coupling.beta", "coupling.gamma"]);
        assert_eq!(
            axis.as_setting(),
            "{ key = [\"coupling.beta\", \"coupling.gamma\"], from = 0.0001, to = 0.5, points = 7, scale = \"log\" }"
        );
    }

    #[test]
    fn mistakes_name_the_part() {
        for (text, found) in [
            ("coupling.beta", "coupling.beta"),
            ("coupling.beta=1:2", "1:2"),
            ("coupling.beta=1:2:5:lin", "1:2:5:lin"),
            ("coupling.beta=1:two:5", "two"),
            ("coupling.beta=1:2:5.5", "5.5"),
        ] {
            assert_eq!(text.parse::<AxisRange>().unwrap_err().found, found);
        }
    }
}

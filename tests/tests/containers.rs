//! docker-compose.yml: master and workers in containers of their own give the results of a local run, byte by byte.

#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use linchpin_tests::process::Workshop;

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("..")
        .canonicalize()
        .unwrap()
}

fn run(command: &mut Command) -> Output {
    let output = command.output();
    output.unwrap_or_else(|error| panic!("{command:?}: {error}"))
}

/// The standard output of a command that must succeed.
#[track_caller]
fn succeed(command: &mut Command) -> String {
    let output = run(command);
    let [said, complained] =
        [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    let status = output.status;
    assert!(
        status.success(),
        "{command:?}: {status}\n{said}\n{complained}"
    );
    said
}

/// Why containers cannot be tested on this machine.
fn missing_engine() -> Option<String> {
    for (program, argument) in [("docker", "info"), ("docker-compose", "version")] {
        match Command::new(program).arg(argument).output() {
            Err(error) => return Some(format!("{program}: {error}")),
            Ok(output) if !output.status.success() => {
                let reason = String::from_utf8_lossy(&output.stderr).into_owned();
                return Some(format!("{program} {argument}: {reason}"));
            }
            Ok(_) => {}
        }
    }
    None
}

/// A compose project with a name, an image and a folder of its own. Dropping it removes what it made.
struct Project {
    name: String,
    out: PathBuf,
}

impl Project {
    fn compose(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new("docker-compose");
        command
            .args(["--project-name", &self.name])
            .args(arguments)
            .current_dir(repository())
            .env("LINCHPIN_IMAGE", &self.name)
            .env("LINCHPIN_OUT", &self.out);
        command
    }

    fn containers(&self) -> String {
        let label = format!("label=com.docker.compose.project={}", self.name);
        succeed(Command::new("docker").args(["ps", "--all", "--quiet", "--filter", &label]))
    }

    fn images(&self) -> String {
        succeed(Command::new("docker").args(["images", "--quiet", &self.name]))
    }

    fn down(&self) -> Output {
        run(&mut self.compose(&["down", "--rmi", "all", "--volumes", "--remove-orphans"]))
    }
}

impl Drop for Project {
    fn drop(&mut self) {
        self.down();
    }
}

#[test]
fn compose_gives_the_results_of_a_local_run() {
    if let Some(reason) = missing_engine() {
        println!("skipped, there is no docker engine: {reason}");
        return;
    }
    let build = [
        "build",
        "--release",
        "--config",
        ".cargo/static.toml",
        "--package",
        "linchpin",
    ];
    succeed(
        Command::new(env!("CARGO"))
            .args(build)
            .current_dir(repository()),
    );

    let workshop = Workshop::new();
    let project = Project {
        name: format!("linchpin-test-{}", std::process::id()),
        out: workshop.path().join("compose"),
    };
    succeed(&mut project.compose(&["up", "--build", "--exit-code-from", "master"]));

    let scene = repository()
        .join("scenes/oscillator.toml")
        .display()
        .to_string();
    workshop
        .run(&["run", &scene, "--out", "local", "--quiet"])
        .succeeds();
    let [containers, local] =
        ["compose", "local"].map(|run| workshop.read(&format!("{run}/results.csv")));
    assert!(
        containers == local,
        "results.csv of the containers differs:\n{containers}"
    );
    assert_eq!(local.lines().count(), 1002);

    let down = project.down();
    assert!(down.status.success(), "{down:?}");
    assert_eq!(project.containers(), "");
    assert_eq!(project.images(), "");
}

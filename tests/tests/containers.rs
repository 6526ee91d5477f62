//! docker-compose.yml: master and workers in containers of their own give the results of a local run, byte by byte, and may do
//! nothing that they need not. deploy/stack.yml: what `docker stack` makes of it.

#![allow(clippy::unwrap_used)]

use std::fs;
use std::os::unix::fs::{MetadataExt, chown};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;

use linchpin_tests::process::{Workshop, wait_until};
use rustix::process::{Pid, Signal, getuid, kill_process};

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

/// The static binary that the image has.
static BINARY: LazyLock<()> = LazyLock::new(|| {
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
});

/// A compose project with a name and an image of its own. Dropping it removes what it made.
struct Project {
    name: String,
    /// What the user of the file may set.
    settings: Vec<(&'static str, String)>,
}

impl Project {
    fn new(purpose: &str, settings: &[(&'static str, String)]) -> Self {
        LazyLock::force(&BINARY);
        Self {
            name: format!("linchpin-{purpose}-{}", std::process::id()),
            settings: settings.to_vec(),
        }
    }

    fn compose(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new("docker-compose");
        command
            .args(["--project-name", &self.name])
            .args(arguments)
            .current_dir(repository())
            .env_remove("LINCHPIN_OUT")
            .env_remove("LINCHPIN_USER")
            .env("LINCHPIN_IMAGE", &self.name)
            .envs(self.settings.iter().map(|(key, value)| (key, value)));
        command
    }

    /// The container of a service.
    fn container(&self, service: &str) -> String {
        let number = succeed(&mut self.compose(&["ps", "--all", "--quiet", service]));
        number.trim().to_owned()
    }

    fn inspect(&self, service: &str, format: &str) -> String {
        let container = self.container(service);
        let said =
            succeed(Command::new("docker").args(["inspect", "--format", format, &container]));
        said.trim().to_owned()
    }

    /// What `linchpin health` in the container of a service says of an address.
    fn health(&self, service: &str, address: &str) -> Output {
        let ask = ["exec", "-T", service, "/linchpin", "health", address];
        let more = ["--certificates", "/certificates", "--timeout", "2"];
        run(&mut self.compose(&[&ask[..], &more].concat()))
    }

    /// What is left of it.
    fn leftovers(&self) -> String {
        let label = format!("label=com.docker.compose.project={}", self.name);
        let lists: [&[&str]; 4] = [
            &["ps", "--all", "--quiet", "--filter", &label],
            &["network", "ls", "--quiet", "--filter", &label],
            &["volume", "ls", "--quiet", "--filter", &label],
            &["images", "--quiet", &self.name],
        ];
        let list = |arguments: &&[&str]| succeed(Command::new("docker").args(*arguments));
        lists.iter().map(list).collect()
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

/// The results of the same scene with worker processes on this machine.
fn local_results(workshop: &Workshop, settings: &[&str]) -> String {
    let scene = repository().join("scenes/oscillator.toml");
    let scene = scene.display().to_string();
    let run = ["run", &scene, "--out", "local", "--no-plots", "--quiet"];
    workshop.run(&[&run[..], settings].concat()).succeeds();
    workshop.read("local/results.csv")
}

#[test]
fn compose_gives_the_results_of_a_local_run() {
    if let Some(reason) = missing_engine() {
        println!("skipped, there is no docker engine: {reason}");
        return;
    }
    let workshop = Workshop::new();
    let project = Project::new("run", &[]);
    succeed(&mut project.compose(&["up", "--build", "--exit-code-from", "master", "master"]));
    // Out of the volume, as the file says.
    let results = format!("{}:/out/.", project.container("master"));
    fs::create_dir(workshop.path().join("compose")).unwrap();
    succeed(
        Command::new("docker")
            .args(["cp", &results, "compose"])
            .current_dir(workshop.path()),
    );
    let containers = workshop.read("compose/results.csv");
    let local = local_results(&workshop, &[]);
    assert!(
        containers == local,
        "results.csv of the containers differs:\n{containers}"
    );
    assert_eq!(local.lines().count(), 1002);

    let down = project.down();
    assert!(down.status.success(), "{down:?}");
    assert_eq!(project.leftovers(), "");
}

/// The number of a user whom this machine does not know.
const SOMEBODY: u32 = 61_234;

/// The folder `own` in a workshop with its user, and what the file is told of both.
fn own_folder(workshop: &Workshop) -> (u32, [(&'static str, String); 2]) {
    let out = workshop.path().join("own");
    fs::create_dir(&out).unwrap();
    let user = match getuid() {
        root if root.is_root() => {
            chown(&out, Some(SOMEBODY), Some(SOMEBODY)).unwrap();
            SOMEBODY
        }
        own => own.as_raw(),
    };
    let settings = [
        ("LINCHPIN_OUT", out.display().to_string()),
        ("LINCHPIN_USER", format!("{user}:{user}")),
    ];
    (user, settings)
}

#[test]
fn results_go_to_a_folder_of_its_user() {
    if let Some(reason) = missing_engine() {
        println!("skipped, there is no docker engine: {reason}");
        return;
    }
    let workshop = Workshop::new();
    let (user, settings) = own_folder(&workshop);
    let project = Project::new("folder", &settings);
    succeed(&mut project.compose(&["up", "--build", "--exit-code-from", "master", "master"]));
    assert!(workshop.read("own/results.csv") == local_results(&workshop, &[]));
    let owner = fs::metadata(workshop.path().join("own/results.csv"))
        .unwrap()
        .uid();
    assert_eq!(owner, user);
}

#[test]
fn containers_may_do_nothing_that_they_need_not() {
    if let Some(reason) = missing_engine() {
        println!("skipped, there is no docker engine: {reason}");
        return;
    }
    let project = Project::new("closed", &[]);
    succeed(&mut project.compose(&["up", "--build", "--detach", "mass1", "mass2"]));
    succeed(&mut project.compose(&["up", "--no-start", "master"]));
    let limits = "{{.Config.User}} {{.HostConfig.ReadonlyRootfs}} {{.HostConfig.CapDrop}} \
                  {{.HostConfig.SecurityOpt}} {{.HostConfig.Memory}} {{.HostConfig.PidsLimit}} {{.HostConfig.PortBindings}}";
    for service in ["mass1", "mass2", "master"] {
        assert_eq!(
            project.inspect(service, limits),
            "65532:65532 true [ALL] [no-new-privileges:true] 268435456 64 map[]",
            "{service}"
        );
    }
    // What the kernel says of the process.
    let process = project.inspect("mass1", "{{.State.Pid}}");
    let status = fs::read_to_string(format!("/proc/{process}/status")).unwrap();
    for line in [
        "Uid:\t65532\t65532\t65532\t65532",
        "Gid:\t65532\t65532\t65532\t65532",
        "CapEff:\t0000000000000000",
        "CapBnd:\t0000000000000000",
        "NoNewPrivs:\t1",
    ] {
        assert!(status.lines().any(|own| own == line), "{line}\n{status}");
    }

    wait_until("healthy workers", || {
        let health = |service| project.inspect(service, "{{.State.Health.Status}}");
        ["mass1", "mass2"].map(health) == ["healthy"; 2]
    });
    // Each reaches itself, but not the other, by name or by address.
    let address = "{{range .NetworkSettings.Networks}}{{.IPAddress}}{{end}}";
    let other = format!("https://{}:50051", project.inspect("mass2", address));
    for service in ["mass1", "mass2"] {
        let own = project.health(service, &format!("https://{service}:50051"));
        assert!(own.status.success(), "{own:?}");
    }
    for address in ["https://mass2:50051", &other] {
        let reached = project.health("mass1", address);
        assert_eq!(reached.status.code(), Some(1), "{reached:?}");
    }
}

#[test]
fn a_run_goes_on_with_a_worker_that_was_killed() {
    if let Some(reason) = missing_engine() {
        println!("skipped, there is no docker engine: {reason}");
        return;
    }
    if !getuid().is_root() {
        println!("skipped, only root can kill what runs in a container");
        return;
    }
    let workshop = Workshop::new();
    let (_, settings) = own_folder(&workshop);
    let project = Project::new("killed", &settings);
    succeed(&mut project.compose(&["up", "--build", "--detach", "mass1", "mass2"]));
    let mut longer = project.compose(&["run", "-T", "--rm", "master"]);
    longer.args(["run", "/scenes/oscillator-compose.toml", "--out", "/out"]);
    longer.args(["--no-plots", "--set", "scene.t_end=40"]);
    let master = std::thread::spawn(move || run(&mut longer));

    let results = workshop.path().join("own/results.csv");
    wait_until("results", || {
        master.is_finished() || fs::metadata(&results).is_ok_and(|file| file.len() > 1 << 18)
    });
    let process = project.inspect("mass1", "{{.State.Pid}}").parse();
    kill_process(Pid::from_raw(process.unwrap()).unwrap(), Signal::KILL).unwrap();

    let ended = master.join().unwrap();
    assert!(ended.status.success(), "{ended:?}");
    let report: serde_json::Value = serde_json::from_str(&workshop.read("own/run.json")).unwrap();
    let subsystems = &report["statistics"]["subsystems"];
    assert_eq!(subsystems[0]["recoveries"]["workers"], 1, "{report}");
    let local = local_results(&workshop, &["--set", "scene.t_end=40"]);
    assert!(
        workshop.read("own/results.csv") == local,
        "{}",
        workshop.path().display()
    );
}

/// How often a line stands in a file of settings.
fn count(text: &str, line: &str) -> usize {
    text.lines().filter(|own| own.trim() == line).count()
}

#[test]
fn docker_stack_takes_its_own_file() {
    if let Err(error) = Command::new("docker").arg("--version").output() {
        println!("skipped, there is no docker: {error}");
        return;
    }
    let config = |file: &str| {
        let mut command = Command::new("docker");
        command
            .args(["stack", "config", "--compose-file", file])
            .current_dir(repository())
            .env_remove("LINCHPIN_IMAGE")
            .env_remove("LINCHPIN_USER");
        command
    };
    let stack = succeed(&mut config("deploy/stack.yml"));
    // Without the fragments that services share.
    let (stack, _) = stack.split_once("\nx-").unwrap();
    for (line, times) in [
        ("image: linchpin", 3),
        ("user: 65532:65532", 3),
        ("read_only: true", 3),
        ("cap_drop:", 3),
        ("- ALL", 3),
        ("memory: \"268435456\"", 3),
        ("pids: 64", 3),
        ("- /linchpin", 2),
        ("internal: true", 2),
        ("encrypted: \"true\"", 2),
        ("mode: replicated-job", 1),
    ] {
        assert_eq!(count(stack, line), times, "{line}\n{stack}");
    }
    // Why there are two files.
    let refused = run(&mut config("docker-compose.yml"));
    assert!(!refused.status.success(), "{refused:?}");
}

//! How the command line tool reaches the workers of a scene.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::Duration;

use linchpin_master::Interrupt;
use linchpin_master::connection::{
    Access, ConnectOptions, Connection, Direct, Launcher, Reached, Renewable, StartError, Threaded,
    TimeLimits, UnaryTurns, WorkerLogs, WorkerProcess, connect, new_runtime, reach_started,
};
use linchpin_master::scene::{Calls, Scene, Served, Subsystem};
use linchpin_models::ground::GROUND;
use linchpin_models::models;
use linchpin_proto::certificates::Certificates;
use linchpin_proto::token::Token;
use linchpin_worker::Host;
use tokio::runtime::Runtime;

/// Where built-in models run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// Each in a worker process of its own that the run starts and ends.
    Processes,
    /// In this process, one after the other.
    InProcess,
    /// In this process, each on a thread of its own.
    Threads,
}

/// Makes the connections of one run. Workers that were started end with their connections.
pub struct Connector {
    place: Place,
    interrupt: Interrupt,
    logs: WorkerLogs,
    runtime: OnceLock<Arc<Runtime>>,
    launcher: OnceLock<Arc<Launcher>>,
    access: OnceLock<Access>,
    /// Processes that were started and are not connected yet.
    begun: Mutex<BTreeMap<String, WorkerProcess>>,
}

impl Connector {
    /// A connector; nothing is started yet.
    pub fn new(place: Place) -> Self {
        Self {
            place,
            interrupt: Interrupt::default(),
            logs: WorkerLogs::default(),
            runtime: OnceLock::new(),
            launcher: OnceLock::new(),
            access: OnceLock::new(),
            begun: Mutex::default(),
        }
    }

    /// Its runs stop at the request of `interrupt`.
    pub fn stopped_by(self, interrupt: Interrupt) -> Self {
        Self { interrupt, ..self }
    }

    /// What the workers print that it starts goes to `logs`.
    pub fn logging(self, logs: WorkerLogs) -> Self {
        Self { logs, ..self }
    }

    /// What stops its runs.
    pub fn interrupt(&self) -> &Interrupt {
        &self.interrupt
    }

    /// The connection to the worker of `subsystem`.
    pub fn connect(
        &self,
        scene: &Scene,
        subsystem: &Subsystem,
    ) -> Result<Box<dyn Connection>, StartError> {
        if let Some(command) = self.command(subsystem)? {
            return self.start(scene, subsystem, command);
        }
        let Served::Address(address) = &subsystem.served else {
            return Ok(self.in_this_process(subsystem));
        };
        let (address, way) = (address.clone(), self.way(scene, subsystem)?);
        let reach = move || Ok(Reached::alone(connect(&address, &way)?));
        Ok(Box::new(Renewable::new(reach)?))
    }

    fn start(
        &self,
        scene: &Scene,
        subsystem: &Subsystem,
        command: Vec<String>,
    ) -> Result<Box<dyn Connection>, StartError> {
        let launcher = Arc::clone(self.launcher()?);
        let (name, way) = (subsystem.name.clone(), self.way(scene, subsystem)?);
        let begun = Mutex::new(self.begun().remove(&name));
        let begin = move || {
            let begun = begun.lock().unwrap_or_else(PoisonError::into_inner).take();
            let process = match begun {
                Some(process) => process,
                None => launcher.start(&name, &command)?,
            };
            reach_started(process, &way)
        };
        Ok(Box::new(Renewable::new(begin)?))
    }

    /// Starts the processes of all workers of a scene, so that they come up at the same time. What cannot be started is told when it is
    /// connected.
    pub fn begin(&self, scene: &Scene) {
        for subsystem in &scene.subsystems {
            let begun = self.command(subsystem).and_then(|command| match command {
                Some(command) => Ok(Some(self.launcher()?.start(&subsystem.name, &command)?)),
                None => Ok(None),
            });
            if let Ok(Some(process)) = begun {
                self.begun().insert(subsystem.name.clone(), process);
            }
        }
    }

    fn begun(&self) -> MutexGuard<'_, BTreeMap<String, WorkerProcess>> {
        self.begun.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The command of a worker that a run starts; `None` for one that is there already.
    fn command(&self, subsystem: &Subsystem) -> Result<Option<Vec<String>>, StartError> {
        match &subsystem.served {
            Served::BuiltIn if self.place != Place::Processes || is_ground(subsystem) => Ok(None),
            Served::BuiltIn => {
                let command = [this_program()?, "worker".into(), "--exit-with-stdin".into()];
                Ok(Some(command.into()))
            }
            Served::Command(command) => Ok(Some(command.clone())),
            Served::Fmu(path) => {
                let path = path.to_string_lossy().into_owned();
                let options = ["worker", "--exit-with-stdin", "--fmu"].map(str::to_owned);
                let program = std::iter::once(this_program()?);
                Ok(Some(program.chain(options).chain([path]).collect()))
            }
            Served::Address(_) => Ok(None),
        }
    }

    fn in_this_process(&self, subsystem: &Subsystem) -> Box<dyn Connection> {
        let host = Host::new(models());
        match (subsystem.calls, self.place) {
            (Calls::Unary, _) => Box::new(Threaded::new(
                Arc::new(UnaryTurns::new(host)),
                "in process, unary calls",
            )),
            (Calls::Automatic, Place::Threads) => {
                Box::new(Threaded::new(Arc::new(host), "in process, own thread"))
            }
            (Calls::Automatic, _) => Box::new(Direct::new(Arc::new(host))),
        }
    }

    fn way(&self, scene: &Scene, subsystem: &Subsystem) -> Result<ConnectOptions, StartError> {
        Ok(ConnectOptions {
            model: subsystem.model.clone(),
            unary_only: subsystem.calls == Calls::Unary,
            limits: TimeLimits {
                start: Duration::from_secs_f64(scene.run.start_timeout),
                answer: Duration::from_secs_f64(scene.run.deadline),
            },
            polling: polling(scene),
            access: self.access(scene)?,
            runtime: self.runtime()?,
            interrupt: self.interrupt.clone(),
        })
    }

    fn runtime(&self) -> Result<Arc<Runtime>, StartError> {
        made(&self.runtime, || Ok(new_runtime()?)).cloned()
    }

    /// The certificates are read once, if any worker takes them.
    fn access(&self, scene: &Scene) -> Result<Access, StartError> {
        let is_at = |own: &Subsystem, scheme: &str| match &own.served {
            Served::Address(address) => address.starts_with(scheme),
            _ => false,
        };
        let any_at = |scheme| scene.subsystems.iter().any(|own| is_at(own, scheme));
        let security = &scene.security;
        let folder = security
            .certificates
            .as_deref()
            .filter(|_| any_at("https:"));
        let token = security.token.as_deref().filter(|_| any_at("http"));
        made(&self.access, || access(folder, token, security.plain_text)).cloned()
    }

    fn launcher(&self) -> Result<&Arc<Launcher>, StartError> {
        made(&self.launcher, || {
            Ok(Arc::new(Launcher::new(self.logs.clone())?))
        })
    }
}

/// By what right workers are called: with the certificates of a folder and the token of a file, if there are such.
///
/// # Errors
/// [`StartError::Certificates`], [`StartError::Token`].
pub fn access(
    certificates: Option<&Path>,
    token: Option<&Path>,
    plain_text: bool,
) -> Result<Access, StartError> {
    let tls = match certificates {
        Some(folder) => Some(Certificates::read(folder)?.for_master()?),
        None => None,
    };
    Ok(Access {
        tls,
        plain_text,
        token: token.map(Token::read).transpose()?,
    })
}

/// Whether it needs no process: nothing is computed.
fn is_ground(subsystem: &Subsystem) -> bool {
    subsystem.model.as_deref() == Some(GROUND)
}

/// What is made at its first use.
fn made<T>(
    cell: &OnceLock<T>,
    make: impl FnOnce() -> Result<T, StartError>,
) -> Result<&T, StartError> {
    if let Some(made) = cell.get() {
        return Ok(made);
    }
    let made = make()?;
    Ok(cell.get_or_init(|| made))
}

/// The path of this program. If an update has replaced its file, the running one is found under `/proc` on Linux; the
/// workers then are of the same version as their master.
fn this_program() -> std::io::Result<String> {
    let path = std::env::current_exe()?;
    let running = Path::new("/proc/self/exe");
    let found = match path.exists() || !running.exists() {
        true => &path,
        false => running,
    };
    Ok(found.to_string_lossy().into_owned())
}

/// Longest time in which the master polls for an answer: a few wake-ups of a sleeping core.
const POLLING: Duration = Duration::from_micros(200);

/// The master polls only where it takes no core from a worker: it waits while they compute, so there may be as many of
/// them as cores.
fn polling(scene: &Scene) -> Duration {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    if cores > 1 && scene.subsystems.len() <= cores {
        POLLING
    } else {
        Duration::ZERO
    }
}

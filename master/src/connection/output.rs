//! What the workers print that a run has started.

use std::collections::VecDeque;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use linchpin_proto::foreign::clean;

use super::exit_message::Printed;

/// Lines that are shown when a worker dies, and characters of each.
const LAST_LINES: usize = 6;
const LONGEST_LINE: usize = 500;

/// A line is read in pieces of so many bytes at most.
const LONGEST_PIECE: u64 = 4096;

/// Bytes of one worker's output that its file takes.
const LARGEST_FILE: usize = 16 << 20;

/// How long the rest of the output of a process that has ended is waited for: what it has started may hold it open.
const REST_TIMEOUT: Duration = Duration::from_millis(100);

/// Takes the lines of a worker, with its name.
type Show = dyn Fn(&str, &str) + Send + Sync;

/// Where the output of the workers goes, but for the last lines, which are kept for messages.
#[derive(Clone, Default)]
pub struct WorkerLogs {
    /// The folder of their files; a worker that prints nothing has none.
    pub folder: Option<PathBuf>,
    /// What shows their lines at once.
    pub show: Option<Arc<Show>>,
}

/// What one worker prints. Read by a thread of its own until nobody can print any more.
pub struct WorkerOutput {
    shared: Arc<Shared>,
    path: Option<PathBuf>,
}

#[derive(Default)]
struct Shared {
    lines: Mutex<Lines>,
    ended: Condvar,
}

#[derive(Default)]
struct Lines {
    last: VecDeque<String>,
    has_ended: bool,
}

impl WorkerOutput {
    /// Reads what a worker of this name prints into `pipe`, but for the line `announcement`, which all workers print.
    ///
    /// # Errors
    /// The system has no thread.
    pub fn follow(
        pipe: impl Read + Send + 'static,
        name: &str,
        announcement: String,
        logs: &WorkerLogs,
    ) -> io::Result<Self> {
        let shared = Arc::<Shared>::default();
        let folder = logs.folder.as_deref();
        let path = folder.map(|folder| folder.join(format!("{name}.log")));
        let mut reader = Reader {
            shared: Arc::clone(&shared),
            announcement,
            name: name.to_owned(),
            show: logs.show.clone(),
            file: path.clone().map(LogFile::new),
        };
        std::thread::Builder::new()
            .name(format!("output of {name}"))
            .spawn(move || reader.read(pipe))?;
        Ok(Self { shared, path })
    }

    /// What was printed, if anything; of a process that `has_ended`, when all is read.
    pub fn printed(&self, has_ended: bool) -> Option<Printed> {
        let mut lines = self.shared.lines();
        if has_ended {
            let ended = &self.shared.ended;
            let waited = ended.wait_timeout_while(lines, REST_TIMEOUT, |lines| !lines.has_ended);
            lines = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
        let last: Vec<&str> = lines.last.iter().map(String::as_str).collect();
        let log = self.path.as_ref().filter(|path| path.exists());
        (!last.is_empty()).then(|| Printed {
            last: last.join("\n"),
            log: log.cloned(),
        })
    }
}

impl Shared {
    fn lines(&self) -> MutexGuard<'_, Lines> {
        self.lines.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

struct Reader {
    shared: Arc<Shared>,
    announcement: String,
    name: String,
    show: Option<Arc<Show>>,
    file: Option<LogFile>,
}

impl Reader {
    fn read(&mut self, pipe: impl Read) {
        let mut pipe = BufReader::new(pipe);
        let mut piece = Vec::new();
        while let Ok(1..) = { &mut pipe }
            .take(LONGEST_PIECE)
            .read_until(b'\n', &mut piece)
        {
            self.take(&piece);
            piece.clear();
        }
        self.shared.lines().has_ended = true;
        self.shared.ended.notify_all();
    }

    fn take(&mut self, piece: &[u8]) {
        let text = String::from_utf8_lossy(piece);
        let text = text.trim_end_matches(['\n', '\r']);
        if text == self.announcement {
            return;
        }
        if let Some(file) = &mut self.file {
            file.write(piece);
        }
        let text = clean(text, LONGEST_LINE);
        if let Some(show) = &self.show {
            show(&self.name, &text);
        }
        let last = &mut self.shared.lines().last;
        if last.len() == LAST_LINES {
            last.pop_front();
        }
        last.push_back(text);
    }
}

/// A file that is made when there is something to write, and takes so much of it.
struct LogFile {
    path: PathBuf,
    state: State,
}

enum State {
    Unused,
    Open {
        file: File,
        room: usize,
    },
    /// Full, or the system takes no more.
    Closed,
}

impl LogFile {
    fn new(path: PathBuf) -> Self {
        let state = State::Unused;
        Self { path, state }
    }

    fn write(&mut self, piece: &[u8]) {
        if let State::Unused = self.state {
            self.state = match open(&self.path) {
                Ok(file) => State::Open {
                    file,
                    room: LARGEST_FILE,
                },
                Err(_) => State::Closed,
            };
        }
        let State::Open { file, room } = &mut self.state else {
            return;
        };
        let left = room.checked_sub(piece.len());
        let written = match left {
            Some(_) => file.write_all(piece),
            None => file.write_all(b"(more is not kept)\n"),
        };
        match (left, written) {
            (Some(left), Ok(())) => *room = left,
            _ => self.state = State::Closed,
        }
    }
}

fn open(path: &Path) -> io::Result<File> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    OpenOptions::new().create(true).append(true).open(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn followed(text: Vec<u8>, logs: &WorkerLogs) -> WorkerOutput {
        let text = io::Cursor::new(text);
        let output = WorkerOutput::follow(text, "one", "listening on x".into(), logs).unwrap();
        while !output.shared.lines().has_ended {
            std::thread::yield_now();
        }
        output
    }

    #[test]
    fn the_last_lines_are_kept_without_the_announcement_and_control_characters() {
        let text = "listening on x\n1\n2\n3\n4\n5\n6\n\u{1b}[31mseven\nlistening on x\n8";
        let output = followed(text.into(), &WorkerLogs::default());
        let printed = output.printed(true).unwrap();
        let lines: Vec<&str> = printed.last.lines().collect();
        assert_eq!(lines.len(), LAST_LINES);
        assert_eq!((lines[0], lines[5]), ("3", "8"));
        assert!(lines[4].ends_with("seven") && !lines[4].contains('\u{1b}'));
        assert_eq!(printed.log, None);
    }

    #[test]
    fn a_file_has_every_byte_up_to_its_limit() {
        let folder = tempfile::tempdir().unwrap();
        let logs = WorkerLogs {
            folder: Some(folder.path().join("workers")),
            show: None,
        };
        let silent = followed(b"listening on x\n".to_vec(), &logs);
        assert_eq!(silent.printed(true), None);
        // A line without an end, longer than a piece.
        let long = "x".repeat(3 * LONGEST_PIECE as usize + 5);
        let output = followed(long.clone().into(), &logs);
        let path = output.printed(true).unwrap().log.unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), long);
        let flood = b"0123456\n".repeat(LARGEST_FILE / 8 + 10);
        followed(flood, &logs);
        let text = fs::read_to_string(&path).unwrap();
        let marker = "(more is not kept)\n";
        assert!(text.ends_with(marker), "{}", text.len());
        assert_eq!(text.len(), long.len() + LARGEST_FILE + marker.len());
    }

    #[test]
    fn lines_are_shown_at_once() {
        let shown = Arc::new(Mutex::new(Vec::new()));
        let own = Arc::clone(&shown);
        let show =
            move |name: &str, line: &str| own.lock().unwrap().push(format!("{name}: {line}"));
        let logs = WorkerLogs {
            folder: None,
            show: Some(Arc::new(show)),
        };
        followed(b"first\r\n\nsecond\n".to_vec(), &logs);
        assert_eq!(
            *shown.lock().unwrap(),
            ["one: first", "one: ", "one: second"]
        );
    }
}

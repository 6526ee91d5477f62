//! Which program writes results, where and since when.

use std::fs;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use serde::Serialize;

/// What `run.json` says of the program.
#[derive(Debug, Clone, Serialize)]
pub struct Program {
    /// Its version.
    pub linchpin: &'static str,
    /// The commit that it was built from; `unknown` if it was built without a repository.
    pub commit: &'static str,
    /// Name of the machine.
    pub host: String,
    /// Number of the process.
    pub process: u32,
    /// Its command line.
    pub command: Vec<String>,
    /// When it began, in UTC (ISO 8601).
    pub started: String,
}

impl Program {
    /// This process, which begins now.
    pub fn this() -> Self {
        Self {
            linchpin: env!("CARGO_PKG_VERSION"),
            commit: env!("LINCHPIN_COMMIT"),
            host: host(),
            process: std::process::id(),
            command: std::env::args_os()
                .map(|word| word.to_string_lossy().into_owned())
                .collect(),
            started: utc(SystemTime::now()),
        }
    }
}

/// Name of this machine, as far as the system tells it in one of the usual places.
fn host() -> String {
    let named = ["/proc/sys/kernel/hostname", "/etc/hostname"];
    let named = named.iter().find_map(|path| fs::read_to_string(path).ok());
    let name = named.or_else(|| std::env::var("HOSTNAME").ok());
    name.map_or_else(|| "unknown".to_owned(), |name| name.trim().to_owned())
}

const SECONDS_OF_A_DAY: u64 = 86_400;

/// A time as `2026-11-30T15:04:05Z`; a clock before 1970 counts as at its start.
pub fn utc(time: SystemTime) -> String {
    let since = time.duration_since(UNIX_EPOCH).unwrap_or(Duration::ZERO);
    let (days, seconds) = (
        since.as_secs() / SECONDS_OF_A_DAY,
        since.as_secs() % SECONDS_OF_A_DAY,
    );
    let (year, month, day) = date(days);
    let (hour, minute, second) = (seconds / 3600, seconds / 60 % 60, seconds % 60);
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
}

/// Year, month and day so many days after 1970-01-01. Years count from March here, so that a leap day is the last one.
fn date(days: u64) -> (u64, u64, u64) {
    const OF_400_YEARS: u64 = 146_097;
    let from_march_of_0 = days + 719_468;
    let (era, day) = (
        from_march_of_0 / OF_400_YEARS,
        from_march_of_0 % OF_400_YEARS,
    );
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let of_month = day - (153 * month + 2) / 5 + 1;
    let (month, next) = if month < 10 {
        (month + 3, 0)
    } else {
        (month - 9, 1)
    };
    (400 * era + year + next, month, of_month)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_those_of_the_calendar() {
        for (seconds, expected) in [
            (0, "1970-01-01T00:00:00Z"),
            (951_782_399, "2000-02-28T23:59:59Z"),
            (951_782_400, "2000-02-29T00:00:00Z"),
            (951_868_800, "2000-03-01T00:00:00Z"),
            (1_767_225_599, "2025-12-31T23:59:59Z"),
            (4_107_542_400, "2100-03-01T00:00:00Z"),
        ] {
            assert_eq!(utc(UNIX_EPOCH + Duration::from_secs(seconds)), expected);
        }
    }
}

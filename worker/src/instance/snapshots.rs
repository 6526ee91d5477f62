//! The states that a master asked to keep.

use std::collections::BTreeMap;

use linchpin_proto::v1::Failure;

use super::motion::Kept;

/// Kept states by their number.
pub(super) struct Snapshots {
    kept: BTreeMap<u64, Kept>,
    taken: u64,
    most: usize,
}

impl Snapshots {
    pub(super) fn new(most: usize) -> Self {
        Self {
            kept: BTreeMap::new(),
            taken: 0,
            most,
        }
    }

    /// Keeps `state` and returns its number; the memory of the snapshot that it replaces is used again.
    pub(super) fn keep(&mut self, state: &Kept, replaces: Option<u64>) -> Result<u64, Failure> {
        let mut kept = replaces
            .and_then(|old| self.kept.remove(&old))
            .unwrap_or_default();
        if self.kept.len() >= self.most {
            return Err(Failure::fatal(format!(
                "{} snapshots are kept, which is the limit; name one that can go in Snapshot.replaces",
                self.kept.len()
            )));
        }
        kept.copy_from(state);
        self.taken += 1;
        self.kept.insert(self.taken, kept);
        Ok(self.taken)
    }

    pub(super) fn find(&self, snapshot: u64) -> Result<&Kept, Failure> {
        self.kept.get(&snapshot).ok_or_else(|| {
            let kept: Vec<String> = self.kept.keys().map(u64::to_string).collect();
            let kept = match kept.is_empty() {
                true => "none".to_owned(),
                false => kept.join(", "),
            };
            Failure::misuse(
                "snapshot",
                format!(
                    "there is no snapshot {snapshot}; it was never taken or was replaced; kept: {kept}"
                ),
            )
        })
    }
}

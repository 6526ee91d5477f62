//! What a study has found, be it all or not.

use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

use super::StudyError;

/// What a study has found.
#[derive(Debug)]
pub struct Found<T> {
    /// As far as it has come.
    pub results: T,
    /// What is not among them, for a reader.
    pub missing: Vec<String>,
    /// Why it is not there.
    pub stopped: Option<StudyError>,
}

impl<T> Found<T> {
    /// What a study has found that came to its end.
    ///
    /// # Errors
    /// Why it did not.
    pub fn whole(self) -> Result<T, StudyError> {
        match self.stopped {
            None => Ok(self.results),
            Some(error) => Err(error),
        }
    }
}

/// The results of the tasks of a study, each in its place.
#[derive(Debug)]
pub struct Pieces<R> {
    /// `None` where a task was not done.
    pub results: Vec<Option<R>>,
    /// Why a task that was due was not done.
    pub stopped: Option<StudyError>,
}

/// Does the tasks that are given in parallel, each by itself, until one of them fails.
pub(super) fn each<T: Sync, R: Send>(
    tasks: &[Option<T>],
    one: impl Fn(&T) -> Result<R, StudyError> + Sync,
) -> Pieces<R> {
    let stopped = Mutex::new(None);
    let reason = || stopped.lock().unwrap_or_else(PoisonError::into_inner);
    let done = tasks.par_iter().with_max_len(1).map(|task| {
        let task = task.as_ref()?;
        if reason().is_some() {
            return None;
        }
        match one(task) {
            Ok(result) => Some(result),
            Err(error) => {
                reason().get_or_insert(error);
                None
            }
        }
    });
    Pieces {
        results: done.collect(),
        stopped: stopped.into_inner().unwrap_or_else(PoisonError::into_inner),
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    #[test]
    fn what_was_done_before_a_failure_stays() {
        let begun = AtomicUsize::new(0);
        let tasks: Vec<Option<usize>> = (0..500).map(Some).collect();
        let Pieces {
            results: done,
            stopped,
        } = each(&tasks, |task| {
            begun.fetch_add(1, Ordering::Relaxed);
            match task {
                77 => Err(StudyError::NoClosedForm { case: "x".into() }),
                task => Ok(2 * task),
            }
        });
        assert!(matches!(stopped, Some(StudyError::NoClosedForm { .. })));
        assert_eq!(done.len(), 500);
        assert_eq!(done.iter().flatten().count(), begun.into_inner() - 1);
        let doubled = |(task, result): (&Option<usize>, &Option<usize>)| {
            result.is_none_or(|own| task.is_some_and(|task| own == 2 * task))
        };
        assert!(tasks.iter().zip(&done).all(doubled));
    }
}

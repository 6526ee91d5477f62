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

/// Does the tasks in parallel, each by itself, until one of them fails; those that were not done are `None`.
pub(super) fn each<T: Sync, R: Send>(
    tasks: &[T],
    one: impl Fn(&T) -> Result<R, StudyError> + Sync,
) -> (Vec<Option<R>>, Option<StudyError>) {
    let stopped = Mutex::new(None);
    let reason = || stopped.lock().unwrap_or_else(PoisonError::into_inner);
    let done = tasks.par_iter().with_max_len(1).map(|task| {
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
    let done = done.collect();
    (
        done,
        stopped.into_inner().unwrap_or_else(PoisonError::into_inner),
    )
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    #[test]
    fn what_was_done_before_a_failure_stays() {
        let begun = AtomicUsize::new(0);
        let tasks: Vec<usize> = (0..500).collect();
        let (done, stopped) = each(&tasks, |task| {
            begun.fetch_add(1, Ordering::Relaxed);
            match task {
                77 => Err(StudyError::NoClosedForm { case: "x".into() }),
                task => Ok(2 * task),
            }
        });
        assert!(matches!(stopped, Some(StudyError::NoClosedForm { .. })));
        assert_eq!(done.len(), 500);
        assert_eq!(done.iter().flatten().count(), begun.into_inner() - 1);
        let doubled =
            |(task, result): (&usize, &Option<usize>)| result.is_none_or(|own| own == 2 * task);
        assert!(tasks.iter().zip(&done).all(doubled));
    }
}

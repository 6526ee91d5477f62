//! Where solvers compute: so many calls at a time, and beside whatever the server has to answer meanwhile.
//!
//! A call computes on the thread of the server that its request has arrived on, since to hand it to another one would take longer than
//! many a step. A [`Sentry`] looks after those that take long and lets another thread go on with the rest.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use tokio::runtime::{Handle, RuntimeFlavor};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tonic::Status;

use super::sentry::Sentry;
use crate::cancel::{By, Cancel, Flag};

/// Threads of a server beside those that compute: one for what comes in and goes out.
pub(super) const OTHER_THREADS: usize = 1;

/// Pause between two descriptions.
const PAUSE: Duration = Duration::from_millis(2);

/// The places where calls compute.
pub(super) struct Solvers {
    steps: Lane,
    descriptions: Lane,
    route: Route,
    /// Raised when the worker shuts down.
    ends: Flag,
}

/// Which thread a call computes on.
enum Route {
    /// The one that it is on.
    Here(Sentry),
    /// One that the runtime keeps for such: what a runtime with fewer threads than [`runtime`](super::runtime) makes must do.
    Elsewhere,
}

/// Calls that compute, and those that wait.
struct Lane {
    places: Arc<Semaphore>,
    of: usize,
    waiting: AtomicUsize,
    most_waiting: usize,
}

/// The right to compute.
pub(super) type Place = OwnedSemaphorePermit;

impl Solvers {
    /// With `threads` calls at a time and `most_waiting` that wait, on the runtime that this is called on.
    pub fn new(threads: usize, most_waiting: usize) -> std::io::Result<Self> {
        let runtime = Handle::current();
        let is_large = runtime.runtime_flavor() == RuntimeFlavor::MultiThread
            && runtime.metrics().num_workers() >= threads + OTHER_THREADS;
        let ends = Flag::default();
        Ok(Self {
            steps: Lane::new(threads, most_waiting),
            descriptions: Lane::new(1, most_waiting),
            route: match is_large {
                true => Route::Here(Sentry::start(runtime)?),
                false => Route::Elsewhere,
            },
            ends,
        })
    }

    /// Waits for a place to step.
    ///
    /// # Errors
    /// The status that refuses a call when too many wait.
    pub async fn place(&self) -> Result<Place, Status> {
        self.steps.place().await
    }

    /// Makes a description, on a thread that the runtime keeps for such. There is one place for it, which is none of those for steps: they may
    /// be taken for long. It is free again after a pause, so that nobody can flood the worker.
    ///
    /// # Errors
    /// As [`Solvers::place`] and [`Solvers::compute`].
    pub async fn describe<A: Send + 'static>(
        &self,
        call: impl FnOnce() -> Result<A, Status> + Send + 'static,
    ) -> Result<A, Status> {
        let place = self.descriptions.place().await?;
        let described = move || {
            let answer = call();
            // Written to the socket it takes time as well.
            tokio::spawn(async move {
                tokio::time::sleep(PAUSE).await;
                drop(place);
            });
            answer
        };
        elsewhere(described).await
    }

    /// Computes in a task of its own, so that whoever waits can be dropped meanwhile, which cancels the call. That wakes another thread
    /// before and behind it.
    ///
    /// # Errors
    /// As [`Solvers::compute`].
    pub async fn compute_apart<A: Send + 'static>(
        self: Arc<Self>,
        place: Place,
        call: impl FnOnce() -> Result<A, Status> + Send + 'static,
    ) -> Result<A, Status> {
        let gone = RaisedOnDrop::default();
        let caller = gone.0.clone();
        let task = async move { self.compute(place, &caller, call).await };
        let answer = tokio::spawn(task).await;
        answer.unwrap_or_else(|error| Err(Status::internal(error.to_string())))
    }

    /// Computes at a place, until `caller` is raised or the worker shuts down. Meanwhile the task that awaits this does nothing else.
    ///
    /// # Errors
    /// The status of a call that failed because the worker shuts down, or without a word.
    pub async fn compute<A: Send + 'static>(
        &self,
        place: Place,
        caller: &Flag,
        call: impl FnOnce() -> Result<A, Status> + Send + 'static,
    ) -> Result<A, Status> {
        let (ends, caller) = (self.ends.clone(), caller.clone());
        let cancellable = move || {
            Cancel::within(By::Worker, &ends, || {
                Cancel::within(By::Caller, &caller, call)
            })
        };
        let answer = match &self.route {
            Route::Here(sentry) => sentry.look_after(cancellable),
            Route::Elsewhere => elsewhere(cancellable).await,
        };
        drop(place);
        match answer {
            // For its master that is a worker that is lost, not a solver that has failed.
            Err(_) if self.ends.is_raised() => Err(Status::unavailable("the worker shuts down")),
            answer => answer,
        }
    }

    /// Cancels all calls.
    pub fn end(&self) {
        self.ends.raise();
    }

    /// Whether a call computes.
    pub fn are_busy(&self) -> bool {
        self.steps.is_busy() || self.descriptions.is_busy()
    }
}

/// Computes on a thread that the runtime keeps for such.
async fn elsewhere<A: Send + 'static>(
    call: impl FnOnce() -> Result<A, Status> + Send + 'static,
) -> Result<A, Status> {
    let answer = tokio::task::spawn_blocking(call).await;
    answer.unwrap_or_else(|error| Err(Status::internal(error.to_string())))
}

/// A flag that is raised when whoever waits is gone.
#[derive(Default)]
struct RaisedOnDrop(Flag);

impl Drop for RaisedOnDrop {
    fn drop(&mut self) {
        self.0.raise();
    }
}

impl Lane {
    fn new(places: usize, most_waiting: usize) -> Self {
        Self {
            places: Arc::new(Semaphore::new(places)),
            of: places,
            waiting: AtomicUsize::new(0),
            most_waiting,
        }
    }

    fn is_busy(&self) -> bool {
        self.places.available_permits() < self.of
    }

    async fn place(&self) -> Result<Place, Status> {
        let places = Arc::clone(&self.places);
        if let Ok(place) = Arc::clone(&places).try_acquire_owned() {
            return Ok(place);
        }
        let before = self.waiting.fetch_add(1, Ordering::Relaxed);
        let _waits = Waits(&self.waiting);
        if before >= self.most_waiting {
            return Err(Status::resource_exhausted(format!(
                "this worker is busy: {before} calls wait until it computes for them, which is its limit; call again later, or start \
                 another worker"
            )));
        }
        let place = places.acquire_owned().await;
        place.map_err(|error| Status::internal(error.to_string()))
    }
}

/// A call that waits, until it is dropped.
struct Waits<'a>(&'a AtomicUsize);

impl Drop for Waits<'_> {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

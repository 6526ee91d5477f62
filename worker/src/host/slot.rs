//! The place of one instance: who may call it, and how long it waits for that.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError, TryLockError};
use std::time::{Duration, Instant};

use linchpin_proto::contract::{CallError, Hold, Owner};
use linchpin_proto::v1::{self, Failure};
use linchpin_proto::version::knows_leases;

use crate::cancel::{By, Cancel, Flag};
use crate::instance::Instance;

/// Longest time of a call that is taken for short.
const SHORT: Duration = Duration::from_millis(1);

/// An instance with what decides about its end.
pub(super) struct Slot {
    request: v1::InitializeRequest,
    /// Who alone may use it; `None`: whoever reaches the worker.
    owner: Option<Owner>,
    began: Instant,
    /// How long it waits when what held it has ended; `None`: until Terminate.
    lease: Option<Duration>,
    /// What holds it or has held it last; empty if it is called without a server.
    holds: Mutex<Vec<Hold>>,
    /// Raised at its end, which cancels its calls.
    ended: Flag,
    /// Bits of the time that its last call with an integration took over that which it simulated; not a number before.
    pace: AtomicU64,
    occupant: Mutex<Occupant>,
}

struct Occupant {
    instance: Instance,
    used: Instant,
}

impl Slot {
    /// A place for an instance that `request` has made. Masters that know nothing of leases have none.
    pub fn new(
        request: &v1::InitializeRequest,
        owner: Option<&Owner>,
        instance: Instance,
        lease: Duration,
    ) -> Self {
        let now = Instant::now();
        Self {
            request: request.clone(),
            owner: owner.cloned(),
            began: now,
            lease: knows_leases(request.protocol.as_ref()).then_some(lease),
            holds: Mutex::default(),
            ended: Flag::default(),
            pace: AtomicU64::new(f64::NAN.to_bits()),
            occupant: Mutex::new(Occupant {
                instance,
                used: now,
            }),
        }
    }

    /// Whether a caller may use it.
    pub fn belongs_to(&self, caller: Option<&Owner>) -> bool {
        self.owner
            .as_ref()
            .is_none_or(|owner| Some(owner) == caller)
    }

    /// The answer to Initialize.
    pub fn initialized(&self) -> Result<v1::InitializeReply, Failure> {
        self.call(|instance| Ok(self.told(instance)))
    }

    /// Calls the instance for what integrates nothing.
    pub fn call<T>(
        &self,
        call: impl FnOnce(&mut Instance) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        self.call_over(0.0, call)
    }

    /// Calls the instance, which simulates `span` (s).
    pub fn call_over<T>(
        &self,
        span: f64,
        call: impl FnOnce(&mut Instance) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        let mut occupant = self.occupant.lock().map_err(|_| {
            Failure::fatal(
                "the solver of this instance panicked in an earlier call; Terminate it and make another",
            )
        })?;
        let instance = &mut occupant.instance;
        let (began, before) = (Instant::now(), instance.sequence());
        let answer = Cancel::within(By::Instance, &self.ended, || call(instance));
        occupant.used = Instant::now();
        // Calls that are cancelled or answered from memory do not tell.
        if span > 0.0 && answer.is_ok() && occupant.instance.sequence() != before {
            let pace = (occupant.used - began).as_secs_f64() / span;
            self.pace.store(pace.to_bits(), Ordering::Relaxed);
        }
        answer
    }

    /// Whether a call over `span` (s) presumably takes no longer than [`SHORT`], at the pace of the last one.
    pub fn is_short(&self, span: f64) -> bool {
        let pace = f64::from_bits(self.pace.load(Ordering::Relaxed));
        let is_free = !matches!(self.occupant.try_lock(), Err(TryLockError::WouldBlock));
        is_free && (span == 0.0 || pace * span <= SHORT.as_secs_f64())
    }

    /// Cancels the call under way and those that wait for it: the instance is no longer there.
    pub fn end(&self) {
        self.ended.raise();
    }

    /// Whether [`Slot::end`] was called.
    pub fn has_ended(&self) -> bool {
        self.ended.is_raised()
    }

    /// The answer to an Initialize that is repeated.
    pub fn initialize_again(
        &self,
        request: &v1::InitializeRequest,
        caller: Option<&Owner>,
    ) -> Result<v1::InitializeReply, CallError> {
        if !self.belongs_to(caller) {
            return Err(CallError::of_another(request.instance));
        }
        let reply = self.call(|instance| {
            if instance.is_new() && self.request == *request {
                return Ok(self.told(instance));
            }
            Err(Failure::misuse(
                "instance",
                format!(
                    "instance {:#x} exists already; choose another number",
                    request.instance
                ),
            ))
        })?;
        Ok(reply)
    }

    fn told(&self, instance: &Instance) -> v1::InitializeReply {
        v1::InitializeReply {
            lease: self.lease.map(|lease| lease.as_secs_f64()),
            ..instance.initialized()
        }
    }

    /// Takes note of what holds the instance from now on: a stream alone, or all connections over which it is called.
    pub fn hold(&self, by: &Hold) {
        let mut holds = self.holds.lock().unwrap_or_else(PoisonError::into_inner);
        let is_streamed = holds
            .iter()
            .any(|own| own.is_stream() && own.ended().is_none());
        if by.is_stream() {
            *holds = vec![by.clone()];
        } else if !is_streamed && !holds.contains(by) {
            holds.retain(|own| own.ended().is_none());
            holds.push(by.clone());
        }
    }

    /// Whether nothing has called it for so long. An instance that is computing is not idle, however long that takes.
    pub fn is_idle(&self, limit: Duration) -> bool {
        self.idle().is_none_or(|idle| idle >= limit)
    }

    /// Whether its lease is over.
    pub fn is_over(&self) -> bool {
        self.expires().is_some_and(|left| left.is_zero())
    }

    /// What is told of it.
    pub fn state(&self) -> v1::InstanceState {
        let seconds = |time: Duration| time.as_secs_f64();
        v1::InstanceState {
            instance: self.request.instance,
            model: self.request.model.clone(),
            age: seconds(self.began.elapsed()),
            idle: seconds(self.idle().unwrap_or_else(|| self.began.elapsed())),
            held: self.is_held(),
            expires: self.expires().map(seconds),
        }
    }

    /// Time since its last call, 0 during one; `None` if its solver has panicked.
    fn idle(&self) -> Option<Duration> {
        match self.occupant.try_lock() {
            Ok(occupant) => Some(occupant.used.elapsed()),
            Err(TryLockError::WouldBlock) => Some(Duration::ZERO),
            Err(TryLockError::Poisoned(_)) => None,
        }
    }

    fn is_held(&self) -> bool {
        let holds = self.holds.lock().unwrap_or_else(PoisonError::into_inner);
        holds.iter().any(|hold| hold.ended().is_none())
    }

    /// Time until the lease is over, which begins when all that held the instance has ended, or behind the call that was under
    /// way then.
    fn expires(&self) -> Option<Duration> {
        let lease = self.lease?;
        let holds = self.holds.lock().unwrap_or_else(PoisonError::into_inner);
        let ended: Option<Vec<Instant>> = holds.iter().map(Hold::ended).collect();
        let free = ended?.into_iter().max()?.elapsed();
        let waited = self.idle().map_or(free, |idle| idle.min(free));
        Some(lease.saturating_sub(waited))
    }
}

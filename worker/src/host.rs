//! The contract around models: one worker with its instances.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, RwLock};
use std::time::{Duration, Instant};

use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::polynomial::MAX_NODES;
use linchpin_proto::v1::{self, Failure};
use linchpin_proto::version::{self, PROTOCOL};

use crate::instance::Instance;
use crate::{Model, Setup, setup::SetupError};

/// What a worker allows its masters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Most instances at a time.
    pub instances: usize,
    /// Most kept snapshots of an instance.
    pub snapshots: usize,
    /// An instance that was not called for this long gives way when the worker is full.
    pub idle: Duration,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            instances: 256,
            snapshots: 16,
            idle: Duration::from_secs(900),
        }
    }
}

/// A worker: its models and the instances that masters made of them.
pub struct Host {
    models: BTreeMap<String, Box<dyn Model>>,
    instances: RwLock<BTreeMap<u64, Arc<Seat>>>,
    limits: Limits,
}

struct Seat {
    instance: Mutex<Instance>,
    request: v1::InitializeRequest,
    used: Mutex<Instant>,
}

impl Host {
    /// A worker for `models` with the default limits.
    pub fn new(models: Vec<Box<dyn Model>>) -> Self {
        Self::with_limits(models, Limits::default())
    }

    /// A worker for `models`.
    pub fn with_limits(models: Vec<Box<dyn Model>>, limits: Limits) -> Self {
        let models = models
            .into_iter()
            .map(|model| (model.describe().name, model))
            .collect();
        Self {
            models,
            instances: RwLock::default(),
            limits,
        }
    }

    /// Number of instances at present.
    pub fn instances(&self) -> usize {
        self.instances
            .read()
            .unwrap_or_else(PoisonError::into_inner)
            .len()
    }

    fn with_instance<T>(
        &self,
        number: u64,
        call: impl FnOnce(&mut Instance) -> Result<T, Failure>,
    ) -> Result<T, CallError> {
        let seat = {
            let instances = self
                .instances
                .read()
                .unwrap_or_else(PoisonError::into_inner);
            instances.get(&number).cloned()
        };
        let Some(seat) = seat else {
            return Err(Failure::misuse(
                "instance",
                format!("there is no instance {number:#x} here; Initialize makes one"),
            )
            .into());
        };
        *lock(&seat.used) = Instant::now();
        Ok(call(&mut lock(&seat.instance))?)
    }

    fn build(&self, request: &v1::InitializeRequest) -> Result<Instance, Failure> {
        version::negotiate(request.protocol.as_ref())
            .map_err(|error| Failure::misuse("protocol", error.to_string()))?;
        let Some(model) = self.models.get(&request.model) else {
            let known: Vec<&str> = self.models.keys().map(String::as_str).collect();
            return Err(Failure::misuse(
                "model",
                format!(
                    "this worker has no model \"{}\"; it has: {}",
                    request.model,
                    known.join(", ")
                ),
            ));
        };
        let description = model.describe();
        let setup = Setup::from_request(
            &description,
            request.parameters.clone(),
            request.solver.clone(),
            request.t_start,
        )
        .map_err(refuse)?;
        let subsystem = model.initialize(&setup).map_err(refuse)?;
        Instance::new(subsystem, &description, request, self.limits.snapshots)
    }

    fn make_room(&self, instances: &mut BTreeMap<u64, Arc<Seat>>) -> Result<(), Failure> {
        if instances.len() >= self.limits.instances {
            instances.retain(|_, seat| lock(&seat.used).elapsed() < self.limits.idle);
        }
        if instances.len() < self.limits.instances {
            return Ok(());
        }
        Err(Failure::fatal(format!(
            "this worker is full: {} instances are in use; end some with Terminate or start another worker",
            instances.len()
        )))
    }
}

impl Contract for Host {
    fn describe(&self, _: &v1::DescribeRequest) -> Result<v1::DescribeReply, CallError> {
        Ok(v1::DescribeReply {
            protocol: Some(PROTOCOL),
            worker: "linchpin".into(),
            worker_version: env!("CARGO_PKG_VERSION").into(),
            models: self
                .models
                .values()
                .map(|model| with_capabilities(model.describe()))
                .collect(),
        })
    }

    fn initialize(
        &self,
        request: &v1::InitializeRequest,
    ) -> Result<v1::InitializeReply, CallError> {
        let mut instances = self
            .instances
            .write()
            .unwrap_or_else(PoisonError::into_inner);
        if let Some(seat) = instances.get(&request.instance) {
            if seat.request == *request {
                return Ok(lock(&seat.instance).initialized());
            }
            return Err(Failure::misuse(
                "instance",
                format!(
                    "instance {:#x} exists already; choose another number",
                    request.instance
                ),
            )
            .into());
        }
        self.make_room(&mut instances)?;
        let instance = self.build(request)?;
        let reply = instance.initialized();
        let seat = Seat {
            instance: Mutex::new(instance),
            request: request.clone(),
            used: Mutex::new(Instant::now()),
        };
        instances.insert(request.instance, Arc::new(seat));
        Ok(reply)
    }

    fn snapshot(&self, request: &v1::SnapshotRequest) -> Result<v1::SnapshotReply, CallError> {
        self.with_instance(request.instance, |instance| instance.snapshot(request))
    }

    fn restore(&self, request: &v1::RestoreRequest) -> Result<v1::RestoreReply, CallError> {
        self.with_instance(request.instance, |instance| instance.restore(request))
    }

    fn step(&self, request: &v1::StepRequest) -> Result<v1::StepReply, CallError> {
        self.with_instance(request.instance, |instance| instance.step(request))
    }

    fn perturbed_step(
        &self,
        request: &v1::PerturbedStepRequest,
    ) -> Result<v1::PerturbedStepReply, CallError> {
        self.with_instance(request.instance, |instance| {
            instance.perturbed_step(request)
        })
    }

    fn evaluate(&self, request: &v1::EvaluateRequest) -> Result<v1::EvaluateReply, CallError> {
        self.with_instance(request.instance, |instance| instance.evaluate(request))
    }

    fn terminate(&self, request: &v1::TerminateRequest) -> Result<v1::TerminateReply, CallError> {
        let mut instances = self
            .instances
            .write()
            .unwrap_or_else(PoisonError::into_inner);
        instances.remove(&request.instance);
        Ok(v1::TerminateReply {})
    }

    fn exchange(
        &self,
        request: &v1::ExchangeRequest,
        reply: &mut v1::ExchangeReply,
    ) -> Result<(), CallError> {
        self.with_instance(request.instance, |instance| {
            instance.exchange(request, reply)
        })
    }
}

fn with_capabilities(mut model: v1::Model) -> v1::Model {
    let own = model.capabilities.unwrap_or_default();
    model.capabilities = Some(v1::Capabilities {
        exchange: true,
        repeats_step_sequence: own.repeats_step_sequence,
        max_input_degree: MAX_NODES as u32 - 1,
        exportable_snapshot: true,
    });
    model
}

fn refuse(error: SetupError) -> Failure {
    Failure::misuse(error.field(), error.to_string())
}

/// A panic in one call does not make the others fail: the data behind these locks stay usable.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

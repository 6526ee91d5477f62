//! The contract around models: one worker with its instances.

mod slot;

use std::any::Any;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, PoisonError, RwLock, RwLockReadGuard, RwLockWriteGuard};
use std::time::Duration;

use linchpin_proto::contract::{CallError, Contract, Hold, Owner};
use linchpin_proto::label::Reply;
use linchpin_proto::polynomial::MAX_NODES;
use linchpin_proto::v1::{self, Failure};
use linchpin_proto::version::{self, PROTOCOL};

use crate::instance::{Instance, Signals};
use crate::joint_load::request::joint_loads;
use crate::setup::{SetupError, names};
use crate::span::Span;
use crate::{Model, Setup};
use slot::Slot;

/// What a worker allows its masters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Most instances at a time.
    pub instances: usize,
    /// Most kept snapshots of an instance.
    pub snapshots: usize,
    /// An instance that was not called for this long gives way when the worker is full.
    pub idle: Duration,
    /// An instance whose stream or connection has ended waits this long for another call.
    pub lease: Duration,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            instances: 256,
            snapshots: 16,
            idle: Duration::from_secs(900),
            lease: Duration::from_secs(2),
        }
    }
}

/// A worker: its models and the instances that masters made of them.
pub struct Host {
    models: BTreeMap<String, Box<dyn Model>>,
    /// Of all models, with the defaults of their parameters.
    descriptions: Vec<v1::Model>,
    instances: RwLock<Instances>,
    limits: Limits,
}

type Instances = BTreeMap<u64, Arc<Slot>>;

impl Host {
    /// A worker for `models` with the default limits.
    pub fn new(models: Vec<Box<dyn Model>>) -> Self {
        Self::with_limits(models, Limits::default())
    }

    /// A worker for `models`.
    pub fn with_limits(models: Vec<Box<dyn Model>>, limits: Limits) -> Self {
        let models: BTreeMap<_, _> = models
            .into_iter()
            .map(|model| (model.describe().name, model))
            .collect();
        Self {
            descriptions: models.values().map(|model| model.describe()).collect(),
            models,
            instances: RwLock::default(),
            limits,
        }
    }

    /// Number of instances at present.
    pub fn instances(&self) -> usize {
        self.table().len()
    }

    // A call that panics under one of these locks leaves the table of instances whole.
    fn table(&self) -> RwLockReadGuard<'_, Instances> {
        self.instances
            .read()
            .unwrap_or_else(PoisonError::into_inner)
    }

    fn change_table(&self) -> RwLockWriteGuard<'_, Instances> {
        self.instances
            .write()
            .unwrap_or_else(PoisonError::into_inner)
    }

    fn with_instance<T>(
        &self,
        number: u64,
        span: f64,
        call: impl FnOnce(&mut Instance) -> Result<T, Failure>,
    ) -> Result<T, CallError> {
        let slot = self.table().get(&number).cloned();
        let Some(slot) = slot else {
            return Err(CallError::no_instance(number));
        };
        without_panic(|| slot.call_over(span, call)).map_err(|failure| match slot.has_ended() {
            true => CallError::no_instance(number),
            false => failure.into(),
        })
    }

    fn build(&self, request: &v1::InitializeRequest) -> Result<Instance, Failure> {
        version::negotiate(request.protocol.as_ref())
            .map_err(|error| Failure::misuse("protocol", error.to_string()))?;
        let model = self.model(&request.model)?;
        let description = model.describe_with(&request.parameters).map_err(refuse)?;
        let signals = Signals::new(&description.inputs, request)?;
        let joint_loads = joint_loads(&description, request, &signals)?;
        let setup = Setup::from_request(
            &description,
            request.parameters.clone(),
            request.solver.clone(),
            request.t_start,
        )
        .map_err(refuse)?
        .with_joint_loads(joint_loads);
        let subsystem = model.initialize(&setup).map_err(refuse)?;
        let most_snapshots = self.limits.snapshots;
        Instance::new(subsystem, signals, &description, request, most_snapshots)
    }

    fn model(&self, name: &str) -> Result<&dyn Model, Failure> {
        let model = self.models.get(name).map(|model| &**model);
        model.ok_or_else(|| {
            let known = names(self.models.keys());
            let message = format!("this worker has no model \"{name}\"; it has: {known}");
            Failure::misuse("model", message)
        })
    }

    /// The model that the request names, with its parameters, or all models.
    fn describe_models(&self, request: &v1::DescribeRequest) -> Result<Vec<v1::Model>, Failure> {
        let Some(name) = &request.model else {
            return Ok(self.descriptions.clone());
        };
        let description = self.model(name)?.describe_with(&request.parameters);
        Ok(vec![description.map_err(refuse)?])
    }

    fn place(
        &self,
        request: &v1::InitializeRequest,
        owner: Option<&Owner>,
        instance: Instance,
    ) -> Result<v1::InitializeReply, CallError> {
        self.tidy();
        // Dropped behind the table, as all that is taken out of it: a solver may be slow to end, and others want the table.
        let idle;
        let mut instances = self.change_table();
        if let Some(slot) = instances.get(&request.instance).cloned() {
            // The same request was repeated while the first one was still being answered.
            drop(instances);
            return slot.initialize_again(request, owner);
        }
        if instances.len() >= self.limits.instances {
            idle = take(&mut instances, |slot| slot.is_idle(self.limits.idle));
            tracing::debug!(instances = idle.len(), "idle instances give way");
        }
        if instances.len() >= self.limits.instances {
            return Err(Failure::fatal(format!(
                "this worker is full: {} instances are in use; end some with Terminate or start another worker",
                instances.len()
            ))
            .into());
        }
        let slot = Slot::new(request, owner, instance, self.limits.lease);
        let reply = slot.initialized()?;
        instances.insert(request.instance, Arc::new(slot));
        Ok(reply)
    }

    fn initialize_as(
        &self,
        request: &v1::InitializeRequest,
        owner: Option<&Owner>,
    ) -> Result<v1::InitializeReply, CallError> {
        let existing = self.table().get(&request.instance).cloned();
        let reply = match existing {
            Some(slot) => slot.initialize_again(request, owner)?,
            None => {
                let instance = without_panic(|| self.build(request))?;
                self.place(request, owner, instance)?
            }
        };
        Ok(reply.to(request))
    }
}

impl Contract for Host {
    fn describe(&self, request: &v1::DescribeRequest) -> Result<v1::DescribeReply, CallError> {
        let models = without_panic(|| self.describe_models(request))?;
        Ok(v1::DescribeReply {
            protocol: Some(PROTOCOL),
            worker: "linchpin".into(),
            worker_version: env!("CARGO_PKG_VERSION").into(),
            models: models.into_iter().map(with_capabilities).collect(),
        })
    }

    fn initialize(
        &self,
        request: &v1::InitializeRequest,
    ) -> Result<v1::InitializeReply, CallError> {
        self.initialize_as(request, None)
    }

    fn initialize_for(
        &self,
        request: &v1::InitializeRequest,
        owner: &Owner,
    ) -> Result<v1::InitializeReply, CallError> {
        self.initialize_as(request, Some(owner))
    }

    fn may_use(&self, instance: u64, caller: &Owner) -> bool {
        let table = self.table();
        let slot = table.get(&instance);
        slot.is_none_or(|slot| slot.belongs_to(Some(caller)))
    }

    fn snapshot(&self, request: &v1::SnapshotRequest) -> Result<v1::SnapshotReply, CallError> {
        let reply = self.with_instance(request.instance, request.span(), |instance| {
            instance.snapshot(request)
        })?;
        Ok(reply.to(request))
    }

    fn restore(&self, request: &v1::RestoreRequest) -> Result<v1::RestoreReply, CallError> {
        let reply = self.with_instance(request.instance, request.span(), |instance| {
            instance.restore(request)
        })?;
        Ok(reply.to(request))
    }

    fn export_state(
        &self,
        request: &v1::ExportStateRequest,
    ) -> Result<v1::ExportStateReply, CallError> {
        let reply = self.with_instance(request.instance, request.span(), |instance| {
            instance.export()
        })?;
        Ok(reply.to(request))
    }

    fn import_state(
        &self,
        request: &v1::ImportStateRequest,
    ) -> Result<v1::ImportStateReply, CallError> {
        let reply = self.with_instance(request.instance, request.span(), |instance| {
            instance.import(request)
        })?;
        Ok(reply.to(request))
    }

    fn step(&self, request: &v1::StepRequest) -> Result<v1::StepReply, CallError> {
        let reply = self.with_instance(request.instance, request.span(), |instance| {
            instance.step(request)
        })?;
        Ok(reply.to(request))
    }

    fn perturbed_step(
        &self,
        request: &v1::PerturbedStepRequest,
    ) -> Result<v1::PerturbedStepReply, CallError> {
        let reply = self.with_instance(request.instance, request.span(), |instance| {
            instance.perturbed_step(request)
        })?;
        Ok(reply.to(request))
    }

    fn evaluate(&self, request: &v1::EvaluateRequest) -> Result<v1::EvaluateReply, CallError> {
        let reply = self.with_instance(request.instance, request.span(), |instance| {
            instance.evaluate(request)
        })?;
        Ok(reply.to(request))
    }

    fn terminate(&self, request: &v1::TerminateRequest) -> Result<v1::TerminateReply, CallError> {
        let slot = self.change_table().remove(&request.instance);
        if let Some(slot) = slot {
            slot.end();
        }
        Ok(v1::TerminateReply::default().to(request))
    }

    fn exchange(
        &self,
        request: &v1::ExchangeRequest,
        reply: &mut v1::ExchangeReply,
    ) -> Result<(), CallError> {
        self.with_instance(request.instance, request.span(), |instance| {
            instance.exchange(request, reply)
        })
    }

    fn list_instances(
        &self,
        _: &v1::ListInstancesRequest,
    ) -> Result<v1::ListInstancesReply, CallError> {
        self.tidy();
        let table = self.table();
        let instances = table.values().map(|slot| slot.state());
        Ok(v1::ListInstancesReply {
            instances: instances.collect(),
        })
    }

    fn is_short(&self, instance: u64, span: f64) -> bool {
        let table = self.table();
        let slot = table.get(&instance);
        slot.is_none_or(|slot| slot.is_short(span))
    }

    fn hold(&self, instance: u64, by: &Hold) {
        if let Some(slot) = self.table().get(&instance) {
            slot.hold(by);
        }
    }

    fn tidy(&self) {
        if self.table().values().any(|slot| slot.is_over()) {
            let over = take(&mut self.change_table(), |slot| slot.is_over());
            drop(over);
        }
    }
}

/// Takes out the instances that are `gone`.
fn take(instances: &mut Instances, gone: impl Fn(&Slot) -> bool) -> Vec<Arc<Slot>> {
    let gone = instances.iter().filter(|(_, slot)| gone(slot));
    let numbers: Vec<u64> = gone.map(|(&number, _)| number).collect();
    let taken = numbers.iter().filter_map(|number| instances.remove(number));
    taken.collect()
}

fn with_capabilities(mut model: v1::Model) -> v1::Model {
    let own = model.capabilities.unwrap_or_default();
    model.capabilities = Some(v1::Capabilities {
        exchange: true,
        repeats_step_sequence: own.repeats_step_sequence,
        max_input_degree: Some(MAX_NODES as u32 - 1),
        exportable_snapshot: own.exportable_snapshot,
        joint_loads: own.joint_loads,
        directional_derivatives: own.directional_derivatives,
        interior_outputs: true,
        output_integrals: own.output_integrals,
        impulses: own.impulses,
        impacts: own.impacts,
    });
    model
}

fn refuse(error: SetupError) -> Failure {
    Failure::misuse(error.field(), error.to_string())
}

/// A solver that panics fails its own call only.
fn without_panic<T>(call: impl FnOnce() -> Result<T, Failure>) -> Result<T, Failure> {
    catch_unwind(AssertUnwindSafe(call)).unwrap_or_else(|panic| {
        Err(Failure::fatal(format!(
            "the solver panicked: {}",
            words(&*panic)
        )))
    })
}

fn words(panic: &(dyn Any + Send)) -> &str {
    match (panic.downcast_ref::<&str>(), panic.downcast_ref::<String>()) {
        (Some(words), _) => words,
        (None, Some(words)) => words,
        (None, None) => "it did not say why",
    }
}

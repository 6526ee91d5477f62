//! From a scene to a co-simulation at its first macro point.

use linchpin_proto::v1;
use nalgebra::UnitQuaternion;

use super::corrected::look_ahead;
use super::degrees::{check_degrees, load_forms};
use super::initial::InitialState;
use super::mechanism::Mechanism;
use super::options::{Connect, Options};
use super::refusal::{Refusals, refuse_setup};
use super::renewal::Renewal;
use super::run::CoSimulation;
use super::scheme::Scheme;
use super::step_size::{StepSize, plan_of, step_size_of};
use super::tie::{
    connect_signals, mark, model_of, record_markers, recorded_outputs, refuse_marker,
};
use super::{panels, penalty, velocities};
use crate::coupling::automatic_degrees::AutomaticDegrees;
use crate::coupling::columns::{Basis, Measuring};
use crate::coupling::condition::{Condition, level_of};
use crate::coupling::corrector::Corrector;
use crate::coupling::explicit::Explicit;
use crate::coupling::hermite::Hermite;
use crate::coupling::penalty::{Penalty, write_loads};
use crate::coupling::semi_implicit::SemiImplicit;
use crate::error::RunError;
use crate::layout::{Coupled, Layout};
use crate::results::{Guard, Row, Statistics, StepDegrees};
use crate::scene::{self, Coupling, Degree, Jacobian, Method, Scene};
use crate::signal::{History, Variables};
use crate::time::{MacroStep, TimePlan, at_start};
use crate::workers::{Parts, Samples, Subsystem};

impl CoSimulation {
    /// Connects to all workers, initialises them, closes the joints and looks ahead over the first macro step.
    pub fn start(
        scene: &Scene,
        connect: &mut Connect<'_>,
        options: &Options,
    ) -> Result<Self, RunError> {
        let mut subsystems = connect_all(scene, connect)?;
        let models = models_of(scene, &subsystems)?;
        let joints = mark(scene, &models)?;
        let connections = connect_signals(scene, &models)?;
        let coupled = Coupled {
            subsystems: names(scene),
            forms: load_forms(scene, &models)?,
            joints: &joints,
            connections: &connections,
        };
        let layout = layout_of(scene, &coupled)?;
        let highest = check_degrees(scene, &models, &layout)?;
        refuse_mixed_degrees(scene, &layout)?;
        let mut recorded = recorded_outputs(scene, &models, &layout.outputs)?;
        if options.record_markers {
            record_markers(&models, &layout.outputs, &mut recorded);
        }
        let mut requests: Vec<_> = (0..subsystems.len())
            .map(|number| initialize_request(scene, number, &models, &layout, &recorded[number]))
            .collect();
        let mut refusals = Refusals::default();
        for (number, subsystem) in subsystems.iter_mut().enumerate() {
            let model = &models[number];
            let capabilities = model.capabilities.unwrap_or_default();
            subsystem.repeats_steps = capabilities.repeats_step_sequence;
            subsystem.offers_derivatives = capabilities.directional_derivatives;
            if let Err(error) = subsystem.initialize(requests[number].clone()) {
                refusals.collect(refuse_setup(scene, number, model, subsystem, error))?;
            }
        }
        refusals.finish()?;
        let mut parts = Parts {
            subsystems,
            layout,
            samples: scene
                .output
                .interval
                .map(|interval| Samples::new(scene.t_start, interval)),
        };
        let free_velocities =
            velocities::choose(scene, &coupled, &models, &mut requests, &mut parts)?;
        let initial = initial_state(scene, &coupled, &parts, options)?;
        initial.read_outputs(scene.t_start, &mut parts)?;
        let plan = plan_of(scene, options);
        let mut step_size = step_size_of(scene, options, &parts);
        let steps = (&plan, step_size.as_mut());
        let scheme = begin(scene, options, initial, highest, &mut parts, steps)?;
        let degrees = scheme.degrees();
        let shows_step = scene.coupling.step_control.is_some();
        let named = parts
            .subsystems
            .iter()
            .map(|own| (own.name(), &own.output_names[..]));
        let mut row = Row::new(&parts.layout, named, shows_step, degrees);
        let start = at_start(scene.t_start);
        let outputs = |subsystem: usize| &parts.subsystems[subsystem].outputs[..];
        row.read(start, degrees, &parts.layout, outputs, scheme.multipliers());
        panels::check(scene, &row)?;
        let mechanism = options
            .record_markers
            .then(|| Mechanism::new(scene, &models, &joints, row.columns()));
        let guard = match &scene.coupling.method {
            _ if options.watch_nothing => Guard::off(),
            Method::Penalty { .. } => Guard::of_springs(),
            _ => Guard::of_rigid_joints(),
        };
        let mut statistics = Statistics::new(&parts.layout);
        statistics.free_velocities = free_velocities;
        let multipliers = parts.layout.rows.len();
        Ok(Self {
            parts,
            scheme,
            renewal: Renewal::new(&scene.coupling),
            plan,
            step_size,
            sample_row: row.clone(),
            multipliers: vec![0.0; multipliers],
            last_length: 0.0,
            row,
            mechanism,
            guard,
            statistics,
        })
    }
}

/// Asks the worker of every subsystem what the scene's model of it offers; starts no instance.
pub fn describe(scene: &Scene, connect: &mut Connect<'_>) -> Result<Vec<v1::Model>, RunError> {
    models_of(scene, &connect_all(scene, connect)?)
}

fn models_of(scene: &Scene, subsystems: &[Subsystem]) -> Result<Vec<v1::Model>, RunError> {
    let all = subsystems.iter().enumerate();
    all.map(|(number, subsystem)| model_of(scene, number, subsystem))
        .collect()
}

fn connect_all(scene: &Scene, connect: &mut Connect<'_>) -> Result<Vec<Subsystem>, RunError> {
    let connect_one = |subsystem: &scene::Subsystem| {
        let connection = connect(scene, subsystem).map_err(|source| RunError::Start {
            subsystem: subsystem.name.clone(),
            source: Box::new(source),
        })?;
        let (name, model) = (&subsystem.name, &subsystem.model);
        tracing::debug!(subsystem = name, model, "connected");
        Ok(Subsystem::new(&subsystem.name, connection))
    };
    scene.subsystems.iter().map(connect_one).collect()
}

fn names(scene: &Scene) -> Vec<&str> {
    let subsystems = scene.subsystems.iter();
    subsystems
        .map(|subsystem| subsystem.name.as_str())
        .collect()
}

fn layout_of(scene: &Scene, coupled: &Coupled<'_>) -> Result<Layout, RunError> {
    let method = &scene.coupling.method;
    let layout = match method {
        Method::Hermite { .. } => Layout::with_rates(coupled, level_of(method)),
        _ => Layout::new(coupled, level_of(method)),
    };
    let mut layout = layout.map_err(|lacks| refuse_marker(scene, lacks))?;
    if method.keeps_columns() && scene.coupling.jacobian == Jacobian::Reuse {
        layout.add_frames(coupled);
    }
    Ok(layout)
}

fn initial_state(
    scene: &Scene,
    coupled: &Coupled<'_>,
    parts: &Parts,
    options: &Options,
) -> Result<InitialState, RunError> {
    let accepts_open = options.accept_open_joints;
    match scene.coupling.method {
        _ if options.established.is_some() => Ok(InitialState::at_rest(parts.layout.variables())),
        Method::Penalty { .. } => InitialState::unloaded(scene, parts, accepts_open),
        _ => InitialState::find(scene, coupled, parts, accepts_open),
    }
}

/// A signal and the load of a joint at one input are one polynomial, so they must have one degree.
fn refuse_mixed_degrees(scene: &Scene, layout: &Layout) -> Result<(), RunError> {
    let (degree, exchanged) = (scene.coupling.degree, scene.coupling.exchanged_degree);
    let is_hermite = matches!(scene.coupling.method, Method::Hermite { .. });
    let is_loaded = |connection: &&scene::Connection| {
        let (subsystem, name) = &connection.to;
        let mut inputs = layout.inputs_of(*subsystem).iter();
        inputs.any(|input| {
            !input.is_joint_input && input.name == *name && input.drives_load(layout.rows.len())
        })
    };
    match scene.connections.iter().find(is_loaded) {
        Some(connection) if is_hermite => {
            let (subsystem, input) = &connection.to;
            let message = format!(
                "\"{}.{input}\" takes this signal and the load of a joint, which have different curves with Hermite coupling",
                scene.subsystems[*subsystem].name
            );
            let help = "let the signal act at another marker, or choose another coupling.method";
            let key = format!("connection.{}.to", connection.name);
            Err(scene.error(&key, message, Some(help.into())).into())
        }
        Some(connection) if degree != exchanged || degree == Degree::Automatic => {
            let (subsystem, input) = &connection.to;
            let differ = match degree == exchanged {
                true => "follow estimates of their own",
                false => "differ",
            };
            let message = format!(
                "\"{}.{input}\" takes this signal and the load of a joint, but coupling.degree = {degree} and \
                 coupling.exchanged_degree = {exchanged} {differ}",
                scene.subsystems[*subsystem].name
            );
            let help = "give both the same whole number, or let the signal act at another marker";
            let key = format!("connection.{}.to", connection.name);
            Err(scene.error(&key, message, Some(help.into())).into())
        }
        _ => Ok(()),
    }
}

fn initialize_request(
    scene: &Scene,
    number: usize,
    models: &[v1::Model],
    layout: &Layout,
    recorded: &[String],
) -> v1::InitializeRequest {
    let written = &scene.subsystems[number];
    v1::InitializeRequest {
        model: models[number].name.clone(),
        parameters: written.parameters.clone(),
        solver: written.solver.clone(),
        t_start: scene.t_start,
        inputs: input_names(layout, number, false),
        joint_inputs: input_names(layout, number, true),
        joint_loads: layout.joint_loads[number].clone(),
        coupling_outputs: layout.outputs[number].clone(),
        recorded_outputs: recorded.to_vec(),
        ..v1::InitializeRequest::default()
    }
}

fn input_names(layout: &Layout, number: usize, are_joint_inputs: bool) -> Vec<String> {
    let inputs = layout.inputs_of(number).iter();
    let inputs = inputs.filter(|input| input.is_joint_input == are_joint_inputs);
    inputs.map(|input| input.name.clone()).collect()
}

/// Makes the method of the scene and lets it look ahead over the first macro step.
fn begin(
    scene: &Scene,
    options: &Options,
    initial: InitialState,
    highest: StepDegrees,
    parts: &mut Parts,
    (plan, step_size): (&TimePlan, Option<&mut StepSize>),
) -> Result<Scheme, RunError> {
    let coupling = &scene.coupling;
    let InitialState {
        variables: mut values,
        attitudes,
    } = initial;
    let variables = parts.layout.describe_variables(
        coupling.degree.highest(),
        coupling.exchanged_degree.highest(),
    );
    let condition = match coupling.method {
        Method::Baumgarte { beta, gamma, .. } => Condition::Baumgarte { beta, gamma },
        Method::Weighted { a, b, .. } => Condition::Weighted { a, b },
        Method::Hermite { variant } => {
            let start = options
                .established
                .as_ref()
                .and_then(|values| values.first());
            let variables = Variables {
                degrees: vec![coupling.exchanged_degree.highest(); parts.layout.variables()],
                rotations: Vec::new(),
            };
            let values = start.map_or(&values[..variables.degrees.len()], |start| start);
            let history = History::new(variables, values, attitudes);
            let method = Hermite::new(variant, measuring(coupling), history, parts);
            return begin_corrected(Box::new(method), parts, plan, step_size);
        }
        Method::Explicit { mu } => {
            let history = History::new(variables, &values, attitudes);
            let mut method = Explicit::new(mu, coupling.increment, history, parts);
            method.begin(parts, first_step(plan))?;
            return Ok(Scheme::Uncorrected(Box::new(method)));
        }
        Method::Penalty {
            order,
            lengths,
            angles,
        } => {
            let springs = penalty::springs_of(scene, lengths, angles, &parts.layout)?;
            let outputs = |subsystem: usize| parts.subsystems[subsystem].coupling_values();
            write_loads(&springs, &parts.layout, outputs, &mut values);
            let history = history_of(scene, options, variables, &values, attitudes);
            let degree = coupling.exchanged_degree.highest();
            let method = Penalty::new(order, springs, history, degree, parts);
            return Ok(Scheme::Uncorrected(Box::new(method)));
        }
    };
    let history = history_of(scene, options, variables, &values, attitudes);
    let first = first_step(plan).length;
    let given = options.degrees.clone();
    let automatic = AutomaticDegrees::new(coupling.method, &parts.layout, highest, first, given);
    let method = SemiImplicit::new(condition, measuring(coupling), history, automatic, parts);
    begin_corrected(Box::new(method), parts, plan, step_size)
}

/// Where steps or degrees vary, the past nodes of the polynomials do: columns that stay in use must serve with any of them. With Hermite coupling there
/// are as many powers as shapes, and between lengths they are found more easily: their responses do not pass through zero.
fn measuring(coupling: &Coupling) -> Measuring {
    let is_hermite = matches!(coupling.method, Method::Hermite { .. });
    let varies = coupling.step_control.is_some() || coupling.has_automatic_degree();
    let stay = coupling.jacobian == Jacobian::Reuse;
    Measuring {
        increment: coupling.increment,
        basis: match stay && (varies || is_hermite) {
            true => Basis::Powers,
            false => Basis::Shapes,
        },
        stay,
    }
}

/// Lets a predictor/corrector method look ahead over the first macro step.
fn begin_corrected(
    mut method: Box<dyn Corrector>,
    parts: &mut Parts,
    plan: &TimePlan,
    step_size: Option<&mut StepSize>,
) -> Result<Scheme, RunError> {
    let first = first_step(plan);
    look_ahead(&mut *method, parts, (first, true), step_size)?;
    Ok(Scheme::Corrected(method))
}

/// The coupling variables up to the first macro point, where they have these `values` unless a study gives them.
fn history_of(
    scene: &Scene,
    options: &Options,
    variables: Variables,
    values: &[f64],
    attitudes: Vec<UnitQuaternion<f64>>,
) -> History {
    let step = scene.coupling.macro_step;
    match &options.established {
        Some(established) => History::established(variables, step, established, attitudes),
        None => History::new(variables, values, attitudes),
    }
}

/// The scene has checked that the time span is at least one step long.
fn first_step(plan: &TimePlan) -> MacroStep {
    plan.step().unwrap_or_else(|| at_start(plan.t()))
}

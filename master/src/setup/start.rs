//! From a scene to a co-simulation at its first macro point.

use linchpin_proto::v1;

use super::degrees::{check_degrees, fit, layout_of, load_forms};
use super::discover::{connect_signals, mark, model_of, record_markers, recorded_outputs};
use super::initial::InitialState;
use super::instances::{initialize, initialize_request, names};
use super::options::{Connect, Options};
use super::steps::{plan_of, solver_tolerances, step_size_of};
use super::{consistent, fitting, forward_only, impacts, inside, panels, redundancy, velocities};
use crate::accuracy::StepErrors;
use crate::error::RunError;
use crate::joint::Level;
use crate::layout::{Coupled, Layout};
use crate::macro_step::{
    Colliding, Corrector, Impacts, Jacobian, PointJacobian, Run, look_ahead, reach,
};
use crate::methods::{Built, Given, Lacking};
use crate::policies::columns::{Basis, Columns, Measuring};
use crate::policies::degree::AutomaticDegrees;
use crate::policies::iteration::IterationControl;
use crate::results::{Guard, Mechanism, OfStep, Row, Statistics, StepDegrees, described};
use crate::run::CoSimulation;
use crate::scene::{self, Coupling, Degree, Scene};
use crate::system::{Differentiation, Outputs, Sizes, System};
use crate::time::at_start;
use crate::workers::{RecoverySettings, Samples, Subsystem, Workers};

impl CoSimulation {
    /// Connects to all workers, initialises them, closes the joints and looks ahead over the first macro step.
    pub fn start(
        scene: &Scene,
        connect: &mut Connect<'_>,
        options: &Options,
    ) -> Result<Self, RunError> {
        let mut subsystems = connect_all(scene, connect)?;
        let models = models_of(scene, &subsystems)?;
        for (number, model) in models.iter().enumerate() {
            forward_only::refuse(scene, number, model)?;
        }
        let (scene, fitted_joints) = fitting::fit(scene, &models, &mut subsystems, options)?;
        let joints = mark(&scene, &models)?;
        let connections = connect_signals(&scene, &models)?;
        let scene = &fit(&scene, &models, &joints, &connections);
        let coupled = Coupled {
            subsystems: names(scene),
            forms: load_forms(scene, &models)?,
            joints: &joints,
            connections: &connections,
        };
        let mut layout = layout_of(scene, &coupled)?;
        inside::look(scene, &models, &mut layout)?;
        let highest = check_degrees(scene, &models, &layout)?;
        let colliding = impacts::groups(scene, &models, &joints, &layout)?;
        refuse_mixed_degrees(scene, &layout)?;
        let mut recorded = recorded_outputs(scene, &models, &layout.outputs)?;
        if options.record_markers {
            record_markers(&models, &layout.outputs, &mut recorded);
        }
        let mut requests: Vec<_> = (0..subsystems.len())
            .map(|number| initialize_request(scene, number, &models, &layout, &recorded[number]))
            .collect();
        initialize(scene, &models, &requests, &mut subsystems)?;
        for group in &colliding {
            subsystems[group.finder].couples_impacts = true;
        }
        let samples = scene.output.interval;
        let samples = samples.map(|interval| Samples::new(scene.t_start, interval));
        let mut workers = Workers::new(subsystems, samples, layout.variables());
        let free_velocities =
            velocities::choose(scene, &coupled, &models, &mut requests, &mut workers)?;
        let initial = initial_state(scene, &coupled, &layout, &workers, options)?;
        initial.read_outputs(scene.t_start, &layout, &mut workers)?;
        layout.border = initial.border.clone();
        let redundancy = redundancy::told(&layout);
        let mut run = assemble(
            scene,
            options,
            layout,
            workers,
            initial,
            (highest, colliding),
        )?;
        begin(&mut run)?;
        let shows_step = scene.coupling.step_control.is_some();
        let subsystems = run.workers.subsystems.iter();
        let named = subsystems.map(|own| (own.name(), &own.output_names[..]));
        let degrees = run.degrees.as_ref();
        let degrees = degrees.map_or_else(StepDegrees::default, |own| own.of_last_step(|_| 0));
        let error = run.errors.of_last_step();
        let of_step = OfStep { degrees, error };
        let mut row = Row::new(&run.layout, named, shows_step, of_step);
        row.describe(described(&row, &run.layout, &models, &joints));
        let points: Vec<_> = scene
            .joints
            .iter()
            .map(|joint| joint.geometry.points.clone())
            .collect();
        let names = names(scene).into_iter().map(str::to_owned).collect();
        let mechanism = options
            .record_markers
            .then(|| Mechanism::new(names, &points, &models, &joints, row.columns()));
        let mut statistics = Statistics::new(&run.layout);
        statistics.free_velocities = free_velocities;
        statistics.fitted_joints = fitted_joints;
        statistics.redundancy = redundancy;
        let mut simulation = Self {
            multipliers: vec![0.0; run.layout.rows.len()],
            run,
            sample_row: row.clone(),
            row,
            mechanism,
            guard: Guard::off(),
            statistics,
        };
        simulation.read_row(at_start(scene.t_start));
        let size = { &simulation.run.layout }
            .size(|subsystem, place| simulation.row.output(subsystem, place));
        simulation.guard = match scene.coupling.method.parameters().closes_joints() {
            _ if options.watch_nothing => Guard::off(),
            false => Guard::of_springs(&simulation.row),
            true => Guard::of_rigid_joints(size, &simulation.row),
        };
        panels::check(scene, &simulation.row)?;
        Ok(simulation)
    }
}

/// The method of the scene and its policies, at the first macro point.
fn assemble(
    scene: &Scene,
    options: &Options,
    layout: Layout,
    workers: Workers,
    initial: InitialState,
    (highest, colliding): (StepDegrees, Vec<Colliding>),
) -> Result<Run, RunError> {
    let coupling = &scene.coupling;
    let plan = plan_of(scene, options);
    let step_size = step_size_of(scene, options, &layout, &workers);
    let given = Given {
        layout: &layout,
        outputs: &workers.now(),
        values: initial.variables,
        attitudes: initial.attitudes,
        degrees: [coupling.degree, coupling.exchanged_degree],
        macro_step: coupling.macro_step,
        established: options.established.as_deref(),
    };
    let built = coupling.method.parameters().build(given);
    let Built {
        mut method,
        end,
        point,
    } = built
        .map_err(|Lacking { message, help }| scene.error("coupling.method", message, Some(help)))?;
    let subsystems = workers.subsystems.iter();
    let differentiation: Vec<Differentiation> =
        subsystems.map(Subsystem::differentiation).collect();
    let size = layout.size(|subsystem, place| workers.now().of(subsystem)[place]);
    let sizes = Sizes {
        length: size,
        span: scene.t_end - scene.t_start,
    };
    let measuring = measuring(coupling, sizes);
    let jacobian = |(system, levels): (System, &'static [Level])| {
        let unknowns = system.unknowns();
        let mut columns = Columns::new(measuring, levels, &layout, unknowns, &differentiation);
        columns.foresee(&initial.responses);
        Jacobian { columns, system }
    };
    let first = plan.step().map_or(0.0, |step| step.length);
    let given = options.degrees.clone();
    let of_scene = coupling.method;
    let stable = Box::new(move |length| scene::highest_stable_degree(of_scene, length));
    let first_degree = method.corrected().and_then(|own| own.first_degree());
    let corrects = end.is_some() && layout.variables() > 0;
    Ok(Run {
        degrees: AutomaticDegrees::new(stable, &layout, highest, first_degree, first, given),
        impacts: end
            .as_ref()
            .filter(|_| !colliding.is_empty())
            .map(|(end, _)| Impacts::new(colliding, &layout, end.unknowns())),
        corrector: end.map(|end| Corrector::new(jacobian(end), &layout)),
        point: point.map(|point| PointJacobian::new(jacobian(point))),
        iteration: IterationControl::new(
            coupling.jacobian,
            coupling.iterations,
            coupling.step_control.is_some(),
        ),
        refusal: None,
        errors: StepErrors::new(
            corrects,
            &layout,
            solver_tolerances(&workers),
            &workers.now(),
        ),
        layout,
        workers,
        method,
        step_size,
        plan,
    })
}

/// Lets the method look ahead over the first macro step, or solve the conditions at the first macro point. The scene has checked that
/// the time span is at least one step long.
fn begin(run: &mut Run) -> Result<(), RunError> {
    let first = run.plan.step().unwrap_or_else(|| at_start(run.plan.t()));
    if let Some((mut own, policies)) = run.correcting() {
        if let Some(degrees) = policies.degrees {
            own.apply(degrees);
        }
        return look_ahead(run, first, Some(true));
    }
    if let Some(point) = &mut run.point {
        run.workers.forgo_advance();
        point.request(&mut run.workers, &run.layout, &*run.method, first.start);
        run.workers.exchange(first)?;
        reach(run, first)?;
    }
    Ok(())
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
    let numbers = 0..scene.subsystems.len();
    { numbers }
        .map(|number| connect_one(scene, number, connect))
        .collect()
}

/// Connects to the worker of a subsystem.
pub(super) fn connect_one(
    scene: &Scene,
    number: usize,
    connect: &mut Connect<'_>,
) -> Result<Subsystem, RunError> {
    let subsystem = &scene.subsystems[number];
    let connection = connect(scene, subsystem).map_err(|source| RunError::Start {
        subsystem: subsystem.name.clone(),
        source: Box::new(source),
    })?;
    let recovery = RecoverySettings {
        attempts: scene.run.recoveries,
        export_every: scene.run.export_every as u64,
    };
    let (name, model) = (&subsystem.name, &subsystem.model);
    tracing::debug!(subsystem = name, model, "connected");
    Ok(Subsystem::new(&subsystem.name, connection, recovery))
}

fn initial_state(
    scene: &Scene,
    coupled: &Coupled<'_>,
    layout: &Layout,
    workers: &Workers,
    options: &Options,
) -> Result<InitialState, RunError> {
    let accepts_open = options.accept_open_joints;
    let closes_joints = scene.coupling.method.parameters().closes_joints();
    match options.established {
        Some(_) => Ok(InitialState::at_rest(layout.variables())),
        None if closes_joints => consistent::find(scene, coupled, layout, workers, accepts_open),
        None => consistent::unloaded(scene, coupled, layout, workers, accepts_open),
    }
}

/// A signal and the load of a joint at one input are one polynomial, so they must have one degree.
fn refuse_mixed_degrees(scene: &Scene, layout: &Layout) -> Result<(), RunError> {
    let (degree, exchanged) = (scene.coupling.degree, scene.coupling.exchanged_degree);
    let own_curves = scene.coupling.method.parameters().own_curves();
    let is_loaded = |connection: &&scene::Connection| {
        let (subsystem, name) = &connection.to;
        let mut inputs = layout.inputs_of(*subsystem).iter();
        inputs.any(|input| {
            !input.is_joint_input && input.name == *name && input.drives_load(layout.rows.len())
        })
    };
    match scene.connections.iter().find(is_loaded) {
        Some(connection) if own_curves.is_some() => {
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

/// Where steps or degrees vary, the past nodes of the polynomials do: columns that stay in use must serve with any of them. With Hermite coupling there
/// are as many powers as shapes, and between lengths they are found more easily: their responses do not pass through zero.
fn measuring(coupling: &Coupling, sizes: Sizes) -> Measuring {
    let own_curves = coupling.method.parameters().own_curves();
    let varies = coupling.step_control.is_some() || coupling.has_automatic_degree();
    let stay = coupling.jacobian == scene::Jacobian::Reuse;
    Measuring {
        increment: coupling.increment,
        sizes,
        basis: match stay && (varies || own_curves.is_some()) {
            true => Basis::Powers,
            false => Basis::Shapes,
        },
        stay,
    }
}

//! What sound scenes resolve to.

use crate::methods::{Baumgarte, Explicit, Penalty, Weighted};
use linchpin_proto::v1::{self, value::Kind};

use super::super::{
    Axis, Calls, Degree, Increment, Index, JointKind, Method, Order, Reference, RunSettings,
    Served, Side, Spring, load,
};
use super::{EXAMPLE, coupled, example, scene};

fn method(settings: &str) -> Method {
    coupled(settings)
        .unwrap_or_else(|errors| panic!("{errors}"))
        .coupling
        .method
}

fn number(value: f64) -> v1::Value {
    v1::Value {
        kind: Some(Kind::Number(value)),
    }
}

#[test]
fn the_example_resolves_to_what_it_says() {
    let scene = example();
    assert_eq!(scene.name, "oscillator");
    assert_eq!((scene.t_start, scene.t_end), (0.0, 1.0));
    assert_eq!(scene.coupling.macro_step, 1e-3);
    assert_eq!(scene.coupling.degree, Degree::Fixed(0));
    assert_eq!(scene.coupling.increment, Increment::Automatic);
    let expected = Method::Baumgarte(Baumgarte {
        index: Index::Two,
        beta: 2e-3.into(),
        gamma: 0.0.into(),
    });
    assert_eq!(scene.coupling.method, expected);
    let [mass1, mass2] = &scene.subsystems[..] else {
        panic!("{:?}", scene.subsystems)
    };
    assert_eq!((&*mass1.name, &*mass2.name), ("mass1", "mass2"));
    assert_eq!(mass1.served, Served::BuiltIn);
    assert_eq!(mass1.model.as_deref(), Some("oscillator"));
    assert_eq!(mass2.parameters["m"], number(2.0));
    assert_eq!(mass2.parameters.len(), 5);
    assert_eq!(mass1.solver.as_ref().unwrap().kind, "exact");
    assert_eq!(mass1.calls, Calls::Automatic);
    let [link] = &scene.joints[..] else {
        panic!("{:?}", scene.joints)
    };
    assert_eq!((&*link.name, link.kind), ("link", JointKind::RigidLink));
    assert_eq!((link.a.subsystem, link.b.subsystem), (0, 1));
    assert_eq!(link.multiplier, None);
    assert_eq!(scene.output.every, 1);
    let run = RunSettings {
        deadline: 30.0,
        start_timeout: 10.0,
        recoveries: 3,
        export_every: 1000,
        checkpoint_every: 30.0,
        checkpoint_steps: None,
        most_poor: 0.5,
    };
    assert_eq!(scene.run, run);
    assert_eq!((scene.converge, scene.stability), (None, None));
}

#[test]
fn a_file_reads_like_its_text() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("oscillator.toml");
    std::fs::write(&path, EXAMPLE).unwrap();
    let scene = load(&path, &[]).unwrap();
    assert_eq!(scene.subsystems, example().subsystems);
    let place = scene.place("coupling.beta").unwrap();
    assert_eq!(place.origin(), path.display().to_string());
}

#[test]
fn the_index_follows_from_the_parameters() {
    let baumgarte = |index, beta: f64, gamma: f64| {
        Method::Baumgarte(Baumgarte {
            index,
            beta: beta.into(),
            gamma: gamma.into(),
        })
    };
    let weighted = |index, a, b| Method::Weighted(Weighted { index, a, b });
    let (h, h2) = (1e-3, 1e-3 * 1e-3);
    for (settings, expected) in [
        ("method = 'baumgarte'", baumgarte(Index::One, 2.0 * h, h2)),
        (
            "method = 'baumgarte'\nindex = 1",
            baumgarte(Index::One, 2.0 * h, h2),
        ),
        (
            "method = 'baumgarte'\nindex = 2",
            baumgarte(Index::Two, 2.0 * h, 0.0),
        ),
        (
            "method = 'baumgarte'\nindex = 3",
            baumgarte(Index::Three, 0.0, 0.0),
        ),
        (
            "method = 'baumgarte'\nbeta = 0.2",
            baumgarte(Index::Two, 0.2, 0.0),
        ),
        (
            "method = 'baumgarte'\nbeta = 0",
            baumgarte(Index::Three, 0.0, 0.0),
        ),
        (
            "method = 'baumgarte'\nindex = 1\nbeta = 0.2",
            baumgarte(Index::One, 0.2, h2),
        ),
        (
            "method = 'baumgarte'\nbeta = '3H'\ngamma = '0.5 H^2'",
            baumgarte(Index::One, 3.0 * h, 0.5 * h2),
        ),
        (
            "method = 'baumgarte'\nbeta = '3 H'\ngamma = 'H^2'",
            baumgarte(Index::One, 3.0 * h, h2),
        ),
        (
            "method = 'baumgarte'\nbeta = 'H'\ngamma = 1e-2",
            baumgarte(Index::One, h, 1e-2),
        ),
        ("method = 'weighted'", weighted(Index::One, 2.0, 2.6)),
        (
            "method = 'weighted'\nindex = 2",
            weighted(Index::Two, 2.0, 0.0),
        ),
        (
            "method = 'weighted'\na = 7\nb = 0.3",
            weighted(Index::One, 7.0, 0.3),
        ),
        ("method = 'weighted'\na = 7", weighted(Index::Two, 7.0, 0.0)),
        (
            "method = 'weighted'\na = 0\nb = 0",
            weighted(Index::Three, 0.0, 0.0),
        ),
    ] {
        assert_eq!(method(settings), expected, "{settings}");
    }
}

#[test]
fn methods_without_an_index_have_their_own_parameters() {
    let mu = 10.0 * 1e-3;
    assert_eq!(
        method("method = 'explicit'\nmu = '10H'"),
        Method::Explicit(Explicit { mu: mu.into() })
    );
}

#[test]
fn a_penalty_has_springs_for_lengths_and_for_angles() {
    let penalty = |order, lengths, angles| {
        Method::Penalty(Penalty {
            order,
            lengths,
            angles,
        })
    };
    let spring = |stiffness, damping| Some(Spring { stiffness, damping });
    for (settings, expected) in [
        (
            "stiffness = 3e5",
            penalty(Order::Jacobi, spring(3e5, 0.0), None),
        ),
        (
            "angular_stiffness = 7\nangular_damping = 0.3\norder = 'gauss-seidel'",
            penalty(Order::GaussSeidel, None, spring(7.0, 0.3)),
        ),
        (
            "order = 'jacobi'\nstiffness = 1\ndamping = 2\nangular_stiffness = 5",
            penalty(Order::Jacobi, spring(1.0, 2.0), spring(5.0, 0.0)),
        ),
        // Masses over the macro step of 1e-3 s.
        (
            "stiffness = '2.5/H^2'\ndamping = '1.5 /H'",
            penalty(Order::Jacobi, spring(2.5 / (1e-3 * 1e-3), 1.5 / 1e-3), None),
        ),
    ] {
        assert_eq!(method(&format!("method = 'penalty'\n{settings}")), expected);
    }
}

#[test]
fn the_degree_has_a_default_that_the_method_allows() {
    let degree = |settings| {
        let degree = coupled(settings).unwrap().coupling.degree;
        degree.fixed().unwrap()
    };
    assert_eq!(degree("method = 'weighted'"), 1);
    assert_eq!(degree("method = 'weighted'\ndegree = 3"), 3);
    assert_eq!(degree("method = 'explicit'\nmu = 0.5"), 0);
}

#[test]
fn degrees_that_follow_the_estimates() {
    let degrees = |settings| {
        let coupling = coupled(settings).unwrap().coupling;
        (coupling.degree, coupling.exchanged_degree)
    };
    let both = degrees("method = 'weighted'\ndegree = 'automatic'");
    assert_eq!(both, (Degree::Automatic, Degree::Automatic));
    let one = degrees("method = 'baumgarte'\ndegree = 'automatic'\nexchanged_degree = 3");
    assert_eq!(one, (Degree::Automatic, Degree::Fixed(3)));
    let other = degrees("method = 'baumgarte'\nexchanged_degree = 'automatic'");
    assert_eq!(other, (Degree::Fixed(1), Degree::Automatic));
}

#[test]
fn the_increment_is_automatic_or_a_number() {
    let increment = |settings| coupled(settings).unwrap().coupling.increment;
    let automatic = increment("method = 'weighted'\nincrement = 'automatic'");
    assert_eq!(automatic, Increment::Automatic);
    let relative = increment("method = 'weighted'\nincrement = 3e-4");
    assert_eq!(relative, Increment::Relative(3e-4));
}

#[test]
fn a_subsystem_may_run_elsewhere() {
    let model = "model = \"oscillator\" ";
    let network = scene(&[
        (model, "address = \"http://10.0.0.7:4711\" "),
        ("[coupling]", "[security]\nplain_text = true\n\n[coupling]"),
    ]);
    let address = "http://10.0.0.7:4711".to_owned();
    assert_eq!(network.subsystems[0].served, Served::Address(address));
    assert_eq!(network.subsystems[0].model, None);
    let socket = scene(&[(
        model,
        "model = \"oscillator\"\naddress = \"unix:/run/w 1.sock\" ",
    )]);
    let address = "unix:/run/w 1.sock".to_owned();
    assert_eq!(socket.subsystems[0].served, Served::Address(address));
    assert_eq!(socket.subsystems[0].model.as_deref(), Some("oscillator"));
    let command = scene(&[(
        model,
        "command = [\"python3\", \"w.py\"]\ncalls = \"unary\" ",
    )]);
    let words = vec!["python3".to_owned(), "w.py".to_owned()];
    assert_eq!(command.subsystems[0].served, Served::Command(words));
    assert_eq!(command.subsystems[0].calls, Calls::Unary);
}

#[test]
fn parameters_and_solver_options_keep_their_types() {
    let settings = "p = { n = 3, s = \"soft\", f = true, l = [1, 2.5] }";
    let text = settings.replace("p = ", "parameters = ");
    let original = "parameters = { m = 1.0, c = 1000.0, d = 10.0, x0 = 0.0, v0 = 100.0 }";
    let solver = "solver = { kind = \"radau5\", rtol = 1e-8, steps = 70 }";
    let scene = scene(&[(original, &text), ("solver = { kind = \"exact\" }", solver)]);
    let parameters = &scene.subsystems[0].parameters;
    assert_eq!(parameters["n"], number(3.0));
    assert_eq!(parameters["s"].kind, Some(Kind::Text("soft".into())));
    assert_eq!(parameters["f"].kind, Some(Kind::Flag(true)));
    let values = vec![1.0, 2.5];
    assert_eq!(
        parameters["l"].kind,
        Some(Kind::Numbers(v1::NumberList { values }))
    );
    let solver = scene.subsystems[0].solver.as_ref().unwrap();
    assert_eq!(solver.kind, "radau5");
    assert_eq!(solver.options["rtol"], number(1e-8));
    assert_eq!(solver.options["steps"], number(70.0));
    assert_eq!(solver.options.len(), 2);
}

#[test]
fn joints_outputs_and_run_settings_are_optional_in_detail() {
    let scene = scene(&[
        ("a = \"mass1\"", "a = \"mass2.tip\"\nmultiplier = -0.25"),
        ("b = \"mass2\"", "b = \"mass1\""),
        (
            "every = 1 ",
            "every = 7\nvariables = [\"mass1.v\", \"mass2.energy\"]\n[run]\nrecoveries = 0\nexport_every = 7\n\
             checkpoint_every = 0\ncheckpoint_steps = 40\nmost_poor = 0.25\ndeadline = 2 ",
        ),
    ]);
    let a = Side {
        subsystem: 1,
        marker: Some("tip".into()),
    };
    assert_eq!(scene.joints[0].a, a);
    assert_eq!(scene.joints[0].b.subsystem, 0);
    assert_eq!(scene.joints[0].multiplier, Some(vec![-0.25]));
    assert_eq!(scene.output.every, 7);
    let variables = vec!["mass1.v".to_owned(), "mass2.energy".to_owned()];
    assert_eq!(scene.output.variables, Some(variables));
    let run = RunSettings {
        deadline: 2.0,
        recoveries: 0,
        export_every: 7,
        checkpoint_every: 0.0,
        checkpoint_steps: Some(40),
        most_poor: 0.25,
        ..RunSettings::default()
    };
    assert_eq!(scene.run, run);
}

#[test]
fn a_convergence_study_compares_with_the_finest_run_by_default() {
    let steps = "[converge]\nmacro_steps = [1e-2, 3e-3, 1e-3]\n[output]";
    let converge = scene(&[("[output]", steps)]).converge.unwrap();
    assert_eq!(converge.macro_steps, [1e-2, 3e-3, 1e-3]);
    assert_eq!(converge.reference, Reference::Automatic);
    let closed = steps.replace("1e-3]", "1e-3]\nreference = \"closed-form\"");
    let converge = scene(&[("[output]", &closed)]).converge.unwrap();
    assert_eq!(converge.reference, Reference::ClosedForm);
}

#[test]
fn a_stability_map_has_two_resolved_axes() {
    let map = "[stability]
x = { key = 'subsystem.*.parameters.c', from = 1e2, to = 1e6, points = 5, scale = 'log' }
y = { key = ['subsystem.mass1.parameters.d', 'subsystem.mass2.parameters.d'], label = 'damping', values = [0, 0.5, 30] }
[output]";
    let map = scene(&[("[output]", map)]).stability.unwrap();
    assert_eq!((&*map.x.label, &*map.y.label), ("c", "damping"));
    let expected = [1e2, 1e3, 1e4, 1e5, 1e6];
    assert_eq!(map.x.values.len(), expected.len());
    for (value, expected) in map.x.values.iter().zip(expected) {
        assert!((value / expected - 1.0).abs() < 1e-13, "{value} {expected}");
    }
    assert_eq!(map.y.values, [0.0, 0.5, 30.0]);
    assert_eq!(map.y.keys.len(), 2);
}

#[test]
fn a_linear_axis_ends_exactly_and_sets_its_keys() {
    let map = "[stability]
x = { key = 'coupling.macro_step', from = 0.1, to = 0.7, points = 4 }
y = { key = 'coupling.degree', values = [0, 1, 2] }
[output]";
    let base = scene(&[("[output]", map)]);
    let map = base.stability.clone().unwrap();
    assert_eq!(map.x.values[3], 0.7);
    assert!((map.x.values[1] - 0.3).abs() < 1e-15);
    let changed = |axis: &Axis, value| base.with(&axis.overrides(value)).unwrap().coupling;
    assert_eq!(changed(&map.x, map.x.values[1]).macro_step, map.x.values[1]);
    assert_eq!(changed(&map.y, 2.0).degree, Degree::Fixed(2));
}

#[test]
fn nested_parameters_have_dotted_names() {
    let flat = "parameters = { m = 1.0, c = 1000.0, d = 10.0, x0 = 0.0, v0 = 100.0 }";
    let nested = "parameters = { m = 1.0, \"der(x).1\" = 2, body.crank = { m = 3, position = [0.5, 0] }, joint.hinge-1.kind = \"revolute\" }";
    let scene = scene(&[(flat, nested)]);
    let parameters = &scene.subsystems[0].parameters;
    let names: Vec<_> = parameters.keys().map(String::as_str).collect();
    let expected = [
        "body.crank.m",
        "body.crank.position",
        "der(x).1",
        "joint.hinge-1.kind",
        "m",
    ];
    assert_eq!(names, expected);
    assert_eq!(parameters["body.crank.m"], number(3.0));
    let kind = Some(Kind::Text("revolute".into()));
    assert_eq!(parameters["joint.hinge-1.kind"].kind, kind);
    let place = scene.place("subsystem.mass1.parameters.body.crank.m");
    assert_eq!(
        place.unwrap().line,
        scene.place("subsystem.mass1.parameters.m").unwrap().line
    );
}

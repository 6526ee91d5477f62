use super::super::Description;
use super::*;

const TWO: &str = r#"<fmiModelDescription fmiVersion="2.0" modelName="m" guid="{g}" description="d">
<CoSimulation modelIdentifier="lib" canGetAndSetFMUstate="true" canInterpolateInputs="1"/>
<UnitDefinitions><Unit name="mm"><BaseUnit m="1" factor="0.001"/></Unit><Unit name="m"><BaseUnit m="1"/></Unit></UnitDefinitions>
<TypeDefinitions><SimpleType name="Length"><Real unit="mm"/></SimpleType></TypeDefinitions>
<DefaultExperiment tolerance="1e-4"/>
<ModelVariables>
<ScalarVariable name="x" valueReference="1" causality="output" initial="exact"><Real declaredType="Length" start="2"/></ScalarVariable>
<ScalarVariable name="f" valueReference="2" causality="input"><Real start="0" unit="m"/></ScalarVariable>
<ScalarVariable name="n" valueReference="3" causality="parameter" variability="fixed"><Integer start="4"/></ScalarVariable>
<ScalarVariable name="b" valueReference="4" causality="parameter"><Boolean start="true"/></ScalarVariable>
<ScalarVariable name="pi" valueReference="5" variability="constant" initial="exact"><Real start="3.14"/></ScalarVariable>
</ModelVariables></fmiModelDescription>"#;

const THREE: &str = r#"<fmiModelDescription fmiVersion="3.0" modelName="m" instantiationToken="{g}">
<CoSimulation modelIdentifier="lib" canSerializeFMUState="true" providesIntermediateUpdate="true"/>
<ModelVariables>
<Float64 name="f" valueReference="1" causality="input" start="0" intermediateUpdate="true"/>
<Float64 name="field" valueReference="2"><Dimension start="3"/></Float64>
<String name="s" valueReference="3" causality="parameter"><Start value="text"/></String>
<Binary name="raw" valueReference="4"/>
</ModelVariables></fmiModelDescription>"#;

#[test]
fn version_2() {
    let own = Description::parse(TWO.as_bytes()).unwrap();
    assert_eq!(own.version, Version::Two);
    assert_eq!((own.name.as_str(), own.token.as_str()), ("m", "{g}"));
    assert_eq!(own.library_path(), "binaries/linux64/lib.so");
    assert_eq!(own.tolerance, Some(1e-4));
    let expected = Abilities {
        keeps_states: true,
        takes_input_derivatives: true,
        ..Abilities::default()
    };
    assert_eq!(own.abilities, expected);
    let x = own.variable("x").unwrap();
    assert_eq!((x.unit.as_str(), x.scale), ("mm", Some([1e-3, 0.0])));
    assert!(x.is_settable && x.role == Role::Output && x.number() == Some(2.0));
    assert_eq!(own.variable("f").unwrap().scale, None);
    assert_eq!(own.variable("b").unwrap().number(), Some(1.0));
    assert_eq!(own.variable("n").unwrap().kind, Kind::Integer);
    assert!(!own.variable("pi").unwrap().is_settable);
}

#[test]
fn version_3() {
    let own = Description::parse(THREE.as_bytes()).unwrap();
    assert_eq!(own.library_path(), "binaries/x86_64-linux/lib.so");
    assert!(own.abilities.serializes_states && own.abilities.updates_inside);
    let names: Vec<&str> = own.variables.iter().map(|own| own.name.as_str()).collect();
    assert_eq!(names, ["f", "s"], "arrays and binaries are left out");
    assert!(own.variable("f").unwrap().is_updated_inside);
    assert_eq!(own.variable("s").unwrap().start.as_deref(), Some("text"));
}

#[test]
fn what_is_not_understood_is_told() {
    for (from, to, words) in [
        (
            "fmiVersion=\"2.0\"",
            "fmiVersion=\"1.0\"",
            "2.0 and 3.0 are served",
        ),
        ("fmiVersion=\"2.0\"", "", "no fmiVersion"),
        ("guid=\"{g}\"", "", "no guid"),
        (
            "CoSimulation",
            "ModelExchange",
            "only ModelExchange; export it for co-simulation",
        ),
        (
            "modelIdentifier=\"lib\"",
            "modelIdentifier=\"../lib\"",
            "no name of a library",
        ),
        (
            "valueReference=\"3\"",
            "valueReference=\"-3\"",
            "of n is no number",
        ),
        (
            "fmiModelDescription",
            "html",
            "must be <fmiModelDescription>",
        ),
    ] {
        let text = TWO.replace(from, to);
        let error = Description::parse(text.as_bytes()).unwrap_err();
        assert!(error.contains(words), "{to}: {error}");
    }
}

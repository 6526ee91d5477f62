//! FMUs that tests build themselves: an equation of motion in C, the functions of FMI 2.0 or 3.0 around it, and a description.

mod description;

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use crate::python::in_repository;

/// Version of FMI.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fmi {
    /// FMI 2.0.
    Two,
    /// FMI 3.0.
    Three,
}

/// Both of them.
pub const VERSIONS: [Fmi; 2] = [Fmi::Two, Fmi::Three];

/// What is in the FMU.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Equation {
    /// `m x'' = -c x - d x' + f`; states x and v, output a.
    Oscillator,
    /// A free link in the plane, with a marker at its end; variables `tip_*`.
    Link,
    /// A free body in space, with a marker in its centre of mass; variables `body.*`.
    Body,
}

/// An FMU to be built.
#[derive(Debug, Clone, PartialEq)]
pub struct TestFmu {
    /// What is in it.
    pub equation: Equation,
    /// For which version.
    pub fmi: Fmi,
    /// Whether its states can be kept.
    pub keeps_states: bool,
    /// Whether they can be serialised.
    pub serializes: bool,
    /// Highest derivative of inputs that it takes (FMI 2); 0: none.
    pub orders: usize,
    /// Whether it asks for inputs inside a step (FMI 3).
    pub updates: bool,
    /// Whether its steps may have any length.
    pub varies_steps: bool,
    /// Whether a process may have one instance only.
    pub once: bool,
    /// More definitions for the compiler.
    pub defined: Vec<&'static str>,
}

impl TestFmu {
    /// One that can do all but take inputs that vary inside a step.
    pub fn new(equation: Equation, fmi: Fmi) -> Self {
        Self {
            equation,
            fmi,
            keeps_states: true,
            serializes: true,
            orders: 0,
            updates: false,
            varies_steps: true,
            once: false,
            defined: Vec::new(),
        }
    }

    /// One that takes inputs that vary inside a step.
    pub fn with_varying_inputs(equation: Equation, fmi: Fmi) -> Self {
        Self {
            orders: if fmi == Fmi::Two { 7 } else { 0 },
            updates: fmi == Fmi::Three,
            ..Self::new(equation, fmi)
        }
    }

    /// Text of modelDescription.xml.
    pub fn description(&self) -> String {
        description::text(self)
    }

    /// Name of its library in the archive.
    pub fn library(&self) -> &'static str {
        match self.fmi {
            Fmi::Two => "binaries/linux64/model.so",
            Fmi::Three => "binaries/x86_64-linux/model.so",
        }
    }

    /// Builds it as `path`.
    pub fn write(&self, path: &Path) {
        let library = self.compile(path);
        let description = self.description();
        let entries = [
            ("modelDescription.xml", description.as_bytes()),
            (self.library(), &library[..]),
            ("resources/about.txt", b"made by a test"),
        ];
        write_archive(path, &entries);
    }

    /// The library.
    pub fn compile(&self, beside: &Path) -> Vec<u8> {
        let (source, header) = (self.source(), self.header());
        let object = beside.with_extension("so");
        let mut compiler = Command::new("cc");
        compiler
            .args(["-shared", "-fPIC", "-O2", "-o"])
            .arg(&object)
            .arg(in_repository(source))
            .arg(format!("-DEQUATION_FILE=\"{header}\""))
            .args(self.defined.iter().map(|word| format!("-D{word}")));
        if self.keeps_states {
            compiler.arg("-DSTATES");
        }
        if self.orders > 0 {
            compiler.arg(format!("-DORDERS={}", self.orders));
        }
        if self.updates {
            compiler.arg("-DUPDATES");
        }
        let done = compiler.arg("-lm").output().unwrap();
        let said = String::from_utf8_lossy(&done.stderr);
        assert!(done.status.success(), "{said}");
        let library = std::fs::read(&object).unwrap();
        std::fs::remove_file(&object).unwrap();
        library
    }

    fn source(&self) -> &'static str {
        match self.fmi {
            Fmi::Two => "tests/fmus/fmi2.c",
            Fmi::Three => "tests/fmus/fmi3.c",
        }
    }

    fn header(&self) -> &'static str {
        match self.equation {
            Equation::Oscillator => "oscillator.h",
            Equation::Link => "link.h",
            Equation::Body => "body.h",
        }
    }
}

/// Writes the FMUs of the guide, oscillators that take inputs which vary inside a step, and such that do not, of both versions.
pub fn write_examples(folder: &Path) {
    for (fmi, number) in VERSIONS.into_iter().zip(2..) {
        let plain = TestFmu::new(Equation::Oscillator, fmi);
        let varying = TestFmu::with_varying_inputs(Equation::Oscillator, fmi);
        for (name, fmu) in [("plain", plain), ("varying", varying)] {
            fmu.write(&folder.join(format!("{name}{number}.fmu")));
        }
    }
}

/// Writes a zip archive.
pub fn write_archive(path: &Path, entries: &[(&str, &[u8])]) -> PathBuf {
    let mut writer = ZipWriter::new(File::create(path).unwrap());
    for (name, content) in entries {
        let options = SimpleFileOptions::default();
        writer.start_file(*name, options).unwrap();
        writer.write_all(content).unwrap();
    }
    writer.finish().unwrap();
    path.to_owned()
}

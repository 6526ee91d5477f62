//! What a master sees of a mechanical system: names, units, numbers of outputs.

use linchpin_proto::v1;

use crate::mechanics::describe::output;
use crate::mechanics::markers::PLANAR;
use crate::nonsmooth::system::{Contact, Side};

/// A coordinate with its velocity.
#[derive(Debug, Clone, PartialEq)]
pub struct Coordinate {
    /// Name and unit of the coordinate, and what it is.
    pub position: [String; 3],
    /// Name and unit of its velocity.
    pub velocity: [String; 2],
}

impl Coordinate {
    /// An angle in rad.
    pub fn angle(name: &str, rate: &str, what: &str) -> Self {
        Self::new([name, "rad", what], [rate, "rad/s"])
    }

    /// A length in m.
    pub fn length(name: &str, speed: &str, what: &str) -> Self {
        Self::new([name, "m", what], [speed, "m/s"])
    }

    /// Any.
    pub fn new(position: [&str; 3], velocity: [&str; 2]) -> Self {
        Self {
            position: position.map(str::to_owned),
            velocity: velocity.map(str::to_owned),
        }
    }
}

/// A contact.
#[derive(Debug, Clone, PartialEq)]
pub struct FaceContact {
    /// Its name.
    pub name: String,
    /// Units of its gap and of its normal force.
    pub units: [&'static str; 2],
}

impl FaceContact {
    /// A contact at a point.
    pub fn at_point(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            units: ["m", "N"],
        }
    }

    /// A constraint of an angle.
    pub fn of_angle(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            units: ["rad", "N m"],
        }
    }
}

/// A marker in the plane.
#[derive(Debug, Clone, PartialEq)]
pub struct FaceMarker {
    /// Its name.
    pub name: String,
    /// Names of the inputs that take its load: force in x and y, moment; empty if it takes none.
    pub load: Vec<String>,
    /// Whether velocities and accelerations are offered; a marker without is for pictures.
    pub has_rates: bool,
}

impl FaceMarker {
    /// A marker for pictures.
    pub fn drawn(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            load: Vec::new(),
            has_rates: false,
        }
    }
}

/// All of a system.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Face {
    /// Coordinates that are shown; a system may have more behind them.
    pub coordinates: Vec<Coordinate>,
    /// The contacts, in their order.
    pub contacts: Vec<FaceContact>,
    /// Inputs in the order of the system.
    pub inputs: Vec<v1::Variable>,
    /// Outputs of its own.
    pub own: Vec<v1::Variable>,
    /// Markers.
    pub markers: Vec<FaceMarker>,
}

/// One output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Output {
    /// Coordinate.
    Position(usize),
    /// Its velocity.
    Velocity(usize),
    /// Component of a marker's motion: level (0 position, 1 velocity, 2 acceleration), component.
    Marker {
        /// Number of the marker.
        marker: usize,
        /// Position, velocity, acceleration.
        level: usize,
        /// x, y, angle.
        component: usize,
    },
    /// Own output.
    Own(usize),
    /// Gap of a contact.
    Gap(usize),
    /// Contact force of a row.
    Force(usize),
    /// Normal impulses of a contact in the last step of the subsystem.
    ContactImpulse(usize),
    /// Energy.
    Energy,
    /// Impacts in the last step of the subsystem.
    Impacts,
    /// Time of the first of them.
    ImpactTime,
    /// Their normal impulses.
    Impulse,
    /// Energy that all impacts took.
    ImpactLoss,
    /// Energy that friction took between impacts.
    FrictionLoss,
}

impl Face {
    /// All outputs with their descriptions, in their order.
    pub fn outputs(&self, contacts: &[Contact]) -> Vec<(Output, v1::Variable)> {
        let mut all = Vec::new();
        for (place, coordinate) in self.coordinates.iter().enumerate() {
            let [name, unit, what] = &coordinate.position;
            all.push((Output::Position(place), output(name, unit, what)));
            let [name, unit] = &coordinate.velocity;
            let what = format!("rate of {}", coordinate.position[0]);
            all.push((Output::Velocity(place), output(name, unit, &what)));
        }
        for (marker, own) in self.markers.iter().enumerate() {
            let count = if own.has_rates { 9 } else { 3 };
            for (number, variable) in PLANAR.outputs(&own.name).take(count).enumerate() {
                let place = Output::Marker {
                    marker,
                    level: number / 3,
                    component: number % 3,
                };
                all.push((place, variable));
            }
        }
        let own = self.own.iter().cloned().enumerate();
        all.extend(own.map(|(place, variable)| (Output::Own(place), variable)));
        self.add_contacts(contacts, &mut all);
        all.extend(self.common(contacts));
        all
    }

    fn add_contacts(&self, contacts: &[Contact], all: &mut Vec<(Output, v1::Variable)>) {
        let mut row = 0;
        for (place, (contact, own)) in contacts.iter().zip(&self.contacts).enumerate() {
            let FaceContact {
                name,
                units: [gap_unit, force_unit],
            } = own;
            let what = match contact.side {
                Side::Unilateral => "open where positive",
                Side::Bilateral => "0 up to drift",
            };
            let gap = output(
                &format!("gap_{name}"),
                gap_unit,
                &format!("gap at {name}, {what}"),
            );
            all.push((Output::Gap(place), gap));
            let normal = output(
                &format!("normal_{name}"),
                force_unit,
                &format!("normal force at {name} between impacts"),
            );
            all.push((Output::Force(row), normal));
            for tangent in 0..contact.tangents {
                let suffix = if tangent == 0 { "" } else { "_2" };
                let friction = output(
                    &format!("friction_{name}{suffix}"),
                    "N",
                    &format!("friction force at {name} between impacts, along growing slip"),
                );
                all.push((Output::Force(row + 1 + tangent), friction));
            }
            if contact.side == Side::Unilateral {
                let what = format!("sum of the normal impulses at {name} in the last macro step");
                let impulse = output(&format!("impulse_{name}"), "N s", &what);
                all.push((Output::ContactImpulse(place), impulse));
            }
            row += contact.rows();
        }
    }

    fn common(&self, contacts: &[Contact]) -> Vec<(Output, v1::Variable)> {
        let energy = output("energy", "J", "kinetic and potential energy");
        let mut common = vec![(Output::Energy, energy)];
        if contacts
            .iter()
            .any(|contact| contact.side == Side::Unilateral)
        {
            common.extend([
                (
                    Output::Impacts,
                    output("impacts", "1", "impacts in the last macro step"),
                ),
                (
                    Output::ImpactTime,
                    output(
                        "impact_time",
                        "s",
                        "time of the first impact in the last macro step; its end if there was none",
                    ),
                ),
                (
                    Output::Impulse,
                    output("impulse", "N s", "sum of the normal impulses in the last macro step"),
                ),
                (
                    Output::ImpactLoss,
                    output("impact_loss", "J", "energy that impacts took since the start"),
                ),
            ]);
        }
        if contacts.iter().any(|contact| contact.tangents > 0) {
            let what = "energy that friction took between impacts since the start";
            common.push((Output::FrictionLoss, output("friction_loss", "J", what)));
        }
        common
    }

    /// Markers as the contract has them.
    pub fn markers(&self) -> Vec<v1::Marker> {
        let described = |own: &FaceMarker| {
            let mut marker = PLANAR.marker(&own.name);
            if !own.has_rates {
                marker.velocity.clear();
                marker.acceleration.clear();
            }
            marker.load.clone_from(&own.load);
            marker
        };
        self.markers.iter().map(described).collect()
    }
}

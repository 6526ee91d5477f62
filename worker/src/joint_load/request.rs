//! The joint loads of a request.

use linchpin_proto::joint_load::{Acts, JointLaw, JointLoadError, Reads};
use linchpin_proto::v1::{self, Failure};

use super::{JointLoad, LoadedMarker, Orientation, Partner, Space};
use crate::instance::{Signals, find};
use crate::setup::names;

/// The joint loads that `request` asks of `model`.
///
/// # Errors
/// [`Failure`] of severity misuse that names the field, e.g. `joint_loads[1].axis_b`.
pub fn joint_loads(
    model: &v1::Model,
    request: &v1::InitializeRequest,
    signals: &Signals,
) -> Result<Vec<JointLoad>, Failure> {
    let is_offered = model.capabilities.is_some_and(|own| own.joint_loads);
    let asked = [
        ("joint_loads", request.joint_loads.is_empty()),
        ("joint_inputs", request.joint_inputs.is_empty()),
    ];
    if let (false, Some((field, _))) = (is_offered, asked.iter().find(|(_, is_empty)| !is_empty)) {
        return Err(Failure::misuse(
            *field,
            format!(
                "the model \"{}\" evaluates no joint loads (its capabilities do not say joint_loads); \
                 drive the load inputs of its markers with the forces and moments of the joint instead",
                model.name
            ),
        ));
    }
    let messages = request.joint_loads.iter().enumerate();
    let loads = messages.map(|(number, message)| {
        let reader = Reader {
            number,
            model,
            signals,
            message,
        };
        reader.joint_load()
    });
    loads.collect()
}

/// One message of the list.
struct Reader<'a> {
    number: usize,
    model: &'a v1::Model,
    signals: &'a Signals,
    message: &'a v1::JointLoad,
}

impl Reader<'_> {
    fn joint_load(&self) -> Result<JointLoad, Failure> {
        let (law, end) =
            JointLaw::from_message(self.message).map_err(|error| self.no_law(error))?;
        let (own, partner) = (law.load_reads(end, end), law.load_reads(end, end.other()));
        let marker = self.marker()?;
        self.check_marker(&marker, law.acts_by(end), own)?;
        if marker.space == Space::Planar {
            self.check_plane()?;
        }
        let [multiplier] = self.places("multiplier", [self.message.multiplier])?;
        Ok(JointLoad {
            law,
            end,
            multiplier,
            partner: match marker.space {
                Space::Planar => self.planar_partner(partner)?,
                Space::Spatial => self.spatial_partner(partner)?,
            },
            marker,
        })
    }

    fn marker(&self) -> Result<LoadedMarker, Failure> {
        let name = &self.message.marker;
        let Some(marker) = self.model.markers.iter().find(|own| own.name == *name) else {
            let known = names(self.model.markers.iter().map(|own| &own.name));
            return Err(self.misuse(
                "marker",
                format!("the model has no marker \"{name}\"; it has: {known}"),
            ));
        };
        let space = match marker.kind() {
            v1::MarkerKind::Planar => Space::Planar,
            v1::MarkerKind::Spatial => Space::Spatial,
            v1::MarkerKind::Scalar | v1::MarkerKind::Unspecified => {
                return Err(self.misuse(
                    "marker",
                    format!("the marker \"{name}\" is neither planar nor spatial; only those take joint loads"),
                ));
            }
        };
        let field = self.field("marker");
        Ok(LoadedMarker {
            name: name.clone(),
            space,
            position: find(&self.model.outputs, &marker.position, &field)?,
            load: find(&self.model.inputs, &marker.load, &field)?,
        })
    }

    /// The marker must offer the own pose that the load depends on, and take the load.
    fn check_marker(&self, marker: &LoadedMarker, acts: Acts, own: Reads) -> Result<(), Failure> {
        let (points, orientations) = marker.space.components();
        let (forces, moments) = marker.space.load_components();
        let (position, load) = (marker.position.len(), marker.load.len());
        let lists = [
            (own.position, "position", position, points),
            (own.rotation, "position", position, orientations),
            (acts.force, "load", load, forces),
            (acts.moment, "load", load, moments),
        ];
        for (is_needed, list, length, needed) in lists {
            if is_needed && length < needed {
                let name = &marker.name;
                let message = format!(
                    "the list {list} of the marker \"{name}\" has the length {length}; this load needs {needed}"
                );
                return Err(self.misuse("marker", message));
            }
        }
        Ok(())
    }

    fn check_plane(&self) -> Result<(), Failure> {
        let v1::JointLoad {
            point_a,
            point_b,
            axis_a,
            axis_b,
            ..
        } = self.message;
        let vectors = [
            ("point_a", point_a),
            ("point_b", point_b),
            ("axis_a", axis_a),
            ("axis_b", axis_b),
        ];
        for (field, vector) in vectors {
            if let [_, _, out_of_plane] = vector[..]
                && out_of_plane != 0.0
            {
                return Err(self.misuse(
                    field,
                    format!(
                        "its third component is {out_of_plane}; on a planar marker it must be 0"
                    ),
                ));
            }
        }
        Ok(())
    }

    fn planar_partner(&self, reads: Reads) -> Result<Partner, Failure> {
        let [position, rotation, attitude] = self.partner_lists();
        self.list::<0>(attitude, false)?;
        Ok(Partner::Planar {
            position: self.list(position, reads.position)?,
            angle: self.list(rotation, reads.rotation)?.map(|[angle]| angle),
        })
    }

    fn spatial_partner(&self, reads: Reads) -> Result<Partner, Failure> {
        let [position, rotation, attitude] = self.partner_lists();
        let rotation = self.list(rotation, reads.rotation)?;
        let attitude = self.list(attitude, reads.rotation)?;
        let orientation = rotation.zip(attitude);
        Ok(Partner::Spatial {
            position: self.list(position, reads.position)?,
            orientation: orientation.map(|(rotation, attitude)| Orientation { attitude, rotation }),
        })
    }

    fn partner_lists(&self) -> [(&'static str, &[u32]); 3] {
        [
            ("partner_position", &self.message.partner_position),
            ("partner_rotation", &self.message.partner_rotation),
            ("partner_attitude", &self.message.partner_attitude),
        ]
    }

    /// `N` places if the load depends on them. If not, they may be missing.
    fn list<const N: usize>(
        &self,
        (field, places): (&str, &[u32]),
        is_read: bool,
    ) -> Result<Option<[usize; N]>, Failure> {
        if places.is_empty() && !is_read {
            return Ok(None);
        }
        if let Ok(places) = <[u32; N]>::try_from(places) {
            let found = self.places(field, places)?;
            return Ok(is_read.then_some(found));
        }
        let allowed = match (N, is_read) {
            (0, _) => "it must be empty on a planar marker".to_owned(),
            (_, true) => format!("this load needs {N}"),
            (_, false) => format!("{N} or none are allowed"),
        };
        let length = places.len();
        Err(self.misuse(
            field,
            format!("the list has the length {length}; {allowed}"),
        ))
    }

    /// Places among the input values of the subsystem.
    fn places<const N: usize>(&self, field: &str, places: [u32; N]) -> Result<[usize; N], Failure> {
        let mut found = [0; N];
        for (found, place) in found.iter_mut().zip(places) {
            *found = self.signals.input(place as usize).ok_or_else(|| {
                self.misuse(
                    field,
                    format!(
                        "there is no signal {place}: inputs and joint_inputs list {} (counted from 0)",
                        self.signals.len()
                    ),
                )
            })?;
        }
        Ok(found)
    }

    fn no_law(&self, error: JointLoadError) -> Failure {
        Failure::misuse(
            self.field(error.field()),
            format!("joint_loads[{}]: {error}", self.number),
        )
    }

    fn misuse(&self, field: &str, message: String) -> Failure {
        let field = self.field(field);
        let message = format!("{field}: {message}");
        Failure::misuse(field, message)
    }

    fn field(&self, name: &str) -> String {
        format!("joint_loads[{}].{name}", self.number)
    }
}

impl Space {
    /// Entries of a position up to the point, and with the orientation.
    fn components(self) -> (usize, usize) {
        match self {
            Self::Planar => (2, 3),
            Self::Spatial => (3, 7),
        }
    }

    /// Entries of a load up to the force, and with the moment.
    fn load_components(self) -> (usize, usize) {
        match self {
            Self::Planar => (2, 3),
            Self::Spatial => (3, 6),
        }
    }
}

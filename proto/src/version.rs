//! Protocol versions.

use crate::v1::ProtocolVersion;

/// The version that this build speaks.
pub const PROTOCOL: ProtocolVersion = ProtocolVersion { major: 1, minor: 4 };

/// The first minor number whose exchange stream goes back, evaluates beside a prediction and takes samples. An older one would
/// pass over these parts of a request; a master then uses unary calls, which are the same for all minor numbers.
///
/// What a worker may leave out stands in its capabilities and not here: directional derivatives, joint loads, instants, integrals,
/// exported states, impulses, impacts.
const WHOLE_EXCHANGE: u32 = 1;

/// The first minor number whose masters know that an instance ends some time after what held it.
const LEASES: u32 = 3;

/// The two sides speak protocols of different major numbers.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(
    "incompatible protocol: this side speaks linchpin {}, the other side speaks {theirs}; \
     use builds with the same major number",
    show(&PROTOCOL)
)]
pub struct Incompatible {
    /// What the other side said, as text.
    pub theirs: String,
}

/// Accepts `theirs` if its major number is ours. An absent version is not compatible.
pub fn negotiate(theirs: Option<&ProtocolVersion>) -> Result<(), Incompatible> {
    match theirs {
        Some(version) if version.major == PROTOCOL.major => Ok(()),
        Some(version) => Err(Incompatible {
            theirs: show(version),
        }),
        None => Err(Incompatible {
            theirs: "no version at all".into(),
        }),
    }
}

/// Whether the exchange stream of a compatible worker knows every part of a request.
pub fn knows_whole_exchange(theirs: Option<&ProtocolVersion>) -> bool {
    theirs.is_some_and(|version| version.minor >= WHOLE_EXCHANGE)
}

/// Whether a compatible master knows of leases; the instances of an older one stay until it ends them.
pub fn knows_leases(theirs: Option<&ProtocolVersion>) -> bool {
    theirs.is_some_and(|version| version.minor >= LEASES)
}

fn show(version: &ProtocolVersion) -> String {
    format!("{}.{}", version.major, version.minor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn minor_numbers_do_not_matter() {
        assert_eq!(
            negotiate(Some(&ProtocolVersion { major: 1, minor: 7 })),
            Ok(())
        );
    }

    #[test]
    fn an_exchange_of_the_first_version_lacks_parts() {
        let minor = |minor| Some(ProtocolVersion { major: 1, minor });
        assert!(!knows_whole_exchange(minor(0).as_ref()));
        assert!(!knows_whole_exchange(None));
        assert!(knows_whole_exchange(minor(1).as_ref()) && knows_whole_exchange(Some(&PROTOCOL)));
    }

    #[test]
    fn an_error_names_both_versions() {
        let error = negotiate(Some(&ProtocolVersion { major: 2, minor: 3 })).unwrap_err();
        let text = error.to_string();
        assert!(text.contains("1.4") && text.contains("2.3"), "{text}");
        assert!(
            negotiate(None)
                .unwrap_err()
                .to_string()
                .contains("no version")
        );
    }
}

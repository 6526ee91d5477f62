//! Protocol versions.

use crate::v1::ProtocolVersion;

/// The version that this build speaks.
pub const PROTOCOL: ProtocolVersion = ProtocolVersion { major: 1, minor: 0 };

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
    fn an_error_names_both_versions() {
        let error = negotiate(Some(&ProtocolVersion { major: 2, minor: 3 })).unwrap_err();
        let text = error.to_string();
        assert!(text.contains("1.0") && text.contains("2.3"), "{text}");
        assert!(
            negotiate(None)
                .unwrap_err()
                .to_string()
                .contains("no version")
        );
    }
}

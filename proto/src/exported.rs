//! States that have left their process: whole, and of the right model.

use crate::v1::{ExportedState, Failure};

const FIELD: &str = "state";

impl ExportedState {
    /// A state of `model` as `writer` (program and version) has written it.
    pub fn sealed(model: &str, writer: &str, state: Vec<u8>) -> Self {
        Self {
            model: model.to_owned(),
            writer: writer.to_owned(),
            checksum: crc32fast::hash(&state),
            state,
        }
    }

    /// That it is whole, and a state of `model` that `writer` has written.
    ///
    /// # Errors
    /// Misuse of `state`, which says what differs.
    pub fn check(&self, model: &str, writer: &str) -> Result<(), Failure> {
        for (what, expected, found) in [
            ("of model", model, &self.model),
            ("written by", writer, &self.writer),
        ] {
            if expected != found {
                return Err(Failure::misuse(
                    FIELD,
                    format!(
                        "this state is {what} \"{found}\", it must be {what} \"{expected}\": export it from such an instance"
                    ),
                ));
            }
        }
        let found = crc32fast::hash(&self.state);
        if found != self.checksum {
            return Err(Failure::misuse(
                FIELD,
                format!(
                    "this state of {} bytes is damaged: its checksum is {found:#010x} instead of {:#010x}; use another copy of it",
                    self.state.len(),
                    self.checksum
                ),
            ));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The value that the catalogue of CRC algorithms gives for this text, with CRC-32/ISO-HDLC.
    #[test]
    fn the_checksum_is_that_of_zlib() {
        let state = ExportedState::sealed("mass", "linchpin 1", b"123456789".to_vec());
        assert_eq!(state.checksum, 0xcbf4_3926);
        assert_eq!(state.check("mass", "linchpin 1"), Ok(()));
    }

    #[test]
    fn another_model_another_writer_and_a_flipped_bit_are_told() {
        let mut state = ExportedState::sealed("mass", "linchpin 1", vec![7; 24]);
        let told = |state: &ExportedState, model, writer| {
            let failure = state.check(model, writer).unwrap_err();
            assert_eq!(failure.field.as_deref(), Some("state"));
            failure.message
        };
        assert!(
            told(&state, "rod", "linchpin 1").contains("\"mass\", it must be of model \"rod\"")
        );
        assert!(told(&state, "mass", "linchpin 2").contains("written by \"linchpin 2\""));
        state.state[5] ^= 1;
        assert!(told(&state, "mass", "linchpin 1").contains("this state of 24 bytes is damaged"));
    }
}

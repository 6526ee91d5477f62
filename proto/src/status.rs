//! Failures as gRPC statuses, and back.
//!
//! The code carries the severity; what is known beyond the message travels as a `google.rpc.ErrorInfo` of the domain
//! [`DOMAIN`], which any gRPC library can write.

use std::collections::HashMap;

use tonic::{Code, Status};
use tonic_types::{ErrorDetails, StatusExt};

use crate::contract::{CallError, INSTANCE};
use crate::foreign::{LONGEST_NAME, LONGEST_TEXT, clean_lines, shortened};
use crate::v1::{Failure, Severity};

/// Domain of the error details.
pub const DOMAIN: &str = "linchpin";

/// The status that a worker answers with.
pub fn to_status(error: &CallError) -> Status {
    match error {
        CallError::Failed(failure) => from_failure(failure),
        CallError::NoInstance { message } => {
            let field = HashMap::from([("field".to_owned(), INSTANCE.to_owned())]);
            let misuse = Severity::Misuse.as_str_name();
            let details = ErrorDetails::with_error_info(misuse, DOMAIN, field);
            Status::with_error_details(Code::NotFound, message, details)
        }
        CallError::Denied { message } => Status::permission_denied(message),
        CallError::Unimplemented { call } => {
            Status::unimplemented(format!("{call} is not offered"))
        }
        CallError::Unreachable { .. }
        | CallError::Untrusted { .. }
        | CallError::Lost { .. }
        | CallError::Interrupted => Status::unavailable(error.to_string()),
        CallError::Deadline { .. } => Status::deadline_exceeded(error.to_string()),
        CallError::Misplaced { .. } => Status::data_loss(error.to_string()),
    }
}

fn from_failure(failure: &Failure) -> Status {
    let code = match failure.severity() {
        Severity::Misuse => Code::InvalidArgument,
        Severity::Recoverable => Code::Aborted,
        Severity::Fatal => Code::Internal,
    };
    let mut metadata = HashMap::new();
    let texts = [("field", &failure.field), ("variable", &failure.variable)];
    for (key, text) in texts {
        metadata.extend(
            text.iter()
                .map(|text| (key.to_owned(), shortened(text, LONGEST_NAME))),
        );
    }
    for (key, number) in [("t", failure.t), ("step", failure.step)] {
        metadata.extend(number.map(|number| (key.to_owned(), number.to_string())));
    }
    let details = ErrorDetails::with_error_info(failure.severity().as_str_name(), DOMAIN, metadata);
    Status::with_error_details(code, shortened(&failure.message, LONGEST_TEXT), details)
}

/// What a status of a worker means to its master. `call` is the call that was answered so.
pub fn to_error(call: &'static str, status: &Status) -> CallError {
    // Only statuses that the transport makes here have a source; those of a worker come as code and text.
    if let Some(source) = std::error::Error::source(status) {
        return CallError::Lost {
            reason: source.to_string(),
        };
    }
    let severity = match status.code() {
        Code::Unimplemented => return CallError::Unimplemented { call },
        Code::PermissionDenied | Code::Unauthenticated => {
            return CallError::Denied {
                message: reason(status),
            };
        }
        Code::Unavailable | Code::Cancelled => {
            return CallError::Lost {
                reason: reason(status),
            };
        }
        Code::InvalidArgument
        | Code::FailedPrecondition
        | Code::NotFound
        | Code::AlreadyExists
        | Code::OutOfRange => Severity::Misuse,
        Code::Aborted => Severity::Recoverable,
        _ => Severity::Fatal,
    };
    let info = status
        .get_details_error_info()
        .filter(|info| info.domain == DOMAIN);
    let metadata = info.map(|info| info.metadata).unwrap_or_default();
    let is_instance = metadata.get("field").is_some_and(|field| field == INSTANCE);
    if status.code() == Code::NotFound && is_instance {
        return CallError::NoInstance {
            message: reason(status),
        };
    }
    let number = |key| metadata.get(key).and_then(|text| text.parse().ok());
    let failure = Failure {
        severity: severity.into(),
        message: reason(status),
        field: metadata.get("field").cloned(),
        variable: metadata.get("variable").cloned(),
        t: number("t"),
        step: number("step"),
    };
    CallError::Failed(failure.cleaned())
}

fn reason(status: &Status) -> String {
    if status.message().is_empty() {
        return format!("status {:?} without a message", status.code());
    }
    // Of a worker's own making it is no longer than this, but for the note of what is missing.
    clean_lines(status.message(), 2 * LONGEST_TEXT)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_survives_the_wire() {
        let failure = Failure {
            field: Some("parameters.m".into()),
            variable: Some("x".into()),
            ..Failure::recoverable(0.125, 1e-3, "too stiff")
        };
        let error = CallError::Failed(failure);
        assert_eq!(to_error("Step", &to_status(&error)), error);
    }

    #[test]
    fn a_lost_instance_survives_the_wire() {
        let lost = CallError::no_instance(0x2a);
        let status = to_status(&lost);
        assert_eq!(status.code(), Code::NotFound);
        assert!(status.message().contains("no instance 0x2a"));
        assert_eq!(to_error("Exchange", &status), lost);
        // A snapshot that is gone is another thing.
        let gone = to_error("Restore", &Status::not_found("no snapshot 3"));
        assert!(!gone.is_loss() && lost.is_loss());
    }

    #[test]
    fn a_long_message_says_how_much_is_missing() {
        let failure = Failure::misuse("m".repeat(9000), "\u{e9}".repeat(5000));
        let status = to_status(&CallError::Failed(failure));
        let message = status.message();
        assert!(
            message.len() < 2100 && message.ends_with("(7952 more bytes)"),
            "{message}"
        );
        let CallError::Failed(told) = to_error("Step", &status) else {
            panic!("{status:?}")
        };
        assert!(
            told.field
                .is_some_and(|field| field.ends_with("(8744 more bytes)"))
        );
    }

    #[test]
    fn a_plain_status_of_another_library_is_understood() {
        let error = to_error("Step", &Status::not_found("no such instance"));
        let CallError::Failed(failure) = error else {
            panic!("{error:?}")
        };
        assert_eq!(failure.severity(), Severity::Misuse);
        assert_eq!(failure.field, None);
        assert_eq!(
            to_error("Exchange", &Status::unimplemented("")),
            CallError::Unimplemented { call: "Exchange" }
        );
    }
}

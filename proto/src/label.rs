//! Which request a reply belongs to.

use crate::contract::CallError;
use crate::v1::*;

/// Instance and sequence number of a message, as far as it has them.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Label {
    /// Number of the instance.
    pub instance: Option<u64>,
    /// Sequence number of the call.
    pub sequence: Option<u64>,
}

/// A message that may say which instance and which call it is about.
pub trait Labelled {
    /// What it says.
    fn label(&self) -> Label;
}

/// A reply that can say which request it answers.
pub trait Reply: Labelled + Sized {
    /// The reply with the numbers of its request.
    #[must_use]
    fn to(self, request: &impl Labelled) -> Self;
}

/// That a reply has the numbers of its request, as far as it has any.
///
/// # Errors
/// [`CallError::Misplaced`] with the first number that differs.
pub fn check_label(
    call: &'static str,
    request: &impl Labelled,
    reply: &impl Labelled,
) -> Result<(), CallError> {
    let (asked, answered) = (request.label(), reply.label());
    for (what, expected, found) in [
        ("instance", asked.instance, answered.instance),
        ("sequence number", asked.sequence, answered.sequence),
    ] {
        if let (Some(expected), Some(found)) = (expected, found)
            && expected != found
        {
            return Err(CallError::Misplaced {
                call,
                what,
                found,
                expected,
            });
        }
    }
    Ok(())
}

macro_rules! requests {
    ($($message:ident: $sequence:expr),+ $(,)?) => {
        $(impl Labelled for $message {
            fn label(&self) -> Label {
                let sequence: fn(&Self) -> Option<u64> = $sequence;
                Label { instance: Some(self.instance), sequence: sequence(self) }
            }
        })+
    };
}

requests!(
    InitializeRequest: |own| Some(own.sequence),
    SnapshotRequest: |own| Some(own.sequence),
    RestoreRequest: |own| Some(own.sequence),
    StepRequest: |own| Some(own.sequence),
    PerturbedStepRequest: |own| Some(own.sequence),
    ExchangeRequest: |own| Some(own.sequence),
    ImportStateRequest: |own| Some(own.sequence),
    ExportStateRequest: |_| None,
    EvaluateRequest: |_| None,
    TerminateRequest: |_| None,
);

macro_rules! replies {
    ($($message:ident),+ $(,)?) => {
        $(impl Labelled for $message {
            fn label(&self) -> Label {
                Label { instance: self.instance, sequence: self.sequence }
            }
        }

        impl Reply for $message {
            fn to(mut self, request: &impl Labelled) -> Self {
                let Label { instance, sequence } = request.label();
                (self.instance, self.sequence) = (instance, sequence);
                self
            }
        })+
    };
}

replies!(
    InitializeReply,
    SnapshotReply,
    RestoreReply,
    StepReply,
    PerturbedStepReply,
    ImportStateReply,
);

macro_rules! replies_without_sequence {
    ($($message:ident),+ $(,)?) => {
        $(impl Labelled for $message {
            fn label(&self) -> Label {
                Label { instance: self.instance, sequence: None }
            }
        }

        impl Reply for $message {
            fn to(mut self, request: &impl Labelled) -> Self {
                self.instance = request.label().instance;
                self
            }
        })+
    };
}

replies_without_sequence!(EvaluateReply, TerminateReply, ExportStateReply);

impl Labelled for ExchangeReply {
    fn label(&self) -> Label {
        Label {
            instance: self.instance,
            // As old as the contract.
            sequence: Some(self.sequence),
        }
    }
}

macro_rules! without_instance {
    ($($message:ident),+ $(,)?) => {
        $(impl Labelled for $message {
            fn label(&self) -> Label {
                Label::default()
            }
        })+
    };
}

without_instance!(
    DescribeRequest,
    DescribeReply,
    ListInstancesRequest,
    ListInstancesReply,
);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reply_to_another_request_is_told_with_its_numbers() {
        let request = StepRequest {
            instance: 7,
            sequence: 40,
            ..StepRequest::default()
        };
        let own = StepReply::default().to(&request);
        assert_eq!(check_label("Step", &request, &own), Ok(()));
        // An older worker says nothing.
        assert_eq!(check_label("Step", &request, &StepReply::default()), Ok(()));
        for (instance, sequence, what, found) in
            [(7, 39, "sequence number", 39), (8, 40, "instance", 8)]
        {
            let other = StepRequest {
                instance,
                sequence,
                ..StepRequest::default()
            };
            let error = check_label("Step", &request, &StepReply::default().to(&other));
            let Err(CallError::Misplaced {
                what: told,
                found: number,
                ..
            }) = error
            else {
                panic!("{error:?}")
            };
            assert_eq!((told, number), (what, found));
        }
    }
}

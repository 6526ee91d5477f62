//! `linchpin instances`: what lives on a worker, and the end of what nobody needs.

use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::v1::{InstanceState, ListInstancesRequest, TerminateRequest};

use super::CommandError;
use super::common::{WorkerArguments, print};

/// List the instances on a running worker, or end some of them
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin instances http://127.0.0.1:50051
  linchpin instances unix:/run/linchpin/mass1.sock --end 0x5c0ffee

An instance is held by the exchange stream or the connections of its master. When they have ended it waits for the lease of the
worker (linchpin worker --lease) and then ends by itself. Those of masters that know of no leases stay until somebody ends them.")]
pub struct Arguments {
    #[command(flatten)]
    worker: WorkerArguments,

    /// End this instance, whoever uses it; may be given more than once
    #[arg(long, value_name = "NUMBER", value_parser = number)]
    end: Vec<u64>,
}

fn number(text: &str) -> Result<u64, String> {
    let parsed = match text.strip_prefix("0x") {
        Some(digits) => u64::from_str_radix(digits, 16),
        None => text.parse(),
    };
    parsed.map_err(|_| {
        "it must be the number of an instance as it is listed, such as 0x5c0ffee".into()
    })
}

/// Ends the instances that are named, then lists those that there are.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let worker = arguments.worker.connect()?;
    let failed = |source: CallError| arguments.worker.failed(source);
    let list = || {
        worker
            .list_instances(&ListInstancesRequest {})
            .map_err(failed)
    };
    let before = list()?.instances;
    for &instance in &arguments.end {
        // Also one that is not listed: whose it is, if it is somebody else's, says the worker.
        worker
            .terminate(&TerminateRequest { instance })
            .map_err(failed)?;
        if !before.iter().any(|own| own.instance == instance) {
            return Err(CommandError::NoInstance {
                address: arguments.worker.address().to_owned(),
                number: instance,
            });
        }
    }
    print(text(&list()?.instances))
}

fn text(instances: &[InstanceState]) -> String {
    let mut text = format!("instances: {}\n", instances.len());
    for own in instances {
        let state = match (own.held, own.expires) {
            (true, _) => "held by its master".to_owned(),
            (false, Some(left)) => format!("left by its master, ends in {left:.1} s"),
            (false, None) => "held by nobody, stays until it is ended".to_owned(),
        };
        text += &format!(
            "  {:#018x} {:<20} {:.1} s old, last called {:.1} s ago, {state}\n",
            own.instance, own.model, own.age, own.idle
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn an_instance_is_named_as_it_is_listed() {
        assert_eq!(number(&format!("{:#018x}", 0x5c0ffee_u64)), Ok(0x5c0ffee));
        assert_eq!(number("17"), Ok(17));
        for wrong in ["", "0x", "-1", "x5", "0x10000000000000000"] {
            assert!(number(wrong).is_err(), "{wrong}");
        }
    }
}

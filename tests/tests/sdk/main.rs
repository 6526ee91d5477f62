//! The worker SDK against the contract: the same tests in this process and over gRPC.

#![allow(clippy::unwrap_used)]

mod anything;
mod descriptions;
mod directions;
mod driver;
mod evaluations;
mod exchange;
mod exported_states;
mod going_back;
mod impacts;
mod initialize;
mod instances;
mod instants;
mod integrals;
mod joint_load_mistakes;
mod joint_loads;
mod leases;
mod peer;
mod repeated_steps;
mod samples;
mod scripted;
mod sequence;
mod serving;
mod signals;
mod snapshots;
mod stand;
mod subjects;
mod tank;

/// Makes two tests of every function: with the contract in this process, and behind a server on a Unix socket.
macro_rules! both_ways {
    ($($name:ident),+ $(,)?) => {
        mod in_process {
            $(#[test] fn $name() { super::$name(crate::peer::Peer::in_process); })+
        }
        mod over_grpc {
            $(#[test] fn $name() { super::$name(crate::peer::Peer::over_grpc); })+
        }
    };
}
pub(crate) use both_ways;

/// Makes a test of every function against a worker of the Python SDK, whose models are those of worker/python/tests/models.py.
macro_rules! in_python {
    ($($name:ident),+ $(,)?) => {
        mod in_python {
            $(#[test] fn $name() { super::$name(crate::peer::Peer::in_python); })+
        }
    };
}
pub(crate) use in_python;

/// Both ways, and against a worker of the Python SDK.
macro_rules! all_ways {
    ($($name:ident),+ $(,)?) => {
        crate::both_ways!($($name),+);
        crate::in_python!($($name),+);
    };
}
pub(crate) use all_ways;

//! A worker in this process and on this thread.

use std::sync::Arc;

use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::v1::{ExchangeReply, ExchangeRequest};

use super::worker::Connection;

/// Calls the contract directly; messages are neither copied nor encoded.
pub struct Direct {
    contract: Arc<dyn Contract>,
    reply: ExchangeReply,
    posted: Result<(), CallError>,
}

impl Direct {
    /// A connection to a contract of this process.
    pub fn new(contract: Arc<dyn Contract>) -> Self {
        Self {
            contract,
            reply: ExchangeReply::default(),
            posted: Ok(()),
        }
    }
}

impl Connection for Direct {
    fn contract(&self) -> &dyn Contract {
        &*self.contract
    }

    fn post(&mut self, request: &ExchangeRequest) -> Result<(), CallError> {
        self.posted = self.contract.exchange(request, &mut self.reply);
        Ok(())
    }

    fn collect(&mut self, reply: &mut ExchangeReply) -> Result<(), CallError> {
        std::mem::swap(reply, &mut self.reply);
        std::mem::replace(&mut self.posted, Ok(()))
    }

    fn route(&self) -> &'static str {
        "in process"
    }
}

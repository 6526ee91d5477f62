//! The description of the model that is examined.

use linchpin_master::connection::Connection;
use linchpin_proto::v1;
use linchpin_proto::version::{PROTOCOL, negotiate};

use crate::conformance::{ConformanceError, Settings};

/// Asks the worker for its models, then for the one of the settings with its parameters.
///
/// # Errors
/// [`ConformanceError`] if the worker does not answer, speaks another protocol, or has no such model.
pub fn describe(
    connection: &dyn Connection,
    settings: &Settings,
) -> Result<(v1::DescribeReply, v1::Model), ConformanceError> {
    let ask = |model: Option<String>| {
        let request = v1::DescribeRequest {
            protocol: Some(PROTOCOL),
            parameters: match &model {
                Some(_) => settings.parameters.clone(),
                None => Default::default(),
            },
            model,
        };
        let reply = connection.contract().describe(&request);
        reply.map_err(|error| ConformanceError::Describe(Box::new(error)))
    };
    let all = ask(None)?;
    negotiate(all.protocol.as_ref())?;
    let names: Vec<&str> = all.models.iter().map(|model| &*model.name).collect();
    let name = match (&settings.model, &names[..]) {
        (_, []) => return Err(ConformanceError::NoModel),
        (Some(name), _) => name.clone(),
        (None, [only]) => (*only).to_owned(),
        (None, _) => {
            return Err(ConformanceError::WhichModel {
                known: names.join(", "),
            });
        }
    };
    let known = names.join(", ");
    if !names.contains(&name.as_str()) {
        return Err(ConformanceError::UnknownModel { name, known });
    }
    let mut reply = ask(Some(name.clone()))?;
    match reply.models.iter().position(|model| model.name == name) {
        Some(place) => {
            let model = reply.models.swap_remove(place);
            Ok((reply, model))
        }
        None => Err(ConformanceError::UnknownModel { name, known }),
    }
}

//! Values of parameters as arguments.

use linchpin_proto::v1::{self, Value, value::Kind};
use serde_json::Value as Json;

/// Reads `NAME=VALUE`: a number, true, false, a list of numbers, or else a text.
pub fn assignment(text: &str) -> Result<(String, Value), String> {
    let (name, value) = text
        .split_once('=')
        .filter(|(name, _)| !name.is_empty())
        .ok_or("it must be NAME=VALUE, such as m=2.5")?;
    let kind = kind(value).ok_or("a list may have nothing but numbers")?;
    Ok((name.to_owned(), Value { kind: Some(kind) }))
}

/// What does not read as JSON is a text.
fn kind(text: &str) -> Option<Kind> {
    let Ok(json) = serde_json::from_str::<Json>(text) else {
        return Some(Kind::Text(text.to_owned()));
    };
    Some(match json {
        Json::Number(number) => Kind::Number(number.as_f64()?),
        Json::Bool(flag) => Kind::Flag(flag),
        Json::String(text) => Kind::Text(text),
        Json::Array(values) => {
            let values = values.iter().map(Json::as_f64).collect::<Option<_>>()?;
            Kind::Numbers(v1::NumberList { values })
        }
        Json::Null | Json::Object(_) => Kind::Text(text.to_owned()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_have_the_type_that_they_look_like() {
        let kind = |text: &str| assignment(text).map(|(_, value)| value.kind);
        assert_eq!(kind("m=2.5"), Ok(Some(Kind::Number(2.5))));
        assert_eq!(kind("m=1e-3"), Ok(Some(Kind::Number(1e-3))));
        assert_eq!(kind("on=true"), Ok(Some(Kind::Flag(true))));
        assert_eq!(kind("of=minimal"), Ok(Some(Kind::Text("minimal".into()))));
        let values = vec![1.0, -2.0];
        let list = Kind::Numbers(v1::NumberList { values });
        assert_eq!(kind("p=[1, -2]"), Ok(Some(list)));
        for wrong in ["m", "=1", "p=[1, \"a\"]"] {
            assert!(kind(wrong).is_err(), "{wrong}");
        }
    }
}

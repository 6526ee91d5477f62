//! An XML text as a tree of elements; text between them is left out, since FMI has none that counts.

use quick_xml::Reader;
use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};

/// Deepest nesting; FMI needs about ten.
const DEEPEST: usize = 100;

/// One element.
#[derive(Debug, Default)]
pub struct Element {
    /// Its name, without a namespace.
    pub name: String,
    attributes: Vec<(String, String)>,
    /// The elements in it.
    pub children: Vec<Element>,
}

impl Element {
    /// The root of a text. Bytes that are no UTF-8 are taken as ISO 8859-1 if the text says that it is.
    pub fn read(bytes: &[u8]) -> Result<Self, String> {
        match std::str::from_utf8(bytes) {
            Ok(text) => parse(text),
            Err(_) if says_latin_1(bytes) => {
                parse(&bytes.iter().copied().map(char::from).collect::<String>())
            }
            Err(error) => Err(format!(
                "it is not in UTF-8 from byte {} on",
                error.valid_up_to()
            )),
        }
    }

    /// The value of an attribute.
    pub fn attribute(&self, name: &str) -> Option<&str> {
        let mut attributes = self.attributes.iter();
        attributes
            .find(|(own, _)| own == name)
            .map(|(_, value)| value.as_str())
    }

    /// The first element of this name in it.
    pub fn child(&self, name: &str) -> Option<&Self> {
        self.children.iter().find(|child| child.name == name)
    }

    /// The elements in the first element of this name.
    pub fn inside(&self, name: &str) -> &[Self] {
        self.child(name).map_or(&[], |child| &child.children)
    }
}

fn says_latin_1(bytes: &[u8]) -> bool {
    let head = &bytes[..bytes.len().min(200)];
    String::from_utf8_lossy(head)
        .to_lowercase()
        .contains("iso-8859-1")
}

fn parse(text: &str) -> Result<Element, String> {
    let mut reader = Reader::from_str(text);
    // The elements around the present one, the outermost first; below all of them a place for the root.
    let mut open = vec![Element::default()];
    loop {
        let place = reader.buffer_position();
        let fail = |error: &dyn std::fmt::Display| {
            format!("line {}: {error}", line_of(text, place as usize))
        };
        match reader.read_event().map_err(|error| fail(&error))? {
            Event::Start(_) if open.len() > DEEPEST => {
                return Err(fail(&"elements are nested too deeply"));
            }
            Event::Start(start) => open.push(element(&start).map_err(|error| fail(&error))?),
            Event::Empty(start) => {
                let child = element(&start).map_err(|error| fail(&error))?;
                put(&mut open, child);
            }
            Event::End(_) => {
                // The reader has checked that it ends what was opened.
                let Some(child) = open.pop() else { break };
                put(&mut open, child);
            }
            Event::Eof => break,
            _ => {}
        }
    }
    if open.len() > 1 {
        let name = open.pop().map_or_else(String::new, |element| element.name);
        return Err(format!("it ends inside <{name}>"));
    }
    let root = open.pop().and_then(|mut all| all.children.pop());
    root.ok_or_else(|| "it has no element".to_owned())
}

fn put(open: &mut [Element], child: Element) {
    if let Some(parent) = open.last_mut() {
        parent.children.push(child);
    }
}

fn element(start: &BytesStart<'_>) -> Result<Element, quick_xml::Error> {
    let mut attributes = Vec::new();
    for attribute in start.attributes() {
        let attribute = attribute?;
        let value = attribute.normalized_value(XmlVersion::Implicit1_0)?;
        let name = attribute.key.local_name().into_inner().to_owned();
        attributes.push((name, value.into_owned()));
    }
    Ok(Element {
        name: start.local_name().into_inner().to_owned(),
        attributes,
        children: Vec::new(),
    })
}

fn line_of(text: &str, place: usize) -> usize {
    let before = &text.as_bytes()[..place.min(text.len())];
    1 + before.iter().filter(|byte| **byte == b'\n').count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_and_attributes() {
        let text =
            "<?xml version=\"1.0\"?>\n<!-- c --><a x='1 &lt; 2'>\n<b:c y=\"\"/><d><e/></d></a>";
        let root = Element::read(text.as_bytes()).unwrap();
        assert_eq!(
            (root.name.as_str(), root.attribute("x")),
            ("a", Some("1 < 2"))
        );
        assert_eq!(root.children[0].name, "c");
        assert_eq!(root.children[0].attribute("y"), Some(""));
        assert_eq!(root.inside("d")[0].name, "e");
        assert!(root.child("f").is_none() && root.inside("f").is_empty());
    }

    #[test]
    fn mistakes_have_their_line() {
        for (text, words) in [
            ("<a>\n<b></a>", "line 2"),
            ("<a>\n", "inside <a>"),
            ("", "no element"),
            ("<a>\n\n<b x=1/></a>", "line 3"),
        ] {
            let error = Element::read(text.as_bytes()).unwrap_err();
            assert!(error.contains(words), "{text}: {error}");
        }
        let deep = "<a>".repeat(10_000);
        let error = Element::read(deep.as_bytes()).unwrap_err();
        assert!(error.contains("nested too deeply"), "{error}");
    }

    #[test]
    fn latin_1_is_read_where_it_is_declared() {
        let text = b"<?xml version='1.0' encoding='ISO-8859-1'?><a x='\xe4'/>";
        let root = Element::read(text).unwrap();
        assert_eq!(root.attribute("x"), Some("ä"));
        let error = Element::read(b"<a x='\xe4'/>").unwrap_err();
        assert!(error.contains("UTF-8 from byte 6"), "{error}");
    }
}

use crate::plot::style::{UNITS_PER_PIXEL, text_width};

/// An SVG file, taken apart.
pub(super) struct Svg {
    pub bytes: usize,
    pub width: f64,
    pub height: f64,
    elements: Vec<Element>,
}

struct Element {
    tag: String,
    attributes: Vec<(String, String)>,
    content: String,
}

/// The rectangle that the letters of a text cover, in drawing units.
#[derive(Debug)]
pub(super) struct Lettering {
    pub text: String,
    pub left: f64,
    pub right: f64,
    pub top: f64,
    pub bottom: f64,
}

impl Svg {
    /// Takes a file apart; panics where it is not well-formed.
    pub(super) fn parse(file: &str) -> Self {
        let mut elements: Vec<Element> = Vec::new();
        let mut open: Vec<usize> = Vec::new();
        let mut rest = file;
        while let Some(start) = rest.find('<') {
            let between = &rest[..start];
            assert!(!between.contains('>'), "a bare > in {between}");
            if let Some(element) = open.last() {
                elements[*element].content.push_str(between.trim());
            }
            let (tag, after) = rest[start + 1..]
                .split_once('>')
                .expect("a tag without an end");
            rest = after;
            if let Some(closed) = tag.strip_prefix('/') {
                let element = open.pop().expect("a closing tag without an opening one");
                assert_eq!(elements[element].tag, closed);
                continue;
            }
            if !tag.ends_with('/') {
                open.push(elements.len());
            }
            elements.push(Element::parse(tag.trim_end_matches('/')));
        }
        assert!(open.is_empty(), "a tag is not closed");
        let view: Vec<f64> = numbers(elements[0].attribute("viewBox"));
        Self {
            bytes: file.len(),
            width: view[2],
            height: view[3],
            elements,
        }
    }

    /// Width and height as shown, in pixels.
    pub(super) fn shown_size(&self) -> (u32, u32) {
        let side = |name| self.elements[0].attribute(name).parse().unwrap();
        (side("width"), side("height"))
    }

    pub(super) fn texts(&self) -> Vec<&str> {
        self.of("text")
            .map(|element| element.content.as_str())
            .collect()
    }

    /// Points of all polylines of a colour.
    pub(super) fn polylines(&self, colour: &str) -> Vec<Vec<(f64, f64)>> {
        let matching = self
            .of("polyline")
            .filter(|element| element.attribute("stroke") == colour);
        matching
            .map(|element| {
                numbers(element.attribute("points"))
                    .chunks(2)
                    .map(|pair| (pair[0], pair[1]))
                    .collect()
            })
            .collect()
    }

    pub(super) fn count(&self, tag: &str, attribute: &str, value: &str) -> usize {
        self.of(tag)
            .filter(|element| element.attribute(attribute) == value)
            .count()
    }

    fn of<'a>(&'a self, tag: &'a str) -> impl Iterator<Item = &'a Element> {
        self.elements
            .iter()
            .filter(move |element| element.tag == tag)
    }

    /// Asserts that every text lies inside the picture and touches no other one.
    pub(super) fn assert_legible(&self) {
        let letterings: Vec<Lettering> = self.of("text").map(Element::lettering).collect();
        for (index, one) in letterings.iter().enumerate() {
            let inside = one.left >= 0.0
                && one.right <= self.width
                && one.top >= 0.0
                && one.bottom <= self.height;
            assert!(
                inside,
                "`{}` leaves the picture of {} x {}: {one:?}",
                one.text, self.width, self.height
            );
            for other in &letterings[..index] {
                let apart = one.left >= other.right
                    || other.left >= one.right
                    || one.top >= other.bottom
                    || other.top >= one.bottom;
                assert!(
                    apart,
                    "`{}` covers `{}`: {one:?} {other:?}",
                    one.text, other.text
                );
            }
        }
    }
}

impl Element {
    fn parse(tag: &str) -> Self {
        let (name, mut rest) = tag.split_once(' ').unwrap_or((tag, ""));
        let mut attributes = Vec::new();
        while let Some((key, after)) = rest.split_once("=\"") {
            let (value, next) = after
                .split_once('"')
                .expect("an attribute without a closing quote");
            attributes.push((key.trim().to_owned(), value.to_owned()));
            rest = next;
        }
        assert!(rest.trim().is_empty(), "left over in a tag: {rest}");
        Self {
            tag: name.to_owned(),
            attributes,
            content: String::new(),
        }
    }

    fn attribute(&self, name: &str) -> &str {
        self.attributes
            .iter()
            .find(|(key, _)| key == name)
            .map_or("", |(_, value)| value)
    }

    fn lettering(&self) -> Lettering {
        let number = |name| self.attribute(name).parse::<f64>().unwrap();
        let (x, y, em) = (number("x"), number("y"), number("font-size"));
        let width = f64::from(text_width(&self.content, em / f64::from(UNITS_PER_PIXEL)));
        let start = match self.attribute("text-anchor") {
            "start" => 0.0,
            "middle" => -width / 2.0,
            _ => -width,
        };
        let baseline = em
            * match self.attribute("dy") {
                "0.76em" => 0.76,
                "0.5ex" => 0.27,
                _ => -0.27,
            };
        let (upper, lower) = (baseline - 0.74 * em, baseline + 0.02 * em);
        let text = self.content.clone();
        if self.attribute("transform").is_empty() {
            let (left, right) = (x + start, x + start + width);
            Lettering {
                text,
                left,
                right,
                top: y + upper,
                bottom: y + lower,
            }
        } else {
            let (top, bottom) = (y - start - width, y - start);
            Lettering {
                text,
                left: x + upper,
                right: x + lower,
                top,
                bottom,
            }
        }
    }
}

fn numbers(list: &str) -> Vec<f64> {
    list.split([',', ' '])
        .filter(|part| !part.is_empty())
        .map(|part| part.parse().unwrap())
        .collect()
}

//! The graph as a picture. The places are found by the crate layout-rs; what it would draw is kept here and written with our own
//! font and colours, lines below boxes below texts.

use std::fmt::Write;

use layout::core::base::Orientation;
use layout::core::color::Color;
use layout::core::format::{ClipHandle, RenderBackend};
use layout::core::geometry::{Point, get_size_for_str};
use layout::core::style::{LineStyleKind, StyleAttr};
use layout::std_shapes::shapes::{Arrow, Element, LineEndKind, ShapeKind};
use layout::topo::layout::VisualGraph;

use super::{Edge, Graph, Node};
use crate::html::Escaped;

/// Height of the texts in pixels; the layout takes it for their widest letter too.
const TEXT: usize = 14;

/// Distance of a text from the sides of its box.
const PADDING: (f64, f64) = (18.0, 14.0);

/// Around everything.
const MARGIN: f64 = 16.0;

/// The graph as an SVG: joints are plain lines, signals dashed arrows.
pub fn svg(graph: &Graph) -> String {
    let mut layout = VisualGraph::new(Orientation::LeftToRight);
    let style = || StyleAttr::new(Color::fast("black"), 1, None, 0, TEXT);
    let nodes: Vec<_> = graph
        .nodes
        .iter()
        .map(|node| {
            let label = label(node);
            let size = get_size_for_str(&label, TEXT);
            let size = Point::new(size.x * WIDTH + PADDING.0, size.y + PADDING.1);
            let shape = ShapeKind::new_box(&label);
            layout.add_node(Element::create(
                shape,
                style(),
                Orientation::LeftToRight,
                size,
            ))
        })
        .collect();
    for edge in &graph.edges {
        let [from, to] = edge.ends.map(|end| nodes[end]);
        layout.add_edge(arrow(edge, &style()), from, to);
    }
    let mut drawing = Drawing::default();
    layout.do_it(false, false, false, &mut drawing);
    drawing.written()
}

/// Mean width of a letter over its height.
const WIDTH: f64 = 0.68;

fn label(node: &Node) -> String {
    [std::slice::from_ref(&node.name), &node.lines]
        .concat()
        .join("\n")
}

fn arrow(edge: &Edge, style: &StyleAttr) -> Arrow {
    let (end, line) = match edge.is_signal {
        true => (LineEndKind::Arrow, LineStyleKind::Dashed),
        false => (LineEndKind::None, LineStyleKind::Normal),
    };
    let text = edge.lines.join("\n");
    Arrow::new(LineEndKind::None, end, line, &text, style, &None, &None)
}

/// What is drawn, by layers.
#[derive(Default)]
struct Drawing {
    lines: String,
    boxes: String,
    texts: String,
    /// Smallest and largest coordinates, once there are some.
    extent: Option<[Point; 2]>,
}

impl Drawing {
    fn covers(&mut self, point: Point) {
        let [low, high] = self.extent.unwrap_or([point, point]);
        self.extent = Some([
            Point::new(low.x.min(point.x), low.y.min(point.y)),
            Point::new(high.x.max(point.x), high.y.max(point.y)),
        ]);
    }

    fn written(&self) -> String {
        let origin = Point::new(0.0, 0.0);
        let [low, high] = self.extent.unwrap_or([origin, origin]);
        let (x, y) = (low.x - MARGIN, low.y - MARGIN);
        let (width, height) = (high.x - low.x + 2.0 * MARGIN, high.y - low.y + 2.0 * MARGIN);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
             viewBox=\"{x:.1} {y:.1} {width:.1} {height:.1}\">\n{STYLE}\
             <rect class=\"ground\" x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\"/>\n\
             {}{}{}</svg>\n",
            self.lines, self.boxes, self.texts
        )
    }
}

const STYLE: &str = "<defs><marker id=\"arrow\" markerWidth=\"10\" markerHeight=\"8\" refX=\"9\" refY=\"4\" orient=\"auto-start-reverse\">\
<path d=\"M0 0 L10 4 L0 8 z\" fill=\"#d55e00\"/></marker></defs>
<style>
text { font: 14px 'DejaVu Sans', Verdana, sans-serif; text-anchor: middle; fill: #3c3c3c; paint-order: stroke; stroke: #ffffff; \
stroke-width: 4px; stroke-linejoin: round; }
.ground { fill: #ffffff; }
.box { fill: #ffffff; stroke: #0072b2; stroke-width: 1.5; }
.joint { fill: none; stroke: #3c3c3c; stroke-width: 2.5; }
.signal { fill: none; stroke: #d55e00; stroke-width: 1.5; }
</style>
";

impl RenderBackend for Drawing {
    fn draw_rect(
        &mut self,
        xy: Point,
        size: Point,
        _look: &StyleAttr,
        _properties: Option<String>,
        _clip: Option<ClipHandle>,
    ) {
        self.covers(xy);
        self.covers(Point::new(xy.x + size.x, xy.y + size.y));
        // Writing to a string does not fail, here and below.
        let _ = writeln!(
            self.boxes,
            "<rect class=\"box\" rx=\"6\" x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\"/>",
            xy.x, xy.y, size.x, size.y
        );
    }

    /// No shape of ours has such lines.
    fn draw_line(&mut self, _: Point, _: Point, _: &StyleAttr, _: Option<String>) {}

    /// No shape of ours is round.
    fn draw_circle(&mut self, _: Point, _: Point, _: &StyleAttr, _: Option<String>) {}

    fn draw_text(&mut self, xy: Point, text: &str, _look: &StyleAttr) {
        let height = TEXT as f64 * 1.15;
        let lines: Vec<&str> = text.lines().collect();
        let first = xy.y - height * (lines.len() as f64 - 1.0) / 2.0 + 0.35 * TEXT as f64;
        for (number, line) in lines.into_iter().enumerate() {
            let y = first + number as f64 * height;
            let half = 0.5 * WIDTH * TEXT as f64 * line.chars().count() as f64;
            self.covers(Point::new(xy.x - half, y - height));
            self.covers(Point::new(xy.x + half, y));
            let _ = writeln!(
                self.texts,
                "<text x=\"{:.1}\" y=\"{y:.1}\">{}</text>",
                xy.x,
                Escaped(line)
            );
        }
    }

    fn draw_arrow(
        &mut self,
        path: &[(Point, Point)],
        dashed: bool,
        (at_start, at_end): (bool, bool),
        _look: &StyleAttr,
        _properties: Option<String>,
        _text: &str,
    ) {
        let [(start, leaving), (entering, next), rest @ ..] = path else {
            return;
        };
        let point = |point: &Point| format!("{:.1} {:.1}", point.x, point.y);
        let mut curve = format!(
            "M {} C {}, {}, {}",
            point(start),
            point(leaving),
            point(entering),
            point(next)
        );
        for (entering, next) in rest {
            curve += &format!(" S {}, {}", point(entering), point(next));
        }
        for place in path.iter().flat_map(|(one, other)| [one, other]) {
            self.covers(*place);
        }
        // Edges that would close a circle are laid out the other way round.
        let heads = [(at_start, "marker-start"), (at_end, "marker-end")];
        let heads = heads.into_iter().filter(|(is_there, _)| *is_there);
        let heads: String = heads
            .map(|(_, end)| format!(" {end}=\"url(#arrow)\""))
            .collect();
        let (class, dashes) = match dashed {
            true => ("signal", " stroke-dasharray=\"6 4\""),
            false => ("joint", ""),
        };
        let _ = writeln!(
            self.lines,
            "<path class=\"{class}\"{dashes}{heads} d=\"{curve}\"/>"
        );
    }

    fn create_clip(&mut self, _xy: Point, _size: Point, _rounded: usize) -> ClipHandle {
        0
    }
}

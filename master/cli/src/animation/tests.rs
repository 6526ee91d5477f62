#![allow(clippy::unwrap_used)]

use linchpin_master::results::{Mechanism, RecordedContact, RecordedJoint, RecordedMarker};
use linchpin_proto::v1::MarkerKind;
use nalgebra::Vector3;
use serde_json::Value;

use super::motion::Motion;
use super::page;
use super::stage::Stage;
use super::view::View;

/// A marker whose position stands in the columns from `first`.
fn marker(
    subsystem: usize,
    name: &str,
    kind: MarkerKind,
    first: usize,
    n: usize,
) -> RecordedMarker {
    RecordedMarker {
        subsystem,
        name: name.to_owned(),
        kind,
        columns: (first..first + n).collect(),
    }
}

fn mechanism(subsystems: &[&str], markers: Vec<RecordedMarker>) -> Mechanism {
    Mechanism {
        subsystems: subsystems.iter().map(|&name| name.to_owned()).collect(),
        markers,
        joints: Vec::new(),
        contacts: Vec::new(),
    }
}

/// Rows `t, position(t)` at `steps + 1` equal distances in a second.
fn moved<const N: usize>(mechanism: &Mechanism, steps: u32, at: fn(f64) -> [f64; N]) -> Motion {
    let mut motion = Motion::new(mechanism).unwrap();
    for step in 0..=steps {
        let t = f64::from(step) / f64::from(steps);
        motion.record(&[&[t][..], &at(t)].concat());
    }
    motion
}

fn film(page: &str) -> Value {
    let (_, rest) = page.split_once(r#"id="film">"#).unwrap();
    serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap()
}

fn swing(t: f64) -> [f64; 3] {
    [13.0 + 0.7 * (5.0 * t).cos(), 0.3 * (5.0 * t).sin(), 5.0 * t]
}

fn one_planar() -> Mechanism {
    mechanism(&["rod"], vec![marker(0, "end", MarkerKind::Planar, 1, 3)])
}

#[test]
fn frames_are_few_even_and_reach_both_ends() {
    for steps in [1, 2, 598, 599, 600, 601, 1000, 4801, 100_003] {
        let motion = moved(&one_planar(), steps, swing);
        let times: Vec<f64> = motion.frames().map(|frame| frame.t).collect();
        let rows = steps as usize + 1;
        assert!(
            times.len() <= 600 && times.len() >= rows.min(300),
            "{steps}: {}",
            times.len()
        );
        assert_eq!((times[0], times[times.len() - 1]), (0.0, 1.0), "{steps}");
        let gap = motion.stride() as f64 / f64::from(steps);
        let (last, others) = times.split_last().unwrap();
        for pair in others.windows(2) {
            assert!((pair[1] - pair[0] - gap).abs() < 1e-12, "{steps}");
        }
        assert!(
            last - others[others.len() - 1] < gap * (1.0 + 1e-9),
            "{steps}"
        );
        assert_eq!(motion.rows(), rows);
    }
}

#[test]
fn many_markers_take_no_more_room_than_few() {
    for (count, least_frames) in [(2, 300), (20, 300), (200, 36), (2000, 3)] {
        let markers = (0..count)
            .map(|_| marker(0, "m", MarkerKind::Spatial, 1, 7))
            .collect();
        let mechanism = mechanism(&["rod"], markers);
        let motion = moved(&mechanism, 2000, |t| {
            let half: f64 = 3.1 * t;
            [
                t.sin(),
                -t,
                t * t,
                half.cos(),
                0.6 * half.sin(),
                0.0,
                0.8 * half.sin(),
            ]
        });
        let frames = motion.frames().count();
        let page = page::text("many", &motion).unwrap();
        assert!(frames >= least_frames, "{count}: {frames} frames");
        // The descriptions of the markers come on top.
        let most = 1_000_000 + 700 * count as usize;
        assert!(page.len() < most, "{count}: {} bytes", page.len());
    }
}

#[test]
fn markers_that_lack_a_position_are_left_out_with_their_joints() {
    let mut mechanism = mechanism(
        &["a", "b"],
        vec![
            marker(0, "blind", MarkerKind::Planar, 1, 1),
            marker(0, "odd", MarkerKind::Unspecified, 1, 3),
            marker(0, "point", MarkerKind::Planar, 1, 2),
            marker(1, "end", MarkerKind::Planar, 1, 3),
        ],
    );
    let joint = |name: &str, ends| RecordedJoint {
        name: name.to_owned(),
        ends,
        points: [[0.0; 3]; 2],
    };
    mechanism.joints = vec![joint("open", [0, 3]), joint("hinge", [2, 3])];
    let motion = Motion::new(&mechanism).unwrap();
    let names: Vec<&str> = motion.markers.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(names, ["point", "end"]);
    assert_eq!(motion.joints, [joint("hinge", [0, 1])]);
    mechanism.markers.truncate(2);
    mechanism.joints.clear();
    assert!(Motion::new(&mechanism).is_none());
}

/// The same length in x and in y is the same number of pixels, and all of the run is inside the picture.
#[test]
fn a_planar_scene_has_equal_axes() {
    for (x, y) in [
        (1.0, 1.0),
        (1e-9, 3e-9),
        (4e8, 1e5),
        (1.0, 0.0),
        (0.0, 1e-3),
    ] {
        let mechanism = one_planar();
        let mut motion = Motion::new(&mechanism).unwrap();
        let corners = [(0.0, 0.0), (x, 0.0), (x, y), (0.0, y)];
        for (number, (x, y)) in corners.into_iter().enumerate() {
            motion.record(&[number as f64, 7.0 * x, -y, 0.3]);
        }
        let view = View::on(&Stage::of(&motion));
        let at = |(x, y): (f64, f64)| view.place(&Vector3::new(7.0 * x, -y, 0.0));
        let [origin, right, _, down] = corners.map(at);
        for place in corners.map(at) {
            let inside = |place: f64, size: f64| (0.0..=size).contains(&place);
            assert!(
                inside(place.0, view.size.0) && inside(place.1, view.size.1),
                "{place:?}"
            );
        }
        let close = |pixels: f64, metres: f64| (pixels - view.scale * metres).abs() < 1e-6;
        assert!(close(right.0 - origin.0, 7.0 * x) && close(down.1 - origin.1, y));
    }
}

/// Turned to any side, the box of the run stays inside the picture.
#[test]
fn a_scene_in_space_fits_from_every_side() {
    let mechanism = mechanism(&["rod"], vec![marker(0, "end", MarkerKind::Spatial, 1, 7)]);
    let motion = moved(&mechanism, 50, |t| {
        [3.0 * t, -t, 0.5 + t * t, 1.0, 0.0, 0.0, 0.0]
    });
    let stage = Stage::of(&motion);
    let view = View::on(&stage);
    let (right, up) = (Vector3::from(view.right), Vector3::from(view.up));
    assert!((right.norm() - 1.0).abs() < 1e-14 && (up.norm() - 1.0).abs() < 1e-14);
    assert!(right.dot(&up).abs() < 1e-14 && right.z == 0.0 && up.z > 0.0);
    let farthest = view.scale * 0.5 * (stage.high - stage.low).norm();
    assert!(farthest <= 0.5 * view.size.0.min(view.size.1));
    assert!(view.turn.is_some());
}

/// What a worker names as it likes ends neither an element nor the script.
#[test]
fn names_stay_text() {
    let evil = r#"</script><img src=x onerror="alert('1')">&<!--"#;
    let mut mechanism = mechanism(&["rod"], vec![marker(0, evil, MarkerKind::Planar, 1, 3)]);
    mechanism.joints = vec![RecordedJoint {
        name: evil.to_owned(),
        ends: [0, 0],
        points: [[0.0; 3]; 2],
    }];
    let page = page::text(evil, &moved(&mechanism, 10, swing)).unwrap();
    assert_eq!(page.matches("<script").count(), 2);
    assert_eq!(page.matches("</script>").count(), 2);
    assert!(!page.contains("<img") && !page.contains("<!--"));
    assert!(page.contains(
        "&lt;/script&gt;&lt;img src=x onerror=&quot;alert(&#39;1&#39;)&quot;&gt;&amp;&lt;!--"
    ));
    assert_eq!(film(&page)["markers"][0]["name"], evil);
}

#[test]
fn numbers_of_any_size_give_a_picture() {
    for scale in [0.0, 1e-305, 1e-12, 1e12, 1e99, f64::MAX] {
        for kind in [MarkerKind::Scalar, MarkerKind::Planar, MarkerKind::Spatial] {
            let mechanism = mechanism(&["rod"], vec![marker(0, "end", kind, 1, 7)]);
            let mut motion = Motion::new(&mechanism).unwrap();
            for t in [0.0, 1.0, 2.0] {
                let x = scale * (t - 0.7);
                motion.record(&[t, x, -x, 0.5 * x, 0.0, 0.0, 0.0, 0.0]);
            }
            let page = page::text("size", &motion).unwrap();
            let (picture, _) = page.split_once("</svg>").unwrap();
            assert!(
                !picture.contains("NaN") && !picture.contains("inf"),
                "{scale} {kind:?}"
            );
            assert_eq!(film(&page)["t"].as_array().unwrap().len(), 3);
        }
    }
}

/// The script finds what it moves by these names.
#[test]
fn the_page_has_every_element_of_the_script() {
    let page = page::text("rod", &moved(&one_planar(), 10, swing)).unwrap();
    let (body, script) = page.rsplit_once("<script>").unwrap();
    for id in [
        "film", "picture", "time", "scenery", "traces", "bodies", "markers", "joints", "contacts",
        "controls",
    ] {
        assert!(script.contains(&format!("\"{id}\"")), "{id}");
        assert_eq!(body.matches(&format!("id=\"{id}\"")).count(), 1, "{id}");
    }
}

/// Two bodies' worth of names: what is numbered is joined to its own kind, contacts to nothing.
#[test]
fn numbered_markers_are_outlines() {
    let names = [
        (0, "pin", MarkerKind::Planar),
        (0, "wall1", MarkerKind::Planar),
        (0, "corner1", MarkerKind::Planar),
        (0, "rod1", MarkerKind::Planar),
        (0, "wall2", MarkerKind::Planar),
        (0, "corner2", MarkerKind::Planar),
        (0, "slider", MarkerKind::Planar),
        (0, "rod2", MarkerKind::Planar),
        (1, "rod1", MarkerKind::Planar),
        (1, "7", MarkerKind::Planar),
        (1, "ball", MarkerKind::Planar),
        (2, "mass1", MarkerKind::Scalar),
        (2, "mass2", MarkerKind::Scalar),
    ];
    let markers = names.map(|(subsystem, name, kind)| marker(subsystem, name, kind, 1, 3));
    let mut mechanism = mechanism(&["a", "b", "c"], markers.into());
    mechanism.contacts = [2, 5, 10].map(contact).into();
    let page = page::text("names", &moved(&mechanism, 10, |t| [t; 6])).unwrap();
    let film = film(&page);
    let bodies = serde_json::json!([[0, 6], [1, 4], [3, 7], [8, 9, 10], [11, 12]]);
    assert_eq!(film["bodies"], bodies);
    let framed: Vec<&str> = { film["markers"].as_array().unwrap().iter() }
        .filter(|marker| marker["framed"] == true)
        .map(|marker| marker["name"].as_str().unwrap())
        .collect();
    // A number alone is no word and a number, and one point is no line.
    assert_eq!(
        framed,
        ["pin", "slider", "rod1", "7", "ball", "mass1", "mass2"]
    );
    let (picture, _) = page.split_once("</svg>").unwrap();
    assert_eq!(picture.matches(r#"class="outline "#).count(), 2);
    assert_eq!(picture.matches(r#"class="trace "#).count(), framed.len());
    assert_eq!(
        picture.matches(r#"<g class="marker "#).count(),
        framed.len()
    );
    assert_eq!(picture.matches(r#"<g class="contact""#).count(), 3);
}

/// Force, impulse and number of impacts stand behind a position.
fn contact(marker: usize) -> RecordedContact {
    RecordedContact {
        marker,
        force: 4,
        impulse: Some(5),
        impacts: Some(6),
    }
}

#[test]
fn contacts_are_dots_and_impacts_flash() {
    let mut mechanism = mechanism(&["ball"], vec![marker(0, "ball", MarkerKind::Planar, 1, 3)]);
    mechanism.contacts = vec![contact(0)];
    // Pressed with 2 N for 0.3 s, and an impact at 0.7 s.
    let at = |t: f64| {
        let force = if t < 0.35 { 2.0 } else { 0.0 };
        let impulse = if (t - 0.7).abs() < 0.01 { 0.4 } else { 0.0 };
        [0.1, t, 0.0, force, impulse, f64::from(impulse > 0.0)]
    };
    let page = page::text("ball", &moved(&mechanism, 10, at)).unwrap();
    let film = film(&page);
    let only = &film["contacts"][0];
    let expected = [110, 110, 110, 110, 0, 0, 0, 0, 0, 0, 0];
    assert_eq!(only["radii"], serde_json::json!(expected));
    assert_eq!(
        only["flashes"],
        serde_json::json!([0, 0, 0, 0, 0, 0, 0, 100, 0, 0, 0])
    );
    // Without scripting as well: a filled dot, no ring.
    let (_, group) = page.split_once(r#"<g id="contacts">"#).unwrap();
    let (group, _) = group.split_once("</svg>").unwrap();
    assert!(
        group.contains(r#"r="11"/>"#) && group.contains(r#"r="0"/>"#),
        "{group}"
    );
    assert!(page.contains("at most 2.00 N"));
}

/// Where only the number of impacts is known, they are those of the contacts that are closed, or of any.
#[test]
fn impacts_of_a_subsystem_are_those_of_closed_contacts() {
    let markers = ["left", "right"].map(|name| marker(0, name, MarkerKind::Planar, 1, 3));
    let mut mechanism = mechanism(&["block"], markers.into());
    let recorded = |marker, force| RecordedContact {
        marker,
        force,
        impulse: None,
        impacts: Some(6),
    };
    mechanism.contacts = vec![recorded(0, 4), recorded(1, 5)];
    let at = |t: f64| match t {
        0.0 => [0.0, 0.0, 0.0, 3.0, 0.0, 1.0],
        1.0 => [0.0, 0.0, 0.0, 0.0, 0.0, 2.0],
        _ => [0.0; 6],
    };
    let film = film(&page::text("block", &moved(&mechanism, 2, at)).unwrap());
    let flashes = |contact: usize| &film["contacts"][contact]["flashes"];
    assert_eq!(*flashes(0), serde_json::json!([100, 0, 100]));
    assert_eq!(*flashes(1), serde_json::json!([0, 0, 100]));
}

/// Neither impacts in every row nor numbers that are none make a page that cannot be read.
#[test]
fn odd_contacts_give_a_picture() {
    let mut mechanism = mechanism(&["ball"], vec![marker(0, "ball", MarkerKind::Planar, 1, 3)]);
    mechanism.contacts = vec![contact(0)];
    for odd in [f64::NAN, f64::INFINITY, -3.0, 1e-310, f64::MAX, 0.0] {
        let mut motion = Motion::new(&mechanism).unwrap();
        for row in 0..5000 {
            motion.record(&[f64::from(row), 0.0, 1.0, 0.0, odd, odd, odd]);
        }
        let page = page::text("odd", &motion).unwrap();
        let (picture, _) = page.split_once("</svg>").unwrap();
        assert!(
            !picture.contains("NaN") && !picture.contains("inf"),
            "{odd}"
        );
        let film = film(&page);
        for numbers in ["radii", "flashes"] {
            let numbers = film["contacts"][0][numbers].as_array().unwrap();
            assert_eq!(numbers.len(), film["t"].as_array().unwrap().len());
            assert!(
                numbers.iter().all(|number| number.as_u64().unwrap() <= 110),
                "{odd}"
            );
        }
    }
}

//! Tables that stand in a list, one for each `[[...]]`.

use super::reader::{Problems, Section};

/// The tables of a list, each under its name.
pub(crate) fn sections<'w>(
    root: &Section<'w>,
    key: &'static str,
    problems: &mut Problems<'_>,
) -> Vec<Section<'w>> {
    let allowed = match key {
        "subsystem" => "tables headed [[subsystem]]",
        "joint" => "tables headed [[joint]]",
        "connection" => "tables headed [[connection]]",
        "scene" => "tables headed [[scene]]",
        "setting" => "tables headed [[setting]]",
        "curve" => "tables headed [[spectrum.curve]]",
        "point" => "tables headed [[spectrum.region.point]]",
        _ => "tables headed [[case]]",
    };
    let items = root
        .get(key)
        .and_then(|field| field.items(allowed, problems))
        .unwrap_or_default();
    let mut sections = Vec::new();
    for mut item in items {
        if let Some(name) = item.node.name() {
            item.key = format!("{key}.{name}");
        }
        sections.extend(item.section(problems));
    }
    sections
}

/// All or nothing, but every element is read.
pub(crate) fn collect<S, T>(items: &[S], read: impl FnMut(&S) -> Option<T>) -> Option<Vec<T>> {
    let read: Vec<Option<T>> = items.iter().map(read).collect();
    read.into_iter().collect()
}

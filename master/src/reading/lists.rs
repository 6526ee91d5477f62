//! Tables that stand in a list, one for each `[[...]]`.

use super::reader::{Field, Problems, Section};

/// The tables of a list, each under its name.
pub(crate) fn sections<'w>(
    list: Option<Field<'w>>,
    problems: &mut Problems<'_>,
) -> Vec<Section<'w>> {
    let Some(list) = list else { return Vec::new() };
    let key = list.key.rsplit('.').next().unwrap_or_default();
    let items = list.items(problems).unwrap_or_default();
    let section = |mut item: Field<'w>| {
        if let Some(name) = item.node.name() {
            item.key = format!("{key}.{name}");
        }
        item.section(problems)
    };
    items.into_iter().filter_map(section).collect()
}

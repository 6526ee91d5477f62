//! Names for messages.

/// Longest name for which a neighbour is looked for; the search takes time with the square of the length.
const LONGEST: usize = 64;

/// Most names that a message lists.
const MOST: usize = 20;

/// What to say about an unknown `name`: the nearest of those known, or all of them if they are few.
pub fn known<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.collect();
    match (nearest(name, &known), known.len()) {
        (Some(near), _) => format!("did you mean \"{near}\"?"),
        (None, 0) => "there are none".to_owned(),
        (None, count @ ..=MOST) => format!(
            "{} {}",
            if count == 1 { "there is" } else { "there are" },
            known.join(", ")
        ),
        (None, count) => format!(
            "there are {count}, among them {}; `linchpin describe` lists all",
            known[..MOST].join(", ")
        ),
    }
}

/// At most one edit in three letters away, upper and lower case alike.
fn nearest<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    if name.len() > LONGEST {
        return None;
    }
    let wanted = name.to_lowercase();
    let reach = (wanted.chars().count() / 3).max(1);
    let near = known.iter().filter_map(|candidate| {
        let edits = strsim::damerau_levenshtein(&wanted, &candidate.to_lowercase());
        (edits <= reach).then_some((edits, *candidate))
    });
    near.min_by_key(|(edits, _)| *edits).map(|(_, near)| near)
}

//! The known name that a misspelt one was probably meant to be.

/// Longest name for which a neighbour is looked for; the search takes time with the square of the length.
const LONGEST: usize = 64;

/// The name in `known` nearest to `name`: at most one edit in three letters away, upper and lower case alike.
pub(crate) fn nearest<'k>(name: &str, known: impl IntoIterator<Item = &'k str>) -> Option<String> {
    if name.len() > LONGEST {
        return None;
    }
    let wanted = name.to_lowercase();
    let reach = (wanted.chars().count() / 3).max(1);
    known
        .into_iter()
        .map(|candidate| {
            let edits = strsim::damerau_levenshtein(&wanted, &candidate.to_lowercase());
            (edits, candidate)
        })
        .filter(|(edits, _)| *edits <= reach)
        .min_by_key(|(edits, _)| *edits)
        .map(|(_, candidate)| candidate.to_owned())
}

/// At most `count` of the places, about equally far apart; `offset` moves them, so that coinciding curves stay
/// distinguishable.
pub(super) fn spread(
    places: &[(i32, i32)],
    width: i32,
    count: usize,
    offset: f64,
) -> impl Iterator<Item = (i32, i32)> {
    let distance = f64::from(width) / count as f64;
    (0..count).filter_map(move |number| {
        let wanted = ((number as f64 + offset) * distance) as i32;
        let next = places.partition_point(|place| place.0 < wanted);
        places
            .get(next)
            .copied()
            .filter(|place| f64::from(place.0 - wanted) < distance)
    })
}

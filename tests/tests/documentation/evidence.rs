//! Pages of measurements say where their numbers come from.

use linchpin_tests::evidence::is_stamped;

use crate::page::pages;

#[test]
fn every_page_of_evidence_says_where_its_numbers_come_from() {
    let mut found = 0;
    for page in pages() {
        if page.name().starts_with("docs/evidence/") {
            assert!(
                is_stamped(&page.text),
                "{} has no line with commit, machine and date; see tests/src/evidence.rs",
                page.name()
            );
            found += 1;
        }
    }
    assert!(found > 0, "there is no evidence");
}

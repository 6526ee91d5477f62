//! Links between pages, to files and to headings.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use crate::page::{Page, pages};

#[test]
fn every_link_leads_somewhere() {
    let pages = pages();
    let anchors: BTreeMap<PathBuf, BTreeSet<String>> = pages
        .iter()
        .map(|page| (page.path.canonicalize().unwrap(), anchors(page)))
        .collect();
    let mut broken = Vec::new();
    for page in &pages {
        for line in page.prose() {
            for target in targets(line.text) {
                if let Err(reason) = follow(page, target, &anchors) {
                    broken.push(format!(
                        "{}:{}: {target}: {reason}",
                        page.name(),
                        line.number
                    ));
                }
            }
        }
    }
    assert!(broken.is_empty(), "\n{}", broken.join("\n"));
}

/// A link to a name of the code leads to a file that has this name.
#[test]
fn every_name_of_the_code_is_in_its_file() {
    let mut wrong = Vec::new();
    let mut found = 0;
    for page in pages() {
        let definitions: BTreeMap<&str, &str> = page
            .prose()
            .filter_map(|line| definition(line.text))
            .collect();
        for (name, label) in named_links(&page.text) {
            let folder = page.path.parent().unwrap_or(Path::new("."));
            let Some(target) = definitions.get(label) else {
                wrong.push(format!("{}: [{label}] leads nowhere", page.name()));
                continue;
            };
            let text = fs::read_to_string(folder.join(target)).unwrap_or_default();
            let last = name.rsplit("::").next().unwrap_or(name);
            let is_letter = |letter: char| letter.is_alphanumeric() || letter == '_';
            if !text
                .split(|letter| !is_letter(letter))
                .any(|word| word == last)
            {
                wrong.push(format!("{}: {target} has no {name}", page.name()));
            }
            found += 1;
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
    assert!(found > 0, "no page names the code");
}

/// Links such as ``[`name`][label]``, which may be broken over lines.
fn named_links(text: &str) -> Vec<(&str, &str)> {
    let mut links = Vec::new();
    for rest in text.split("[`").skip(1) {
        let link = rest.split_once("`][").and_then(|(name, rest)| {
            let label = rest.split(']').next()?;
            (!name.contains('`')).then_some((name, label))
        });
        links.extend(link);
    }
    links
}

#[test]
fn headings_have_the_anchors_of_code_hosts() {
    let page = Page {
        path: PathBuf::new(),
        text:
            "# Fig. 20: elements\n## `[[case]]`, [run](x.md)\n## Twice\n## Twice\n```\n# no\n```\n"
                .into(),
    };
    let expected = ["fig-20-elements", "case-run", "twice", "twice-1"];
    assert_eq!(
        anchors(&page),
        expected.into_iter().map(String::from).collect()
    );
}

fn follow(
    page: &Page,
    target: &str,
    anchors: &BTreeMap<PathBuf, BTreeSet<String>>,
) -> Result<(), String> {
    if target.contains("://") {
        return Ok(());
    }
    let (file, anchor) = match target.split_once('#') {
        Some((file, anchor)) => (file, Some(anchor)),
        None => (target, None),
    };
    let folder = page.path.parent().unwrap_or(Path::new("."));
    let path = if file.is_empty() {
        page.path.clone()
    } else {
        folder.join(file)
    };
    let path = path
        .canonicalize()
        .map_err(|_| "there is no such file".to_owned())?;
    match anchor {
        Some(anchor) if !anchors.get(&path).is_some_and(|all| all.contains(anchor)) => {
            Err("there is no such heading".into())
        }
        _ => Ok(()),
    }
}

/// What the links and pictures of a line lead to, or the link that it defines for others; code spans have none.
fn targets(line: &str) -> Vec<&str> {
    let mut targets = Vec::new();
    if let Some((_, target)) = definition(line) {
        return vec![target];
    }
    for text in line.split('`').step_by(2) {
        let mut rest = text;
        while let Some(start) = rest.find("](") {
            rest = &rest[start + 2..];
            let Some(end) = rest.find(')') else { break };
            targets.push(&rest[..end]);
            rest = &rest[end..];
        }
    }
    targets
}

/// Name and target of a line `[name]: target`.
fn definition(line: &str) -> Option<(&str, &str)> {
    line.strip_prefix('[')?.split_once("]: ")
}

/// Anchors of the headings, as code hosts and the book make them.
fn anchors(page: &Page) -> BTreeSet<String> {
    let mut anchors = BTreeSet::new();
    let mut seen: BTreeMap<String, usize> = BTreeMap::new();
    for line in page.prose() {
        let heading = line.text.trim_start_matches('#');
        if heading.len() == line.text.len() || !heading.starts_with(' ') {
            continue;
        }
        let anchor = anchor(heading.trim());
        let count = seen.entry(anchor.clone()).or_default();
        anchors.insert(match *count {
            0 => anchor,
            n => format!("{anchor}-{n}"),
        });
        *count += 1;
    }
    anchors
}

fn anchor(heading: &str) -> String {
    let mut text = heading.to_owned();
    while let Some(start) = text.find("](") {
        let end = text[start..]
            .find(')')
            .map_or(text.len(), |end| start + end + 1);
        text.replace_range(start..end, "");
    }
    let kept = text
        .chars()
        .filter(|c| c.is_alphanumeric() || " -_".contains(*c));
    kept.flat_map(char::to_lowercase)
        .map(|c| if c == ' ' { '-' } else { c })
        .collect()
}

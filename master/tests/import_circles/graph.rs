//! Which file of a crate takes names from which other one, and where that goes in a circle.

use std::collections::{BTreeMap, BTreeSet};

use super::source::{Mention, Names, Source};

/// All files of a crate, by the names of their modules; the root has none.
pub struct Files {
    sources: BTreeMap<Names, (String, Source)>,
}

/// One file takes something from another.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Arrow {
    pub from: String,
    pub to: String,
    /// The path, as it is written in the first one.
    pub text: String,
}

/// Where a name leads: its module, and whether that is what the name means, or only where the thing is defined.
#[derive(Debug, Clone, PartialEq)]
struct Found {
    module: Names,
    is_module: bool,
}

/// Re-exports of re-exports end after so many.
const MOST_ALIASES: usize = 20;

impl Files {
    /// From places below the folder of the root, with `/`, and texts.
    pub fn read<T: AsRef<str>>(files: impl IntoIterator<Item = (T, T)>) -> Self {
        let sources = files.into_iter().map(|(place, text)| {
            let place = place.as_ref();
            let source = Source::read(text.as_ref());
            let source = source.unwrap_or_else(|error| panic!("{place}: {error}"));
            (module_of(place), (place.to_owned(), source))
        });
        Self {
            sources: sources.collect(),
        }
    }

    /// The arrows between different files, each with the path that makes it.
    pub fn arrows(&self) -> BTreeSet<Arrow> {
        let mut arrows = BTreeSet::new();
        for (module, (from, source)) in &self.sources {
            for mention in &source.mentions {
                let to = self.file_of(module, mention);
                arrows.extend(to.filter(|to| to != from).map(|to| Arrow {
                    from: from.clone(),
                    to,
                    text: mention.text(),
                }));
            }
        }
        arrows
    }

    /// The file to which a path leads. What stands behind an imported name that is no module is told by the import.
    fn file_of(&self, module: &Names, mention: &Mention) -> Option<String> {
        let first = self.follow(module, &mention.path[..1], MOST_ALIASES)?;
        if !mention.is_use && !first.is_module {
            return None;
        }
        let found = self.follow(module, &mention.path, MOST_ALIASES)?;
        Some(self.sources[&found.module].0.clone())
    }

    /// Where a path leads that stands in a module; `None` if out of the crate.
    fn follow(&self, module: &Names, path: &[String], aliases: usize) -> Option<Found> {
        let (first, mut rest) = path.split_first()?;
        let mut found = match first.as_str() {
            "crate" => Found {
                module: Names::new(),
                is_module: true,
            },
            "self" => Found {
                module: module.clone(),
                is_module: true,
            },
            "super" => Found {
                module: parent(module),
                is_module: true,
            },
            name => self.look_up(module, name, aliases)?,
        };
        while let Some((name, after)) = rest.split_first() {
            if !found.is_module {
                break;
            }
            found = match name.as_str() {
                "super" => Found {
                    module: parent(&found.module),
                    is_module: true,
                },
                name => match self.look_up(&found.module, name, aliases) {
                    Some(next) => next,
                    None => break,
                },
            };
            rest = after;
        }
        Some(found)
    }

    /// What a name means in a module.
    fn look_up(&self, module: &Names, name: &str, aliases: usize) -> Option<Found> {
        let mut child = module.clone();
        child.push(name.to_owned());
        if self.sources.contains_key(&child) {
            return Some(Found {
                module: child,
                is_module: true,
            });
        }
        let (_, source) = self.sources.get(module)?;
        if source.items.contains(name) {
            return Some(Found {
                module: module.clone(),
                is_module: false,
            });
        }
        let aliases = aliases.checked_sub(1)?;
        if let Some(path) = source.imported.get(name) {
            return self.follow(module, path, aliases);
        }
        source.globs.iter().find_map(|path| {
            let all = self.follow(module, path, aliases)?;
            self.look_up(&all.module, name, aliases)
        })
    }
}

/// The arrows of every circle: of files from each of which a way leads to each other one.
pub fn circles(arrows: &BTreeSet<Arrow>) -> Vec<Vec<Arrow>> {
    let mut next: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for arrow in arrows {
        next.entry(&arrow.from).or_default().insert(&arrow.to);
    }
    let reached: BTreeMap<&str, BTreeSet<&str>> = next
        .keys()
        .map(|&file| (file, reached_from(file, &next)))
        .collect();
    let reaches = |from: &str, to: &str| reached.get(from).is_some_and(|all| all.contains(to));
    let mut circles: BTreeMap<&str, Vec<Arrow>> = BTreeMap::new();
    for arrow in arrows
        .iter()
        .filter(|arrow| reaches(&arrow.to, &arrow.from))
    {
        let mut others = reached[&*arrow.from]
            .iter()
            .filter(|file| reaches(file, &arrow.from));
        let first = others.next().expect("the arrow leads to one of them");
        circles.entry(first).or_default().push(arrow.clone());
    }
    circles.into_values().collect()
}

/// All files to which a way of arrows leads.
fn reached_from<'a>(
    file: &'a str,
    next: &BTreeMap<&'a str, BTreeSet<&'a str>>,
) -> BTreeSet<&'a str> {
    let mut reached = BTreeSet::new();
    let mut open = vec![file];
    while let Some(file) = open.pop() {
        let following = next.get(file).into_iter().flatten();
        open.extend(following.filter(|&&file| reached.insert(file)));
    }
    reached
}

/// `a/b.rs` and `a/b/mod.rs` are the module `a::b`.
fn module_of(place: &str) -> Names {
    let place = place.strip_suffix(".rs").unwrap_or(place);
    let mut names: Names = place.split('/').map(str::to_owned).collect();
    names.pop_if(|last| ["lib", "mod"].contains(&&**last));
    names
}

fn parent(module: &Names) -> Names {
    module[..module.len().saturating_sub(1)].to_vec()
}

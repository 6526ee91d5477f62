//! README.md and everything under docs/.

use std::fs;
use std::path::{Path, PathBuf};

/// One Markdown file.
pub struct Page {
    /// Where it is.
    pub path: PathBuf,
    /// What it says.
    pub text: String,
}

/// A code block.
pub struct Block<'a> {
    /// What stands behind the fence.
    pub language: &'a str,
    /// Number of its first line.
    pub number: usize,
    /// Its lines.
    pub lines: Vec<&'a str>,
}

/// A line of a page outside of its code blocks.
pub struct Line<'a> {
    /// Counted from 1.
    pub number: usize,
    /// Without the end of the line.
    pub text: &'a str,
}

impl Page {
    /// Reads a page.
    pub fn read(path: PathBuf) -> Self {
        let text = fs::read_to_string(&path).unwrap();
        Self { path, text }
    }

    /// Its place in the repository.
    pub fn name(&self) -> String {
        let name = self.path.strip_prefix(repository()).unwrap();
        name.display().to_string()
    }

    /// The lines outside of code blocks.
    pub fn prose(&self) -> impl Iterator<Item = Line<'_>> {
        self.lines()
            .filter(|(is_code, _)| !is_code)
            .map(|(_, line)| line)
    }

    /// The code blocks, in their order.
    pub fn blocks(&self) -> Vec<Block<'_>> {
        let mut blocks: Vec<Block> = Vec::new();
        let mut in_code = false;
        for (number, line) in self.text.lines().enumerate() {
            if let Some(language) = line.trim_start().strip_prefix("```") {
                in_code = !in_code;
                if in_code {
                    blocks.push(Block {
                        language,
                        number: number + 2,
                        lines: Vec::new(),
                    });
                }
            } else if in_code && let Some(block) = blocks.last_mut() {
                block.lines.push(line);
            }
        }
        blocks
    }

    fn lines(&self) -> impl Iterator<Item = (bool, Line<'_>)> {
        let mut in_code = false;
        self.text.lines().enumerate().map(move |(number, text)| {
            let is_fence = text.trim_start().starts_with("```");
            let is_code = in_code || is_fence;
            if is_fence {
                in_code = !in_code;
            }
            let number = number + 1;
            (is_code, Line { number, text })
        })
    }
}

/// The folder with README.md.
pub fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

/// README.md and every page under docs/.
pub fn pages() -> Vec<Page> {
    let mut paths = vec![repository().join("README.md")];
    collect(&repository().join("docs"), &mut paths);
    paths.sort();
    paths.into_iter().map(Page::read).collect()
}

fn collect(folder: &Path, paths: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect(&path, paths);
        } else if path.extension().is_some_and(|extension| extension == "md") {
            paths.push(path);
        }
    }
}

//! Commands of the program as pages show them.

use crate::page::{Block, Page};

/// A line of a code block that calls the program.
pub struct Command {
    /// Where it stands, for messages.
    pub place: String,
    /// Its arguments.
    pub arguments: Vec<String>,
    /// What the page says that it prints, line by line; empty if the page does not say.
    pub output: Vec<String>,
}

impl Command {
    /// The sub-command.
    pub fn name(&self) -> &str {
        self.arguments.first().map_or("", String::as_str)
    }

    /// What stands behind every `--set`.
    pub fn settings(&self) -> Vec<&str> {
        let pairs = self.arguments.windows(2);
        pairs
            .filter(|pair| pair[0] == "--set")
            .map(|pair| pair[1].as_str())
            .collect()
    }

    /// The exit code that the page tells: 2 if it shows a mistake, 1 if it shows runs that differ.
    pub fn exit_code(&self) -> i32 {
        let is_difference = |line: &String| line.starts_with("error: the runs differ");
        let first = self.output.first();
        match first.is_some_and(|line| line.starts_with("error")) {
            true => 2,
            false => self.output.iter().any(is_difference).into(),
        }
    }
}

/// The commands of a page. What a command prints is the block of text that follows its block.
pub fn commands(page: &Page) -> Vec<Command> {
    let blocks = page.blocks();
    let mut commands: Vec<Command> = Vec::new();
    for (place, block) in blocks.iter().enumerate() {
        if block.language != "sh" {
            continue;
        }
        let output = match blocks.get(place + 1) {
            Some(next) if next.language == "text" => {
                next.lines.iter().map(|&line| line.to_owned()).collect()
            }
            _ => Vec::new(),
        };
        let found = of_block(page, block);
        let count = found.len();
        commands.extend(found.into_iter().enumerate().map(|(number, command)| {
            let is_last = number + 1 == count;
            let output = if is_last { output.clone() } else { Vec::new() };
            Command { output, ..command }
        }));
    }
    commands
}

/// The commands on shipped scenes that stand in the text of a page.
pub fn inline_commands(page: &Page) -> Vec<Command> {
    let mut paragraph = String::new();
    let mut paragraphs = Vec::new();
    for line in page.prose() {
        if line.text.trim().is_empty() {
            paragraphs.push(std::mem::take(&mut paragraph));
        } else {
            paragraph += line.text.trim();
            paragraph.push(' ');
        }
    }
    paragraphs.push(paragraph);
    let spans = paragraphs
        .iter()
        .flat_map(|text| text.split('`').skip(1).step_by(2));
    spans
        .filter(|span| span.starts_with("linchpin ") && span.contains(" scenes/"))
        .map(|span| Command {
            place: format!("{}: {span}", page.name()),
            arguments: words(span).split_off(1),
            output: Vec::new(),
        })
        .collect()
}

fn of_block(page: &Page, block: &Block) -> Vec<Command> {
    let mut commands = Vec::new();
    let mut begun = String::new();
    for (number, line) in (block.number..).zip(&block.lines) {
        if let Some(start) = line.strip_suffix('\\') {
            begun += start;
            continue;
        }
        let words = words(&(std::mem::take(&mut begun) + line));
        if let Some(arguments) = arguments(&words) {
            commands.push(Command {
                place: format!("{}:{number}", page.name()),
                arguments: arguments.to_vec(),
                output: Vec::new(),
            });
        }
    }
    commands
}

/// What the program gets, if the line calls it.
fn arguments(words: &[String]) -> Option<&[String]> {
    let is_for_the_shell = |word: &String| [">", "|", "&&"].contains(&word.as_str());
    let end = words.iter().position(is_for_the_shell);
    let words = &words[..end.unwrap_or(words.len())];
    match words {
        [program, arguments @ ..] if program == "linchpin" => Some(arguments),
        [cargo, run, .., _] if cargo == "cargo" && run == "run" => {
            let end = words.iter().position(|word| word == "--")?;
            let is_other = words[..end].iter().any(|word| word == "--example");
            (!is_other).then(|| &words[end + 1..])
        }
        _ => None,
    }
}

/// The words of a line as a shell sees them, without a comment at its end.
pub fn words(line: &str) -> Vec<String> {
    let mut words = Vec::new();
    let mut word: Option<String> = None;
    let mut quote = None;
    for letter in line.chars() {
        match (letter, quote) {
            ('\'' | '"', None) => {
                quote = Some(letter);
                word.get_or_insert_default();
            }
            (_, Some(open)) if letter == open => quote = None,
            (' ', None) => words.extend(word.take()),
            ('#', None) if word.is_none() => break,
            _ => word.get_or_insert_default().push(letter),
        }
    }
    words.extend(word);
    words
}

#[test]
fn lines_are_split_as_a_shell_does() {
    assert_eq!(
        words("linchpin run 'a b.toml' --set x=\"y z\"   # a comment"),
        ["linchpin", "run", "a b.toml", "--set", "x=y z"]
    );
}

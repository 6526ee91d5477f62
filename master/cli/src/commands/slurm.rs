//! A batch script for Slurm: every part of a study is a task of a job array.

/// The script; `words` is the command line that asks for it, the program first.
pub fn script(program: &str, words: &[String], name: &str, parts: usize) -> String {
    let command = command(program, words);
    format!(
        "#!/bin/bash
# {name} in {parts} parts. Submit it from this folder, and put the parts together when all have ended:
#
#   sbatch --wait FILE && {command} --merge {parts}
#
# A part that did not come to its end is made again with sbatch --array=NUMBER FILE.
#SBATCH --job-name={name}
#SBATCH --array=1-{parts}
#SBATCH --cpus-per-task=1

# As many threads as Slurm gives cores: sbatch --cpus-per-task=4 FILE.
export RAYON_NUM_THREADS=\"${{SLURM_CPUS_PER_TASK:-1}}\"
exec {command} --part \"$SLURM_ARRAY_TASK_ID/{parts}\"
"
    )
}

/// The command line without what asked for the script, for a shell.
fn command(program: &str, words: &[String]) -> String {
    let mut kept = vec![quoted(program)];
    let mut words = words.iter().skip(1);
    while let Some(word) = words.next() {
        if word == "--slurm" {
            words.next();
        } else if !word.starts_with("--slurm=") {
            kept.push(quoted(word));
        }
    }
    kept.join(" ")
}

/// A word as a shell reads it.
fn quoted(word: &str) -> String {
    let is_plain = |letter: char| letter.is_ascii_alphanumeric() || "-_./=:,+@%".contains(letter);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    if word.contains(char::is_control) {
        // On one line, since it also stands in a comment.
        let escaped = word.chars().map(|letter| match letter {
            '\\' | '\'' => format!("\\{letter}"),
            _ if letter.is_control() => format!("\\u{:04x}", u32::from(letter)),
            _ => letter.to_string(),
        });
        return format!("$'{}'", escaped.collect::<String>());
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_is_that_which_was_typed() {
        let typed = |words: &[&str]| {
            let words: Vec<String> = words.iter().map(ToString::to_string).collect();
            command("/opt/linchpin", &words)
        };
        let axis = "subsystem.*.parameters.c=1:2:5";
        assert_eq!(
            typed(&[
                "linchpin",
                "stability",
                "a.toml",
                "--slurm",
                "8",
                "--x",
                axis
            ]),
            "/opt/linchpin stability a.toml --x 'subsystem.*.parameters.c=1:2:5'"
        );
        assert_eq!(
            typed(&["linchpin", "converge", "--slurm=3", "it's here.toml", ""]),
            r"/opt/linchpin converge 'it'\''s here.toml' ''"
        );
        assert_eq!(
            typed(&["linchpin", "converge", "two\nit's\té"]),
            r"/opt/linchpin converge $'two\u000ait\'s\u0009é'"
        );
    }
}

//! What belongs to the shell: version, completions, manual pages, and how much is logged.

use linchpin_tests::process::Workshop;

use crate::typed;

/// All commands, by the help.
fn commands() -> Vec<String> {
    let help = typed(&["--help"]).stdout.clone();
    let (_, after) = help.split_once("Commands:\n").unwrap();
    let (list, _) = after.split_once("\n\n").unwrap();
    let names = list
        .lines()
        .filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    let names = names.map(|line| line.split_whitespace().next().unwrap().to_owned());
    names.filter(|name| name != "help").collect()
}

#[test]
fn the_version_tells_commit_and_protocol() {
    let short = typed(&["-V"]).stdout.clone();
    assert_eq!(short, format!("linchpin {}\n", env!("CARGO_PKG_VERSION")));
    let long = typed(&["--version"]).stdout.clone();
    let lines: Vec<&str> = long.lines().collect();
    assert_eq!(lines[0], short.trim_end());
    assert!(
        lines[1].starts_with("commit    ") && lines[1].len() > 16,
        "{long}"
    );
    assert_eq!(lines[2], "protocol  linchpin 1.4");
}

#[test]
fn every_shell_completes_every_command() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let outcome = typed(&["completions", shell]);
        outcome.succeeds();
        for command in commands() {
            assert!(outcome.stdout.contains(&command), "{shell}: {command}");
        }
    }
    typed(&["completions", "cmd"]).fails(2, &["cmd", "bash"]);
}

#[test]
fn every_command_has_a_manual_page() {
    let workshop = Workshop::new();
    workshop.run(&["man", "pages"]).succeeds();
    for command in commands() {
        let page = workshop.read(&format!("pages/linchpin-{command}.1"));
        assert!(page.contains(".SH SYNOPSIS"), "{command}");
    }
    assert!(workshop.read("pages/linchpin.1").contains("SIGTERM"));
    workshop.write("file", "");
    workshop
        .run(&["man", "file"])
        .fails(1, &["cannot write to file"]);
}

#[test]
fn more_of_v_is_more_of_the_log() {
    let workshop = Workshop::new();
    workshop.write(
        "scene.toml",
        include_str!("../../../scenes/oscillator.toml"),
    );
    let run = [
        "run",
        "scene.toml",
        "--in-process",
        "--no-plots",
        "--set",
        "scene.t_end=0.01",
    ];
    let logged = |more: &[&str]| {
        workshop
            .run(&[&run[..], more].concat())
            .stderr
            .lines()
            .count()
    };
    let counts = [&[][..], &["-v"], &["-vv"], &["-vvv"]].map(logged);
    assert!(
        counts[0] == 0 && counts.windows(2).all(|pair| pair[0] < pair[1]),
        "{counts:?}"
    );
    assert_eq!(logged(&["-v", "--log", "off"]), counts[1]);
}

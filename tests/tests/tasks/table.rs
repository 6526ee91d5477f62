//! The table of the ten tasks in the book.

use std::fs;

use linchpin_tests::evidence::{is_to_be_written, with_table};
use linchpin_tests::python::in_repository;
use linchpin_tests::tasks::{Task, tasks};

#[test]
fn table_of_the_tasks() {
    let table = table();
    println!("{table}");
    let path = in_repository("docs/guide/ten-tasks.md");
    let page = fs::read_to_string(&path).unwrap();
    let wanted = with_table(&page, "tasks", &table);
    if is_to_be_written() {
        fs::write(&path, &wanted).unwrap();
    } else {
        assert!(
            page == wanted,
            "write it with LINCHPIN_WRITE=1: cargo test --test tasks table_of_the_tasks"
        );
    }
}

fn table() -> String {
    let rows: Vec<String> = tasks().iter().map(row).collect();
    assert_eq!(rows.len(), 10);
    let head = "| task | page | commands | lines to write |\n|---|---|---|---|";
    format!("{head}\n{}", rows.join("\n"))
}

fn row(task: &Task) -> String {
    let (number, name) = task.name.split_once('-').unwrap();
    let name = name.replace('-', " ");
    let file = task.page.strip_prefix("docs/guide/").unwrap();
    let text = fs::read_to_string(in_repository(&task.page)).unwrap();
    let title = text.lines().next().unwrap().trim_start_matches("# ");
    let script = task.path.file_name().unwrap().display();
    format!(
        "| {number} [{name}](../../tests/tasks/{script}) | [{title}]({file}) | {} | {} |",
        task.commands.len(),
        task.lines()
    )
}

//! `linchpin export`.

use super::{DOUBLE_PENDULUM, OSCILLATOR, run};

const FOUR_BAR: &str = include_str!("../../../scenes/four-bar.toml");

/// What stands in the array of a name, or in the points.
fn numbers(file: &str, before: &str) -> Vec<f64> {
    let (_, rest) = file.split_once(before).unwrap();
    let (_, rest) = rest.split_once('>').unwrap();
    let text = rest.split('<').next().unwrap();
    text.split_whitespace()
        .map(|word| word.parse().unwrap())
        .collect()
}

#[test]
fn markers_are_points_over_time() {
    let workshop = run(FOUR_BAR, &["--animate"]);
    let outcome = workshop.run(&["export", "out", "--every", "7"]);
    outcome.succeeds();
    assert_eq!(outcome.stdout, "out/vtk/four-bar.pvd\n");
    let table = workshop.read("out/results.csv");
    let mut lines = table.lines();
    let columns: Vec<&str> = lines.next().unwrap().split(',').collect();
    let rows: Vec<Vec<f64>> = lines
        .map(|line| line.split(',').map(|own| own.parse().unwrap()).collect())
        .collect();
    let list = workshop.read("out/vtk/four-bar.pvd");
    let sets: Vec<&str> = list
        .lines()
        .filter(|line| line.contains("<DataSet"))
        .collect();
    let taken = (0..rows.len()).filter(|number| number % 7 == 0 || number + 1 == rows.len());
    let taken: Vec<usize> = taken.collect();
    assert_eq!(sets.len(), taken.len());
    for (number, (set, row)) in sets.iter().zip(&taken).enumerate() {
        let row = &rows[*row];
        assert!(set.contains(&format!("timestep=\"{}\"", row[0])), "{set}");
        let file = workshop.read(&format!("out/vtk/four-bar-{number}.vtp"));
        assert_eq!(
            numbers(
                &file,
                "Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\""
            ),
            [row[0]]
        );
        let points = numbers(&file, "NumberOfComponents=\"3\" format=\"ascii\"");
        let of = |name: &str| row[columns.iter().position(|own| *own == name).unwrap()];
        let crank = [of("crank.start_x"), of("crank.start_y"), 0.0];
        assert!(points.chunks(3).any(|point| point == crank), "{crank:?}");
        assert_eq!(points.len() % 3, 0);
        let bodies = numbers(&file, "Name=\"body\" format=\"ascii\"");
        assert_eq!(bodies.len(), points.len() / 3);
        // Lines go through two points or more, each of one body.
        let (_, of_lines) = file.split_once("<Lines>").unwrap();
        let places = numbers(of_lines, "Name=\"connectivity\" format=\"ascii\"");
        let offsets = numbers(of_lines, "Name=\"offsets\" format=\"ascii\"");
        let mut first = 0;
        for end in offsets {
            let line = &places[first..end as usize];
            assert!(
                line.len() > 1
                    && line
                        .iter()
                        .all(|own| bodies[*own as usize] == bodies[line[0] as usize])
            );
            first = end as usize;
        }
        assert_eq!(first, places.len());
    }
}

#[test]
fn what_has_no_place_is_told() {
    let workshop = run(DOUBLE_PENDULUM, &[]);
    workshop
        .run(&["export", "out", "--to", "elsewhere"])
        .succeeds();
    assert!(
        workshop
            .read("elsewhere/double-pendulum.pvd")
            .contains("double-pendulum-0.vtp")
    );
    workshop
        .run(&["export", "out", "--every", "0"])
        .fails(2, &["0"]);
    workshop.run(&["export", "nowhere"]).fails(2, &["nowhere"]);
    workshop.write("file", "");
    workshop
        .run(&["export", "out", "--to", "file"])
        .fails(1, &["cannot write to file"]);
    let motor =
        include_str!("../../../scenes/motor/driven-link.toml").replace("kind = \"slider\"", "");
    let motor = run(&motor, &[]);
    motor.run(&["export", "out"]).exits_with(0);
    let flat = run(OSCILLATOR, &[]);
    flat.run(&["export", "out"]).succeeds();
}

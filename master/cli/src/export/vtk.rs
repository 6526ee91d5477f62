//! Points and lines over time for ParaView: poly-data in the XML of VTK, as text, so that every program reads them.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use super::bodies::{Body, Point};
use crate::commands::CommandError;
use crate::files::write_text;

/// Writes poly-data of one time after the other, and the list of them at the end.
pub struct Series {
    folder: PathBuf,
    name: String,
    /// Times and names of the files.
    written: Vec<(f64, String)>,
}

impl Series {
    /// A series of files in a folder, `NAME.pvd` and `NAME-0.vtp` and so on.
    pub fn new(folder: &Path, name: &str) -> Self {
        Self {
            folder: folder.to_owned(),
            name: name.to_owned(),
            written: Vec::new(),
        }
    }

    /// Writes what bodies are at the time of a row.
    ///
    /// # Errors
    /// [`CommandError::Unwritable`]
    pub fn add(&mut self, bodies: &[Body], row: &[f64]) -> Result<(), CommandError> {
        let file = format!("{}-{}.vtp", self.name, self.written.len());
        write_text(&self.folder.join(&file), &poly_data(bodies, row))?;
        self.written.push((row[0], file));
        Ok(())
    }

    /// Writes the list; its path.
    ///
    /// # Errors
    /// [`CommandError::Unwritable`]
    pub fn finish(&self) -> Result<PathBuf, CommandError> {
        let path = self.folder.join(format!("{}.pvd", self.name));
        let sets = self.written.iter().map(|(t, file)| {
            format!("    <DataSet timestep=\"{t}\" part=\"0\" file=\"{file}\"/>\n")
        });
        let text = format!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  \
             <Collection>\n{}  </Collection>\n</VTKFile>\n",
            sets.collect::<String>()
        );
        write_text(&path, &text)?;
        Ok(path)
    }
}

/// The markers as points, with a line through those of every body that has several; `body` is the number of the subsystem.
fn poly_data(bodies: &[Body], row: &[f64]) -> String {
    let points: Vec<(usize, &Point)> = bodies
        .iter()
        .enumerate()
        .flat_map(|(number, body)| body.points.iter().map(move |point| (number, point)))
        .collect();
    let mut lines = (String::new(), String::new(), 0);
    let mut first = 0;
    let mut end = 0;
    for body in bodies {
        let count = body.points.len();
        if count > 1 {
            end += count;
            // Writing to a string does not fail, here and below.
            (first..first + count).for_each(|place| {
                let _ = write!(lines.0, "{place} ");
            });
            let _ = write!(lines.1, "{end} ");
            lines.2 += 1;
        }
        first += count;
    }
    let mut text = format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n  <PolyData>\n    \
         <FieldData><DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray></FieldData>\n    \
         <Piece NumberOfPoints=\"{count}\" NumberOfVerts=\"{count}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
        row[0],
        lines.2,
        count = points.len(),
    );
    text +=
        "      <Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n";
    for (_, point) in &points {
        let [x, y, z] = point.at(row);
        let _ = writeln!(text, "{x} {y} {z}");
    }
    text += "      </DataArray></Points>\n";
    let numbers = |of: &dyn Fn(usize) -> usize| -> String {
        (0..points.len())
            .map(|place| format!("{} ", of(place)))
            .collect()
    };
    let cells = |name: &str, connectivity: &str, offsets: &str| {
        format!(
            "      <{name}><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">{connectivity}</DataArray>\
             <DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">{offsets}</DataArray></{name}>\n"
        )
    };
    text += &cells(
        "Verts",
        &numbers(&|place| place),
        &numbers(&|place| place + 1),
    );
    text += &cells("Lines", &lines.0, &lines.1);
    let _ = writeln!(
        text,
        "      <PointData Scalars=\"body\"><DataArray type=\"Int64\" Name=\"body\" format=\"ascii\">{}</DataArray></PointData>\n    \
         </Piece>\n  </PolyData>\n</VTKFile>",
        numbers(&|place| points[place].0)
    );
    text
}

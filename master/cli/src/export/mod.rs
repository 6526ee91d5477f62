//! Results and scenes for other programs.
//!
//! * [`fmu`]: a scene as an FMU;
//! * [`bodies`]: markers of a run as points, by the columns of its table;
//! * [`vtk`]: points and lines over time for ParaView, a file for every shown time and a PVD file that lists them.

pub mod bodies;
pub mod fmu;
pub mod vtk;

//! What the picture of a run needs of its rows, in bounded memory.

use linchpin_master::scene::Panel;

use super::panels::{Layout, Shown};
use super::{Impacts, Rejections, ReportedColumn, Trace};

/// What is drawn of a run, and how.
#[derive(Debug, Clone)]
pub struct Plan<'a> {
    /// Start and end of the run (s).
    pub span: (f64, f64),
    /// By how much multipliers are shown earlier (s).
    pub multiplier_delay: f64,
    /// The panels that the scene asks for.
    pub panels: &'a [Panel],
    /// The columns of the table.
    pub columns: &'a [ReportedColumn],
    /// Places of the columns that are drawn in place of all that; absent: nothing was chosen.
    pub chosen: Option<&'a [usize]>,
}

/// Who has chosen what a picture shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ChosenBy {
    /// Nobody: it shows what is usual.
    Nobody,
    /// The scene, by its panels.
    Scene,
    /// Whoever asks for the picture.
    User,
}

/// Series and marks of a run.
#[derive(Debug, Clone)]
pub struct Recording {
    /// Name of the case of the scene, if it is one.
    pub case: Option<String>,
    /// Why the run did not come to its end, if it did not.
    pub reason: Option<String>,
    /// The panels, those without curves included.
    pub shown: Vec<Shown>,
    /// Who has chosen what they show.
    pub chosen_by: ChosenBy,
    /// Their curves.
    pub traces: Vec<Trace>,
    /// Impacts inside subsystems.
    pub impacts: Impacts,
    /// Macro steps that were repeated.
    pub rejections: Rejections,
    /// Start of the run (s).
    pub t_start: f64,
    /// By how much multipliers are shown earlier (s).
    pub multiplier_delay: f64,
}

impl Recording {
    /// Of a run without rows yet.
    pub fn new(plan: &Plan<'_>) -> Self {
        let (chosen_by, layout) = match (plan.chosen, plan.panels) {
            (Some(chosen), _) => {
                let layout = Layout::of_quantities(plan.columns, chosen);
                (ChosenBy::User, layout)
            }
            (None, []) => {
                let drawn = |place: &usize| plan.columns[*place].drawn;
                let drawn: Vec<usize> = (0..plan.columns.len()).filter(drawn).collect();
                let layout = Layout::of_quantities(plan.columns, &drawn);
                (ChosenBy::Nobody, layout)
            }
            (None, panels) => {
                let layout = Layout::of_panels(plan.columns, panels);
                (ChosenBy::Scene, layout)
            }
        };
        Self {
            case: None,
            reason: None,
            chosen_by,
            shown: layout.shown,
            traces: layout.traces,
            impacts: Impacts::of(plan.columns, plan.span),
            rejections: Rejections::of(plan.columns, plan.span),
            t_start: plan.span.0,
            multiplier_delay: plan.multiplier_delay,
        }
    }

    /// Takes the values of a row.
    pub fn record(&mut self, values: &[f64]) {
        for trace in &mut self.traces {
            trace.record(values);
        }
        self.impacts.record(values);
        self.rejections.record(values);
    }
}

//! Contacts inside subsystems, in the summary of a run.

use std::fmt::Write;

use linchpin_master::results::{ContactStatistics, Statistics};

/// Writes lines on every subsystem with contacts; what should not be is written as a warning.
pub fn write(statistics: &Statistics, text: &mut String) -> std::fmt::Result {
    for subsystem in &statistics.subsystems {
        if let Some(contacts) = &subsystem.contacts {
            write_impacts(&subsystem.subsystem, contacts, text)?;
            write_problems(contacts, text)?;
        }
    }
    Ok(())
}

fn write_impacts(name: &str, contacts: &ContactStatistics, text: &mut String) -> std::fmt::Result {
    write!(text, "  impacts of {name:<15} {:>6}", contacts.impacts)?;
    if let Some(first) = contacts.first_impact {
        write!(
            text,
            "   first at t = {first:.6e} s, impulses {:.4e} N s",
            contacts.impulse
        )?;
    }
    writeln!(text, "   penetration {:.1e} m", contacts.penetration)
}

fn write_problems(contacts: &ContactStatistics, text: &mut String) -> std::fmt::Result {
    writeln!(
        text,
        "    contact problems {}, residual at most {:.1e} m/s",
        contacts.problems, contacts.residual
    )?;
    if contacts.robust > 0 {
        writeln!(
            text,
            "    in {} of them the first solver failed and a robust one took over",
            contacts.robust
        )?;
    }
    if contacts.ambiguous > 0 {
        writeln!(
            text,
            "  WARNING: {} contact problems have several solutions (friction so high that contacts jam, Painleve): what the run \
             shows is one of several motions; lower the friction or soften the contact",
            contacts.ambiguous
        )?;
    }
    Ok(())
}

//! Contacts inside subsystems, in the summary of a run.

use std::fmt::Write;

use linchpin_master::results::{ContactStatistics, Statistics};
use linchpin_master::scene::{Joint, Scene, Side};

/// Writes lines on every subsystem with contacts; what should not be is written as a warning.
pub fn write(scene: &Scene, statistics: &Statistics, text: &mut String) -> std::fmt::Result {
    for subsystem in &statistics.subsystems {
        if let Some(contacts) = &subsystem.contacts {
            writeln!(
                text,
                "  contacts of {:<14} {:>6} problems, residual at most {:.1e} m/s",
                subsystem.subsystem, contacts.problems, contacts.residual
            )?;
            write_impacts(contacts, text)?;
            write_warnings(contacts, text)?;
            write_crossing(scene, &subsystem.subsystem, contacts, text)?;
        }
    }
    Ok(())
}

fn write_impacts(contacts: &ContactStatistics, text: &mut String) -> std::fmt::Result {
    if let Some(first) = contacts.first_impact {
        writeln!(
            text,
            "    impacts {}, the first at t = {first:.6e} s, impulses {:.4e} N s together",
            contacts.impacts, contacts.impulse
        )?;
    }
    if contacts.penetration > 0.0 {
        writeln!(
            text,
            "    penetration {:.1e} m at most",
            contacts.penetration
        )?;
    }
    Ok(())
}

fn write_warnings(contacts: &ContactStatistics, text: &mut String) -> std::fmt::Result {
    if contacts.robust > 0 {
        writeln!(
            text,
            "    in {} of the problems the first solver failed and a robust one took over",
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
    if contacts.jams > 0 {
        writeln!(
            text,
            "  WARNING: {} times a pressed contact jammed (Painleve): its force was that of an impact without collision, of \
             which the schemes model the stop of the slip at most; lower the friction",
            contacts.jams
        )?;
    }
    Ok(())
}

/// An impact is a jump for the partner behind a rigid joint, which coupling by forces alone does not see.
fn write_crossing(
    scene: &Scene,
    subsystem: &str,
    contacts: &ContactStatistics,
    text: &mut String,
) -> std::fmt::Result {
    if contacts.impacts == 0 || contacts.crosses_joints {
        return Ok(());
    }
    let is_own = |side: &Side| scene.subsystems[side.subsystem].name == subsystem;
    let holds = |joint: &&Joint| is_own(&joint.a) || is_own(&joint.b);
    for joint in scene.joints.iter().filter(holds) {
        writeln!(
            text,
            "  WARNING: {} impacts inside {subsystem} while the joint {} holds it: forces alone cross the joint, so that the partner's \
             velocity is wrong behind each of them; with coupling.impacts = \"impulses\" partners take part",
            contacts.impacts, joint.name
        )?;
    }
    Ok(())
}

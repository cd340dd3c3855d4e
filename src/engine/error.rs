//! The errors of a run that the engine cannot continue, and of a state that it cannot restore.

use crate::figures::plain;

/// A run that cannot be continued, or a state that cannot be restored. The message has the numbers and, of a run, the
/// remedy: the key of the scene to change.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EngineError {
    /// The motion has overflown. `contact` is the stiffest of those that were closed, the likeliest cause.
    #[error(
        "the motion exceeds what double precision can hold at t = {} s{}; check the units of masses, stiffnesses, \
         gaps and ground acceleration",
        plain(*.time),
        place(.contact)
    )]
    Overflow {
        /// s.
        time: f64,
        /// A contact, counted from 0, and its stiffness; none of a rigid one.
        contact: Option<(usize, Option<f64>)>,
    },
    /// A communication step that reaches far beyond the record.
    #[error(
        "a communication step from t = {} s to {} s is {segments:.1e} intervals after the record, as long as \
         between its samples, more than the {most:.1e} that one step may take: take smaller communication steps",
        plain(*.from),
        plain(*.until)
    )]
    TooManyIntervals {
        /// Where the communication step begins, s.
        from: f64,
        /// Where it was to end, s.
        until: f64,
        /// How many intervals it has.
        segments: f64,
        /// How many it may have.
        most: f64,
    },
    /// A communication step that takes more work than [`Model::limit_work`](super::Model::limit_work) allows.
    #[error("more work than one communication step may be: {0}")]
    TooMuchWork(GivenUp),
    /// Internal steps that have become shorter than the time can resolve.
    #[error("internal steps shorter than the time can resolve: {0}")]
    Stalled(GivenUp),
    /// A saved state that is none of this scene.
    #[error("not a state of this scene: {what}")]
    NotOfScene {
        /// What does not fit.
        what: &'static str,
    },
    /// A saved state in which a contact cannot be as it is.
    #[error("not a state of this scene: contact[{}] is in no state that its law has", .contact + 1)]
    ImpossibleContact {
        /// Counted from 0.
        contact: usize,
    },
    /// A saved state in which a storey that can yield cannot be as it is.
    #[error("not a state of this scene: storey {} of the {building} building is in no state that it can have", .storey + 1)]
    ImpossibleStorey {
        /// The name of its building.
        building: String,
        /// Counted from 0.
        storey: usize,
    },
    /// A saved state in which a link that slips cannot be as it is.
    #[error("not a state of this scene: link[{}] is in no state that it can have", .link + 1)]
    ImpossibleLink {
        /// Counted from 0.
        link: usize,
    },
}

/// A communication step that was given up, and what it had come to.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "given up at t = {} s, after {steps} internal steps ({in_contact} in contact, {}{impacts} impacts) since \
     t = {} s; {remedy}, or take smaller communication steps",
    plain(*.time),
    while_yielding(.yielding),
    plain(*.start)
)]
#[non_exhaustive]
pub struct GivenUp {
    /// Time that it had reached, s.
    pub time: f64,
    /// Time at which it began, s.
    pub start: f64,
    /// Number of internal steps.
    pub steps: u64,
    /// Number of those in contact.
    pub in_contact: u64,
    /// Number of those while a storey yields.
    pub yielding: u64,
    /// Number of impacts.
    pub impacts: u64,
    /// What to change in the scene, in words.
    pub remedy: String,
}

fn place(contact: &Option<(usize, Option<f64>)>) -> String {
    let Some((p, stiffness)) = contact else { return String::new() };
    let stiffness = stiffness.map_or(String::new(), |stiffness| format!(", whose stiffness is {stiffness:e}"));
    format!(" at contact[{}]{stiffness}", p + 1)
}

fn while_yielding(steps: &u64) -> String {
    if *steps > 0 { format!("{steps} while a storey yields, ") } else { String::new() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_of_any_size_can_be_read() {
        let given_up = GivenUp {
            time: 1.5e-140,
            start: 0.0,
            steps: 7,
            in_contact: 0,
            yielding: 0,
            impacts: 0,
            remedy: "a smaller stiffness".to_owned(),
        };
        let text = EngineError::Stalled(given_up).to_string();
        assert!(text.contains("given up at t = 1.5e-140 s") && text.contains("since t = 0 s; a smaller"), "{text}");
        let text = EngineError::TooManyIntervals { from: 0.0, until: 3e20, segments: 1e30, most: 1e8 }.to_string();
        assert!(text.contains("from t = 0 s to 3e20 s"), "{text}");
    }
}

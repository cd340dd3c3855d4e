//! Messages for the master, kept until the call is over: the logger is called when nothing of the instance is borrowed.

use crate::FmiVersion;
use crate::description::Category;
use std::mem;

/// One message for the master.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// Its category tells the status too.
    pub category: Category,
    /// Plain text.
    pub text: String,
}

/// The messages of the present call, in the enabled categories.
#[derive(Clone, Debug)]
pub struct Log {
    enabled: Vec<Category>,
    pending: Vec<Message>,
}

impl Log {
    /// Until the master chooses otherwise errors are always logged, and in FMI 2.0 warnings and why a call is discarded; all
    /// else only where it asks for it. FMI 3.0 forbids more than errors.
    pub fn new(version: FmiVersion, logging_on: bool) -> Log {
        let always = |category: &Category| match category {
            Category::StatusError | Category::StatusFatal => true,
            Category::StatusWarning | Category::StatusDiscard => version == FmiVersion::V2,
            Category::Events => false,
        };
        let enabled = Category::ALL.into_iter().filter(|category| logging_on || always(category)).collect();
        Log { enabled, pending: Vec::new() }
    }

    /// Logging on in these categories only, in all where none is named, or off.
    ///
    /// # Errors
    /// Every name that there is not; nothing is chosen then.
    pub fn choose(&mut self, on: bool, names: &[&str]) -> Result<(), Vec<String>> {
        let exists = |name: &&str| *name == Category::ALL_MESSAGES.0 || Category::ALL.iter().any(|c| c.name() == *name);
        let unknown = names.iter().filter(|name| !exists(name)).map(|name| {
            let known = Category::ALL.map(Category::name).join(", ");
            format!("log category {name:?}: expected one of {known}, {}", Category::ALL_MESSAGES.0)
        });
        let unknown = unknown.collect::<Vec<_>>();
        if !unknown.is_empty() {
            return Err(unknown);
        }
        let all = names.is_empty() || names.contains(&Category::ALL_MESSAGES.0);
        let chosen = |category: &Category| on && (all || names.contains(&category.name()));
        self.enabled = Category::ALL.into_iter().filter(chosen).collect();
        Ok(())
    }

    /// Whether messages of a category go anywhere.
    pub fn is_enabled(&self, category: Category) -> bool {
        self.enabled.contains(&category)
    }

    /// Adds a message, if its category is enabled.
    pub fn add(&mut self, category: Category, text: impl Into<String>) {
        if self.is_enabled(category) {
            self.pending.push(Message { category, text: text.into() });
        }
    }

    /// Whether there are messages.
    pub fn has_any(&self) -> bool {
        !self.pending.is_empty()
    }

    /// The messages so far; there are none afterwards.
    pub fn take(&mut self) -> Vec<Message> {
        mem::take(&mut self.pending)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn only_errors_are_logged_without_being_asked_for_in_fmi_3() {
        let log = Log::new(FmiVersion::V3, false);
        let enabled = Category::ALL.into_iter().filter(|&category| log.is_enabled(category));
        assert_eq!(enabled.collect::<Vec<_>>(), [Category::StatusError, Category::StatusFatal]);
    }

    #[test]
    fn warnings_and_errors_are_logged_without_being_asked_for_and_events_are_not() {
        let log = Log::new(FmiVersion::V2, false);
        assert!(log.is_enabled(Category::StatusWarning));
        assert!(log.is_enabled(Category::StatusError) && log.is_enabled(Category::StatusFatal));
        assert!(log.is_enabled(Category::StatusDiscard));
        assert!(!log.is_enabled(Category::Events));
        assert!(Category::ALL.iter().all(|&category| Log::new(FmiVersion::V2, true).is_enabled(category)));
    }

    #[test]
    fn only_the_chosen_categories_pass() {
        let mut log = Log::new(FmiVersion::V2, true);
        log.choose(true, &["logEvents"]).unwrap();
        log.add(Category::StatusError, "no");
        log.add(Category::Events, "yes");
        assert_eq!(log.take(), [Message { category: Category::Events, text: "yes".into() }]);
        assert!(log.take().is_empty());
        log.choose(false, &[]).unwrap();
        assert!(Category::ALL.iter().all(|&category| !log.is_enabled(category)));
        log.choose(true, &["logAll"]).unwrap();
        assert!(Category::ALL.iter().all(|&category| log.is_enabled(category)));
    }

    #[test]
    fn every_unknown_category_is_named_and_nothing_changes() {
        let mut log = Log::new(FmiVersion::V2, false);
        let problems = log.choose(true, &["logEvents", "logNonsense", "events"]).unwrap_err();
        assert_eq!(problems.len(), 2);
        assert!(problems[0].contains("logNonsense") && problems[0].contains("logStatusError"));
        assert!(!log.is_enabled(Category::Events));
    }
}

//! The master's logger.

use super::types::{ComponentEnvironment, Text};
use crate::FmiVersion;
use crate::description::Category;
use crate::slave::{Message, Status};
use std::ffi::{CStr, CString, c_int};
use std::sync::Arc;

/// `fmi2CallbackLogger`: environment, instance name, status, category, message as a `printf` format.
pub(in crate::fmi) type LoggerFunction = unsafe extern "C" fn(ComponentEnvironment, Text, c_int, Text, Text, ...);

/// `fmi3LogMessageCallback`: environment, status, category, message.
pub(in crate::fmi) type LogMessage = unsafe extern "C" fn(ComponentEnvironment, c_int, Text, Text);

/// The master's function, of the version of the instance.
#[derive(Clone, Debug)]
enum Callback {
    /// It gets the name of the instance back.
    V2(LoggerFunction, Arc<CStr>),
    V3(LogMessage),
}

/// The master's logger with what it wants to get back at each call.
#[derive(Clone, Debug)]
pub(in crate::fmi) struct Logger {
    callback: Option<Callback>,
    environment: ComponentEnvironment,
}

impl Logger {
    /// That of an instance of FMI 2.0.
    ///
    /// # Safety
    /// `function` must be callable with `environment` for as long as messages are sent.
    pub(in crate::fmi) unsafe fn v2(
        function: Option<LoggerFunction>,
        environment: ComponentEnvironment,
        name: &CStr,
    ) -> Logger {
        Logger { callback: function.map(|function| Callback::V2(function, name.into())), environment }
    }

    /// That of an instance of FMI 3.0.
    ///
    /// # Safety
    /// As for [`Logger::v2`].
    pub(in crate::fmi) unsafe fn v3(function: Option<LogMessage>, environment: ComponentEnvironment) -> Logger {
        Logger { callback: function.map(Callback::V3), environment }
    }

    /// Sends the messages. Nothing of the instance may be borrowed: the master may call back into the FMU.
    pub(in crate::fmi) fn send(&self, messages: &[Message]) {
        let Some(callback) = &self.callback else { return };
        for message in messages {
            let (category, status) = (c_string(message.category.name()), status(message.category) as c_int);
            match callback {
                Callback::V2(function, name) => {
                    let text = c_string(&escape(FmiVersion::V2, &message.text));
                    // SAFETY: the pointers live until the call returns, and the text is a format without any conversion.
                    unsafe { function(self.environment, name.as_ptr(), status, category.as_ptr(), text.as_ptr()) };
                }
                Callback::V3(function) => {
                    let text = c_string(&escape(FmiVersion::V3, &message.text));
                    // SAFETY: the pointers live until the call returns.
                    unsafe { function(self.environment, status, category.as_ptr(), text.as_ptr()) };
                }
            }
        }
    }
}

const fn status(category: Category) -> Status {
    match category {
        Category::Events => Status::Ok,
        Category::StatusWarning => Status::Warning,
        Category::StatusDiscard => Status::Discard,
        Category::StatusError => Status::Error,
        Category::StatusFatal => Status::Fatal,
    }
}

/// In both versions `#` introduces references to variables in a message, so it doubles. In FMI 2.0 the message is a `printf`
/// format too, so `%` doubles: finished text is what all masters can show, also those that cannot take the variable
/// arguments of C. In FMI 3.0 it is plain text, without a line break at its end.
fn escape(version: FmiVersion, text: &str) -> String {
    match version {
        FmiVersion::V2 => text.replace('%', "%%").replace('#', "##"),
        FmiVersion::V3 => text.trim_end_matches(['\n', '\r']).replace('#', "##"),
    }
}

/// Zeros cannot be passed on: they become blanks.
pub(super) fn c_string(text: &str) -> CString {
    CString::new(text.replace('\0', " ")).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_message_may_hold_depends_on_the_version() {
        assert_eq!(escape(FmiVersion::V2, "100% of #1#\n"), "100%% of ##1##\n");
        assert_eq!(escape(FmiVersion::V3, "100% of #1#\n"), "100% of ##1##");
    }
}

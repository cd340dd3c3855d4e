//! The master's logger.

use super::types::{ComponentEnvironment, LoggerFunction};
use crate::description::Category;
use crate::slave::{Message, Status};
use std::ffi::{CStr, CString};
use std::sync::Arc;

/// The master's logger with what it wants to get back at each call.
#[derive(Clone, Debug)]
pub(super) struct Logger {
    function: Option<LoggerFunction>,
    environment: ComponentEnvironment,
    instance_name: Arc<CStr>,
}

impl Logger {
    /// # Safety
    /// `function` must be callable with `environment` for as long as messages are sent.
    pub(super) unsafe fn new(
        function: Option<LoggerFunction>,
        environment: ComponentEnvironment,
        name: &CStr,
    ) -> Logger {
        Logger { function, environment, instance_name: name.into() }
    }

    /// Sends the messages. Nothing of the instance may be borrowed: the master may call back into the FMU.
    pub(super) fn send(&self, messages: &[Message]) {
        let Some(function) = self.function else { return };
        for message in messages {
            let (category, text) = (c_string(message.category.name()), c_string(&escape(&message.text)));
            let (name, status) = (self.instance_name.as_ptr(), status(message.category) as i32);
            // SAFETY: the pointers live until the call returns, and the text is a format without any conversion.
            unsafe { function(self.environment, name, status, category.as_ptr(), text.as_ptr()) };
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

/// The message is a `printf` format, and `#` introduces references to variables in it: both characters double. Finished
/// text is what all masters can show, also those that cannot take the variable arguments of C.
fn escape(text: &str) -> String {
    text.replace('%', "%%").replace('#', "##")
}

/// Zeros cannot be passed on: they become blanks.
pub(super) fn c_string(text: &str) -> CString {
    CString::new(text.replace('\0', " ")).unwrap_or_default()
}

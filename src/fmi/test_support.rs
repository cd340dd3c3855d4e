//! A component and what it logs, for the unit tests of this folder.
#![allow(clippy::unwrap_used)]

use super::instance::Instance;
use super::logger::Logger;
use super::types::{Component, ComponentEnvironment, LoggerFunction, Text};
use crate::FmiVersion;
use crate::description::Package;
use crate::scene::Scene;
use crate::slave::{Interface, Log, Slave};
use std::ffi::{CStr, c_int};
use std::mem;

/// A component with its own logger.
pub(super) struct Logged {
    pub component: Component,
    messages: *mut Vec<String>,
}

impl Logged {
    /// Two buildings of one floor without a contact.
    pub(super) fn new() -> Logged {
        let messages = Box::into_raw(Box::new(Vec::new()));
        // SAFETY: the logger has no variable arguments in any call, and a function without them takes such a call.
        let function = unsafe {
            mem::transmute::<unsafe extern "C" fn(ComponentEnvironment, Text, c_int, Text, Text), LoggerFunction>(note)
        };
        // SAFETY: the messages live as long as the component.
        let logger = unsafe { Logger::new(Some(function), messages.cast(), c"test") };
        let slave = Slave::new(package(), Interface::V2, Log::new(FmiVersion::V2, true));
        let instance = Instance { slave, logger, is_poisoned: false, strings: Vec::new() };
        Logged { component: Box::into_raw(Box::new(instance)).cast(), messages }
    }

    /// What has been logged.
    pub(super) fn messages(&self) -> &[String] {
        // SAFETY: alive, and nothing is being logged.
        unsafe { &*self.messages }
    }
}

impl Drop for Logged {
    fn drop(&mut self) {
        // SAFETY: both come from `Box::into_raw` in `new`.
        unsafe {
            super::instance::free(self.component);
            drop(Box::from_raw(self.messages));
        }
    }
}

unsafe extern "C" fn note(messages: ComponentEnvironment, _name: Text, _status: c_int, _category: Text, text: Text) {
    // SAFETY: the environment of `Logged::new`, and a string that ends with a zero.
    let (messages, text) = unsafe { (&mut *messages.cast::<Vec<String>>(), CStr::from_ptr(text)) };
    messages.push(text.to_string_lossy().into_owned());
}

fn package() -> Package {
    let building = "{ mass = [1.0], stiffness = [100.0], damping = { ratio = 0.0 } }";
    let scene_text = format!("name = \"Test\"\nleft = {building}\nright = {building}\n");
    let scene = Scene::from_toml(&scene_text).unwrap();
    Package { scene_text, scene, record: None }
}

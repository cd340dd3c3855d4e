//! A component and what it logs, for the unit tests of this folder.
#![allow(clippy::unwrap_used)]

use super::instance::Instance;
use super::logger::{Logger, LoggerFunction};
use super::types::{Component, ComponentEnvironment, Text};
use crate::FmiVersion;
use crate::description::Package;
use crate::scene::Scene;
use crate::slave::{Interface, Log, Slave};
use std::ffi::{CStr, c_int};
use std::mem;
use std::ptr;

/// A component with its own logger.
pub(super) struct Logged {
    pub component: Component,
    messages: *mut Vec<String>,
}

impl Logged {
    /// Two buildings of one floor without a contact.
    pub(super) fn new(interface: Interface) -> Logged {
        let messages = Box::into_raw(Box::new(Vec::new()));
        // SAFETY: the messages live as long as the component. The logger of FMI 2.0 has no variable arguments in any call,
        // and a function without them takes such a call.
        let logger = unsafe {
            match interface.version() {
                FmiVersion::V2 => {
                    Logger::v2(Some(mem::transmute::<Note, LoggerFunction>(note)), messages.cast(), c"test")
                }
                FmiVersion::V3 => Logger::v3(Some(note_text), messages.cast()),
            }
        };
        let slave = Slave::new(package(), interface, Log::new(interface.version(), true));
        let instance = Instance::new(slave, logger, None);
        Logged { component: Box::into_raw(Box::new(instance)).cast(), messages }
    }

    /// Leaves what remains without the component, which has been freed.
    pub(super) fn without_component(mut self) {
        self.component = ptr::null_mut();
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

type Note = unsafe extern "C" fn(ComponentEnvironment, Text, c_int, Text, Text);

unsafe extern "C" fn note(messages: ComponentEnvironment, _name: Text, status: c_int, category: Text, text: Text) {
    // SAFETY: the caller's promise.
    unsafe { note_text(messages, status, category, text) }
}

unsafe extern "C" fn note_text(messages: ComponentEnvironment, _status: c_int, _category: Text, text: Text) {
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

//! The environment of an instance: what arrives at the master's logger, and at its function for turns within steps.

use std::cell::RefCell;
use std::ffi::{CStr, c_char, c_int, c_void};

/// What arrives at the logger.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// The name of the instance, which FMI 3.0 does not pass.
    pub instance: Option<String>,
    pub status: c_int,
    pub category: String,
    pub message: String,
}

/// Messages, and what to do in the middle of one or in a turn.
#[derive(Default)]
pub struct Log {
    pub lines: RefCell<Vec<Line>>,
    pub call_back: RefCell<Option<Box<dyn FnMut()>>>,
    pub on_update: RefCell<Option<OnUpdate>>,
}

type OnUpdate = Box<dyn FnMut(Turn)>;

/// What a turn of the master in a step says about itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    pub time: f64,
    /// Inputs are asked for.
    pub sets: u8,
    /// Outputs can be read.
    pub gets: u8,
    pub is_finished: u8,
    pub can_return: u8,
}

impl Log {
    fn note(&self, line: Line) {
        self.lines.borrow_mut().push(line);
        if let Some(mut call_back) = self.call_back.take() {
            call_back();
        }
    }
}

pub fn environment(log: &Log) -> *mut c_void {
    std::ptr::from_ref(log).cast_mut().cast()
}

/// `fmi2CallbackLogger`, which is variadic in C; the FMU passes no variable arguments.
pub type Logger = unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char);
pub type Variadic = unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char, ...);

/// The environment that was given at instantiation is a log.
///
/// # Safety
///
/// It is, and the strings end with a zero.
unsafe fn read<'l, const N: usize>(environment: *mut c_void, texts: [*const c_char; N]) -> (&'l Log, [String; N]) {
    // SAFETY: the caller's contract.
    unsafe { (&*environment.cast(), texts.map(|text| CStr::from_ptr(text).to_str().unwrap().to_owned())) }
}

/// `fmi2CallbackLogger`
pub unsafe extern "C" fn note_2(
    environment: *mut c_void,
    instance: *const c_char,
    status: c_int,
    category: *const c_char,
    message: *const c_char,
) {
    // SAFETY: the environment that was given at instantiation, and strings that end with a zero.
    let (log, [instance, category, message]) = unsafe { read(environment, [instance, category, message]) };
    log.note(Line { instance: Some(instance), status, category, message });
}

/// `fmi3LogMessageCallback`
pub unsafe extern "C" fn note_3(
    environment: *mut c_void,
    status: c_int,
    category: *const c_char,
    message: *const c_char,
) {
    // SAFETY: as above.
    let (log, [category, message]) = unsafe { read(environment, [category, message]) };
    log.note(Line { instance: None, status, category, message });
}

/// `fmi3IntermediateUpdateCallback`; it asks to return early at once, which nothing may come of.
pub unsafe extern "C" fn update(
    environment: *mut c_void,
    time: f64,
    sets: u8,
    gets: u8,
    is_finished: u8,
    can_return: u8,
    requested: *mut u8,
    early_return_time: *mut f64,
) {
    // SAFETY: the environment that was given at instantiation, and places for two values.
    let log = unsafe {
        (*requested, *early_return_time) = (1, time);
        &*environment.cast::<Log>()
    };
    let mut on_update = log.on_update.take();
    if let Some(turn) = &mut on_update {
        turn(Turn { time, sets, gets, is_finished, can_return });
    }
    log.on_update.replace(on_update);
}

//! A live instance of either version; its methods are the functions of the standards.

use super::log::{Line, Log};
use super::{Common, Component, ERROR, Fmu, OK, Plain};
use pounding::FmiVersion;
use pounding::fmi::*;
use pounding::variables::Type;
use std::ffi::{CStr, CString, c_char, c_int};
use std::ptr::null;

pub struct Instance<'f> {
    pub fmu: &'f Fmu,
    pub component: Component,
    pub event_mode_used: bool,
    pub(super) log: Box<Log>,
}

impl Drop for Instance<'_> {
    fn drop(&mut self) {
        // SAFETY: alive, and not used afterwards.
        unsafe { (self.functions().free_instance)(self.component) }
    }
}

/// Messages.
impl Instance<'_> {
    /// The messages so far; there are none afterwards.
    pub fn log(&self) -> Vec<Line> {
        self.log.lines.take()
    }

    /// The only message so far, of an error.
    pub fn only_error(&self) -> String {
        let log = self.log();
        let [line] = &log[..] else { panic!("one message: {log:?}") };
        assert_eq!((line.status, line.category.as_str()), (ERROR, "logStatusError"));
        line.message.clone()
    }

    /// Does something in the middle of the next message.
    pub fn in_next_message(&self, call_back: impl FnMut() + 'static) {
        *self.log.call_back.borrow_mut() = Some(Box::new(call_back));
    }

    /// Log categories by name; none is all.
    pub fn set_debug_logging(&self, on: bool, categories: &[&str]) -> c_int {
        let texts = categories.iter().map(|text| CString::new(*text).unwrap()).collect::<Vec<_>>();
        let pointers = texts.iter().map(|text| text.as_ptr()).collect::<Vec<_>>();
        (self.functions().log)(self.component, on, &pointers)
    }
}

/// From one phase to the next.
impl Instance<'_> {
    pub fn functions(&self) -> &'static Common {
        Common::of(self.fmu.version)
    }

    /// A function that takes the instance alone.
    pub fn call(&self, function: Plain) -> c_int {
        // SAFETY: a live instance.
        unsafe { function(self.component) }
    }

    /// Calls that must go well.
    pub fn calls(&self, functions: &[Plain]) {
        for (i, function) in functions.iter().enumerate() {
            assert_eq!(self.call(*function), OK, "call {i}: {:?}", self.log());
        }
    }

    /// The call that says what the experiment is; FMI 3.0 enters initialization mode by it.
    pub fn set_up(&self, tolerance: Option<f64>, start: f64, stop: Option<f64>) -> c_int {
        let of = |value: Option<f64>| (value.is_some(), value.unwrap_or_default());
        let ((is_tolerance, tolerance), (is_stop, stop)) = (of(tolerance), of(stop));
        let c = self.component;
        // SAFETY: a live instance.
        unsafe {
            match self.fmu.version {
                FmiVersion::V2 => fmi2SetupExperiment(c, is_tolerance.into(), tolerance, start, is_stop.into(), stop),
                FmiVersion::V3 => {
                    fmi3EnterInitializationMode(c, is_tolerance.into(), tolerance, start, is_stop.into(), stop)
                }
            }
        }
    }

    /// To initialization mode, if all goes well.
    pub fn enter_from(&self, start: f64, stop: Option<f64>) -> c_int {
        let status = self.set_up(None, start, stop);
        match self.fmu.version {
            FmiVersion::V2 if status == OK => self.call(fmi2EnterInitializationMode),
            _ => status,
        }
    }

    /// To initialization mode, from 0 s.
    pub fn enter(&self) {
        assert_eq!(self.enter_from(0.0, None), OK, "{:?}", self.log());
    }

    pub fn exit(&self) -> c_int {
        self.call(self.functions().exit_initialization)
    }

    /// To what follows initialisation, at 0 s: with Event Mode this is Event Mode.
    pub fn initialize(&self) {
        self.enter();
        assert_eq!(self.exit(), OK, "{:?}", self.log());
    }

    /// To the first communication point, 0 s.
    pub fn start(&self) {
        self.start_at(0.0, None);
    }

    pub fn start_at(&self, start: f64, stop: Option<f64>) {
        assert_eq!(self.enter_from(start, stop), OK, "{:?}", self.log());
        self.go_on();
    }

    /// From initialization mode to the first communication point.
    pub fn go_on(&self) {
        assert_eq!(self.exit(), OK, "{:?}", self.log());
        if self.event_mode_used {
            assert_eq!(self.update(), (OK, [0; 5], 0.0));
            self.calls(&[fmi3EnterStepMode]);
        }
    }

    pub fn terminate(&self) -> c_int {
        self.call(self.functions().terminate)
    }

    pub fn reset(&self) -> c_int {
        self.call(self.functions().reset)
    }
}

/// Steps.
impl Instance<'_> {
    pub fn step(&self, current: f64, step: f64) -> c_int {
        match self.fmu.version {
            // SAFETY: a live instance.
            FmiVersion::V2 => unsafe { fmi2DoStep(self.component, current, step, 1) },
            FmiVersion::V3 => self.stepped(current, step).0,
        }
    }

    /// The time of the last step: FMI 2.0 tells it as a status, in FMI 3.0 it is a variable.
    pub fn time(&self) -> f64 {
        let mut time = f64::NAN;
        match self.fmu.version {
            // SAFETY: a live instance, and a place for the time.
            FmiVersion::V2 => assert_eq!(unsafe { fmi2GetRealStatus(self.component, 2, &mut time) }, OK),
            FmiVersion::V3 => time = self.real("time"),
        }
        time
    }

    /// Steps on from a communication point; the outputs after each step.
    pub fn run(&self, from: f64, step: f64, steps: u32) -> Vec<Vec<u64>> {
        (0..steps)
            .map(|k| {
                assert_eq!(self.step(from + f64::from(k) * step, step), OK, "{:?}", self.log());
                self.outputs()
            })
            .collect()
    }
}

type Got<T> = Result<Vec<T>, c_int>;

/// Values.
impl Instance<'_> {
    fn get<T: Clone>(&self, function: fn(Component, &[u32], &mut [T]) -> c_int, vr: &[u32], fill: T) -> Got<T> {
        let mut values = vec![fill; vr.len()];
        let status = function(self.component, vr, &mut values);
        if status == OK { Ok(values) } else { Err(status) }
    }

    pub fn reals(&self, vr: &[u32]) -> Got<f64> {
        self.get(self.functions().get_reals, vr, f64::NAN)
    }

    pub fn integers(&self, vr: &[u32]) -> Got<c_int> {
        self.get(self.functions().get_integers, vr, -1)
    }

    /// 0 or 1.
    pub fn booleans(&self, vr: &[u32]) -> Got<u8> {
        self.get(self.functions().get_booleans, vr, 77)
    }

    /// Strings of the FMU, which live until the next call.
    pub fn strings(&self, vr: &[u32]) -> Got<*const c_char> {
        self.get(self.functions().get_strings, vr, null())
    }

    pub fn real(&self, name: &str) -> f64 {
        let value = self.reals(&[self.fmu.vr(name)]);
        value.unwrap_or_else(|status| panic!("{name}: status {status}, {:?}", self.log()))[0]
    }

    pub fn integer(&self, name: &str) -> i32 {
        self.integers(&[self.fmu.vr(name)]).unwrap()[0]
    }

    pub fn boolean(&self, name: &str) -> u8 {
        self.booleans(&[self.fmu.vr(name)]).unwrap()[0]
    }

    pub fn string(&self, name: &str) -> String {
        let texts = self.strings(&[self.fmu.vr(name)]).unwrap();
        // SAFETY: a string of the FMU, which lives until the next call.
        unsafe { CStr::from_ptr(texts[0]) }.to_str().unwrap().to_owned()
    }

    pub fn set_reals(&self, vr: &[u32], values: &[f64]) -> c_int {
        (self.functions().set_reals)(self.component, vr, values)
    }

    pub fn set_real(&self, name: &str, value: f64) -> c_int {
        self.set_reals(&[self.fmu.vr(name)], &[value])
    }

    pub fn set_string(&self, name: &str, value: &str) -> c_int {
        self.set_strings(&[self.fmu.vr(name)], &[value])
    }

    pub fn set_strings(&self, vr: &[u32], values: &[&str]) -> c_int {
        let texts: Vec<CString> = values.iter().map(|value| CString::new(*value).unwrap()).collect();
        let values: Vec<*const c_char> = texts.iter().map(|text| text.as_ptr()).collect();
        (self.functions().set_strings)(self.component, vr, &values)
    }

    /// The bits of every output.
    pub fn outputs(&self) -> Vec<u64> {
        let reals = self.reals(&self.fmu.outputs(|ty| matches!(ty, Type::Real(_)))).unwrap();
        reals.into_iter().map(f64::to_bits).chain(self.discrete()).collect()
    }

    /// Every Integer and Boolean output.
    pub fn discrete(&self) -> Vec<u64> {
        let integers = self.integers(&self.fmu.outputs(|ty| ty == Type::Integer)).unwrap();
        let booleans = self.booleans(&self.fmu.outputs(|ty| ty == Type::Boolean)).unwrap();
        let integers = integers.into_iter().map(|value| u64::from(value.unsigned_abs()));
        integers.chain(booleans.into_iter().map(u64::from)).collect()
    }
}

/// Derivatives.
impl Instance<'_> {
    /// Sets a derivative of an input, which FMI 2.0 has alone.
    pub fn set_rate(&self, name: &str, order: c_int, rate: f64) -> c_int {
        // SAFETY: a live instance, one element each.
        unsafe { fmi2SetRealInputDerivatives(self.component, &self.fmu.vr(name), 1, &raw const order, &raw const rate) }
    }

    /// A derivative of an output with respect to time.
    pub fn rate(&self, name: &str, order: c_int) -> Result<f64, c_int> {
        let mut rate = [f64::NAN];
        let vr = [self.fmu.vr(name)];
        let status = (self.functions().output_derivatives)(self.component, &vr, &[order], &mut rate);
        if status == OK { Ok(rate[0]) } else { Err(status) }
    }

    pub fn directional(&self, unknowns: &[u32], knowns: &[u32], seed: &[f64]) -> Result<Vec<f64>, c_int> {
        let mut found = vec![f64::NAN; unknowns.len()];
        let status = (self.functions().directional)(self.component, unknowns, knowns, seed, &mut found);
        if status == OK { Ok(found) } else { Err(status) }
    }
}

//! Any bytes as a serialised state: refused, or harmless.
//!
//! The bytes are the body; the envelope around it is right, for a checksum would stop all that is random. The first byte
//! chooses the version of the standard and what a master of FMI 3.0 takes of events, or bytes without an envelope.

use crate::linked::*;
use pounding::FmiVersion;
use std::ffi::c_int;
use std::ptr::null_mut;
use std::sync::OnceLock;
use uuid::Uuid;

/// Motions above take the engine long to give up on; that is no matter of states.
const WILD: f64 = 1e9;

const SCENE: &str = r#"
name = "States"
[left]
mass = [2e4, 2e4]
height = [3.0, 3.0]
stiffness = [3e6, 3e6]
damping = { ratio = 0.05 }
initial_velocity = [0.2, 0.0]
[left.foundation]
mass = 1e4
inertia = 1e5
sway = { stiffness = 1e7, dashpot = 1e5 }
rocking = { stiffness = 3e8, dashpot = 1e6 }
[right]
mass = [3e4]
stiffness = [2e7]
damping = { ratio = 0.05 }
[inputs]
floor_forces = true
[outputs]
energy = true
[[contact]]
left_floor = 1
right_floor = 1
gap = 0.0
law = "jankowski"
stiffness = 1.0e7
restitution = 0.6
"#;

/// Parts of the envelope: up to the body's length, and the body's end.
const HEAD: usize = 36;
const CHECKSUM: usize = 16;

fn resources() -> &'static Resources {
    static RESOURCES: OnceLock<Resources> = OnceLock::new();
    RESOURCES.get_or_init(|| Resources::new(SCENE))
}

/// An instance of a version; in FMI 3.0 with or without Event Mode and early returns.
struct Instance {
    c: Component,
    /// Of FMI 3.0.
    flags: Option<[bool; 2]>,
}

impl Drop for Instance {
    fn drop(&mut self) {
        // SAFETY: alive, and not used afterwards.
        unsafe { (self.common().free_instance)(self.c) }
    }
}

impl Instance {
    /// At its first communication point; FMI 2.0 for 0, FMI 3.0 with two flags for the numbers above, and round again.
    fn started(which: u8) -> Instance {
        let flags = (which % 5).checked_sub(1).map(|flags| [flags & 1 != 0, flags & 2 != 0]);
        let c = match flags {
            None => resources().instantiate(),
            Some([event_mode, early]) => resources().instantiate_3(&Choices::flags(event_mode, early)),
        };
        let instance = Instance { c, flags };
        instance.start();
        instance
    }

    fn start(&self) {
        let c = self.c;
        // SAFETY: a live component.
        unsafe {
            if self.flags.is_none() {
                assert_eq!((fmi2EnterInitializationMode(c), fmi2ExitInitializationMode(c)), (OK, OK));
                return;
            }
            assert_eq!(fmi3EnterInitializationMode(c, 0, 0.0, 0.0, 0, 0.0), OK);
            assert_eq!(fmi3ExitInitializationMode(c), OK);
            if self.has_event_mode() {
                assert_eq!(fmi3EnterStepMode(c), OK);
            }
        }
    }

    fn has_event_mode(&self) -> bool {
        self.flags.is_some_and(|[event_mode, _]| event_mode)
    }

    fn common(&self) -> Common {
        if self.flags.is_none() { COMMON_2 } else { COMMON_3 }
    }

    /// A step of 4 ms.
    fn step(&self, time: f64) -> (c_int, Stepped) {
        if self.flags.is_none() {
            // SAFETY: a live component.
            let status = unsafe { fmi2DoStep(self.c, time, 0.004, 1) };
            return (status, Stepped { event: 0, terminate: 0, early: 0, last: time + 0.004 });
        }
        step(self.c, time, 0.004)
    }

    fn time(&self) -> Option<f64> {
        let (mut time, reference) = (f64::NAN, table().time_reference());
        // SAFETY: a live component, one element.
        let status = unsafe {
            if self.flags.is_none() {
                fmi2GetRealStatus(self.c, 2, &raw mut time)
            } else {
                fmi3GetFloat64(self.c, &raw const reference, 1, &raw mut time, 1)
            }
        };
        (status == OK).then_some(time)
    }

    /// All Real variables, as far as they can be read.
    fn reals(&self) -> Option<Vec<f64>> {
        let is_real = |ty| matches!(ty, pounding::variables::Type::Real(_));
        let reals: Vec<u32> = table().iter().filter(|(_, row)| is_real(row.ty)).map(|(vr, _)| vr).collect();
        let mut values = vec![0.0_f64; reals.len()];
        let (references, n, place) = (reals.as_ptr(), reals.len(), values.as_mut_ptr());
        // SAFETY: a live component, arrays of as many elements as the calls say.
        let status = unsafe {
            if self.flags.is_none() {
                fmi2GetReal(self.c, references, n, place)
            } else {
                fmi3GetFloat64(self.c, references, n, place, n)
            }
        };
        (status == OK).then_some(values)
    }

    fn bytes(&self, state: State) -> Vec<u8> {
        self.common().bytes(self.c, state)
    }

    /// What was taken in is what is given out, if it is written again.
    fn same_bytes(&self, state: State) {
        let (bytes, mut copy) = (self.bytes(state), null_mut());
        let Common { deserialize, free, .. } = self.common();
        // SAFETY: a live component, as many bytes as it says, and a place without a state.
        unsafe {
            assert_eq!(
                deserialize(self.c, bytes.as_ptr(), bytes.len(), &raw mut copy),
                OK,
                "its own bytes are refused"
            );
            assert_eq!(self.bytes(copy), bytes);
            assert_eq!(free(self.c, &raw mut copy), OK);
        }
    }

    /// Reads everything and takes a few steps, as far as the state that came out of the bytes lets that be done.
    fn go_on(&self) {
        for _ in 0..3 {
            let (Some(values), Some(time)) = (self.reals(), self.time()) else { return };
            if values.iter().any(|value| value.is_nan() || value.abs() > WILD) {
                return;
            }
            if self.has_event_mode() {
                // SAFETY: a live component. In which mode it is, its state says.
                unsafe {
                    let entered = [fmi3EnterEventMode(self.c), fmi3EnterStepMode(self.c)];
                    assert!(entered.iter().all(|status| [OK, ERROR].contains(status)), "{entered:?}");
                }
            }
            let (status, _) = self.step(time);
            assert!([OK, DISCARD, ERROR].contains(&status), "status {status}");
        }
    }
}

fn table() -> &'static pounding::variables::Table {
    static TABLE: OnceLock<pounding::variables::Table> = OnceLock::new();
    TABLE.get_or_init(|| pounding::variables::Table::new(&resources().package.scene))
}

/// Panics where a state does what it should not.
pub fn check(bytes: &[u8]) {
    let Some((first, body)) = bytes.split_first() else { return };
    let instance = Instance::started(*first);
    let (c, mut state) = (instance.c, null_mut());
    let bytes = if *first == 0xff { body.to_vec() } else { enveloped(instance.common().version, body) };
    let Common { deserialize, restore, free, reset, .. } = instance.common();
    // SAFETY: a live component, arrays of as many elements as the calls say.
    unsafe {
        let status = deserialize(c, bytes.as_ptr(), bytes.len(), &raw mut state);
        assert_eq!(status == OK, !state.is_null());
        assert!(status == OK || status == ERROR, "status {status}");
        if status == OK {
            instance.same_bytes(state);
            // Without Event Mode an event that waits is handled, and may be too much for the engine.
            let status = restore(c, state);
            assert!(status == OK || status == ERROR && !instance.has_event_mode(), "status {status}");
            instance.go_on();
            assert_eq!(free(c, &raw mut state), OK);
        }
        assert_eq!(reset(c), OK);
    }
    instance.start();
}

/// Panics where a seed does not come back as it is.
pub fn check_seed(seed: &[u8]) {
    let instance = Instance::started(seed[0]);
    let (bytes, mut state) = (enveloped(instance.common().version, &seed[1..]), null_mut());
    // SAFETY: a live component, as many bytes as it says, a place without a state.
    let status = unsafe { (instance.common().deserialize)(instance.c, bytes.as_ptr(), bytes.len(), &raw mut state) };
    assert_eq!(status, OK);
    assert!(instance.bytes(state) == bytes, "{:?}", instance.flags);
}

/// A whole state with this body.
fn enveloped(version: FmiVersion, body: &[u8]) -> Vec<u8> {
    let guid = resources().package.guid(version);
    let fingerprint = Uuid::parse_str(&guid).unwrap_or_default();
    let mut bytes = b"pounding\x0d\0\0\0".to_vec();
    bytes.extend_from_slice(fingerprint.as_bytes());
    bytes.extend_from_slice(&(body.len() as u64).to_le_bytes());
    bytes.extend_from_slice(body);
    let checksum = Uuid::new_v5(&fingerprint, &bytes);
    bytes.extend_from_slice(checksum.as_bytes());
    bytes
}

/// Inputs of [`check`]: the state of a run in flight, in contact, after it, and at its start, of all kinds of instances; in
/// FMI 3.0 where a step has ended at an event, which may wait, where discrete outputs are held, and in Event Mode.
pub fn seeds() -> Vec<Vec<u8>> {
    (0..5).flat_map(|which| [0, 1, 5, 40, 60].into_iter().flat_map(move |steps| seeds_of(which, steps))).collect()
}

fn seeds_of(which: u8, steps: u32) -> Vec<Vec<u8>> {
    let instance = Instance::started(which);
    let (mut time, mut has_event) = (0.0, false);
    let shows_events = instance.flags.is_some_and(|flags| flags != [false; 2]);
    for k in 0..1000 {
        if k >= steps && (has_event || steps == 0 || !shows_events) {
            break;
        }
        let (status, stepped) = instance.step(time);
        assert_eq!(status, OK);
        (time, has_event) = (stepped.last, stepped.event == 1 || stepped.early == 1);
    }
    assert_eq!(has_event, steps > 0 && shows_events, "{:?} after {steps} steps", instance.flags);
    let mut seeds = vec![instance.seed(which)];
    if instance.has_event_mode() {
        // SAFETY: a live component.
        assert_eq!(unsafe { fmi3EnterEventMode(instance.c) }, OK);
        seeds.push(instance.seed(which));
    }
    seeds
}

impl Instance {
    fn seed(&self, which: u8) -> Vec<u8> {
        let mut state = null_mut();
        // SAFETY: a live component, a place without a state.
        assert_eq!(unsafe { (self.common().record)(self.c, &raw mut state) }, OK);
        let bytes = self.bytes(state);
        let body = &bytes[HEAD..bytes.len() - CHECKSUM];
        assert_eq!(enveloped(self.common().version, body), bytes, "the envelope is the documented one");
        [&[which], body].concat()
    }
}

//! Any bytes as a serialised state: refused, or harmless.
//!
//! The bytes are the body; the envelope around it is right, for a checksum would stop all that is random. The first byte
//! chooses bytes without an envelope instead, now and then.

use crate::linked::*;
use std::ptr::null_mut;
use std::sync::OnceLock;
use uuid::Uuid;

/// Motions above take the engine long to give up on; that is no matter of states.
const WILD: f64 = 1e9;

const SCENE: &str = r#"
name = "States"
[left]
mass = [2e4, 2e4]
stiffness = [3e6, 3e6]
damping = { ratio = 0.05 }
initial_velocity = [0.2, 0.0]
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

/// An instance at its first communication point.
fn started() -> Component {
    let c = resources().instantiate();
    // SAFETY: a live component.
    unsafe {
        assert_eq!(fmi2EnterInitializationMode(c), OK);
        assert_eq!(fmi2ExitInitializationMode(c), OK);
    }
    c
}

/// Panics where a state does what it should not.
pub fn check(bytes: &[u8]) {
    let Some((first, body)) = bytes.split_first() else { return };
    let c = started();
    let mut state = null_mut();
    let bytes = if *first == 0xff { body.to_vec() } else { enveloped(body) };
    // SAFETY: a live component, arrays of as many elements as the calls say.
    unsafe {
        let status = fmi2DeSerializeFMUstate(c, bytes.as_ptr(), bytes.len(), &raw mut state);
        assert_eq!(status == OK, !state.is_null());
        assert!(status == OK || status == ERROR, "status {status}");
        if status == OK {
            assert_eq!(fmi2SetFMUstate(c, state), OK);
            same_bytes(c, state);
            go_on(c);
            assert_eq!(fmi2FreeFMUstate(c, &raw mut state), OK);
        }
        assert_eq!(fmi2Reset(c), OK);
        fmi2FreeInstance(c);
    }
}

/// What was taken in is what is given out, if it is written again.
unsafe fn same_bytes(c: Component, state: State) {
    let (mut size, mut copy) = (0, null_mut());
    // SAFETY: the caller's component, and room for as many bytes as it asks for.
    unsafe {
        assert_eq!(fmi2SerializedFMUstateSize(c, state, &raw mut size), OK);
        let mut bytes = vec![0; size];
        assert_eq!(fmi2SerializeFMUstate(c, state, bytes.as_mut_ptr(), size), OK);
        assert_eq!(fmi2DeSerializeFMUstate(c, bytes.as_ptr(), size, &raw mut copy), OK, "its own bytes are refused");
        assert_eq!(fmi2FreeFMUstate(c, &raw mut copy), OK);
    }
}

/// Reads everything and takes a few steps, as far as the state that came out of the bytes lets that be done.
unsafe fn go_on(c: Component) {
    let table = pounding::variables::Table::new(&resources().package.scene);
    let is_real = |ty| matches!(ty, pounding::variables::Type::Real(_));
    let reals: Vec<u32> = table.iter().filter(|(_, row)| is_real(row.ty)).map(|(vr, _)| vr).collect();
    let mut values = vec![0.0_f64; reals.len()];
    let mut time = f64::NAN;
    for _ in 0..3 {
        // SAFETY: the caller's component, arrays of as many elements as the calls say.
        let status = unsafe {
            if fmi2GetReal(c, reals.as_ptr(), reals.len(), values.as_mut_ptr()) != OK
                || values.iter().any(|value| value.is_nan() || value.abs() > WILD)
                || fmi2GetRealStatus(c, 2, &raw mut time) != OK
            {
                return;
            }
            fmi2DoStep(c, time, 0.004, 1)
        };
        assert!(status == OK || status == ERROR, "status {status}");
    }
}

/// A whole state with this body.
fn enveloped(body: &[u8]) -> Vec<u8> {
    let guid = resources().package.guid(pounding::FmiVersion::V2);
    let fingerprint = Uuid::parse_str(&guid).unwrap_or_default();
    let mut bytes = b"pounding\x08\0\0\0".to_vec();
    bytes.extend_from_slice(fingerprint.as_bytes());
    bytes.extend_from_slice(&(body.len() as u64).to_le_bytes());
    bytes.extend_from_slice(body);
    let checksum = Uuid::new_v5(&fingerprint, &bytes);
    bytes.extend_from_slice(checksum.as_bytes());
    bytes
}

/// Inputs of [`check`]: the state of a run in flight, in contact, after it, and at its start.
pub fn seeds() -> Vec<Vec<u8>> {
    let c = started();
    let seeds = [0, 1, 5, 40, 60].map(|steps| {
        let (mut state, mut size) = (null_mut(), 0);
        // SAFETY: a live component, room for as many bytes as it asks for.
        unsafe {
            assert_eq!(fmi2Reset(c), OK);
            assert_eq!(fmi2EnterInitializationMode(c), OK);
            assert_eq!(fmi2ExitInitializationMode(c), OK);
            for k in 0..steps {
                assert_eq!(fmi2DoStep(c, f64::from(k) * 0.004, 0.004, 1), OK);
            }
            assert_eq!(fmi2GetFMUstate(c, &raw mut state), OK);
            assert_eq!(fmi2SerializedFMUstateSize(c, state, &raw mut size), OK);
            let mut bytes = vec![0; size];
            assert_eq!(fmi2SerializeFMUstate(c, state, bytes.as_mut_ptr(), size), OK);
            let body = &bytes[HEAD..size - CHECKSUM];
            assert_eq!(enveloped(body), bytes, "the envelope is the documented one");
            [&[0], body].concat()
        }
    });
    // SAFETY: alive, and not used afterwards.
    unsafe { fmi2FreeInstance(c) };
    seeds.to_vec()
}

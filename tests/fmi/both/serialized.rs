//! Serialized states that are not what was written: each is refused, with what is wrong.

use crate::support::*;
use crate::v2::rollback::scene;

/// A state in mid-contact and one without any contact, as bytes.
fn small_states() -> Vec<(Fmu, Vec<u8>)> {
    let scenes = [scene("law = \"hertz\"\nstiffness = 1.0e8", true), NO_CONTACT.to_owned()];
    let state = |fmu: Fmu| {
        let instance = fmu.instance();
        instance.start();
        let has_contacts = fmu.description.variable_by_name("contact[1].force").is_ok();
        let mut k = 0;
        while k < 10 || has_contacts && instance.real("contact[2].force") == 0.0 {
            instance.run(f64::from(k) * 0.004, 0.004, 1);
            k += 1;
        }
        let bytes = instance.serialized(instance.recorded());
        drop(instance);
        (fmu, bytes)
    };
    scenes.iter().flat_map(|scene| Fmu::both(scene)).map(state).collect()
}

#[test]
fn every_single_byte_counts() {
    for (fmu, bytes) in small_states() {
        let instance = fmu.instance();
        for place in 0..bytes.len() {
            // Every bit of it, all of them, and the next number.
            let changes = (0..8).map(|bit| 1 << bit).chain([0xff, bytes[place] ^ bytes[place].wrapping_add(1)]);
            for change in changes {
                let mut altered = bytes.clone();
                altered[place] ^= change;
                let message = instance.refused(&altered);
                let expected = match place {
                    0..8 => "not a state of an FMU of this kind",
                    8..12 => "of another version: expected format 13",
                    12..28 => "a state of the FMU {",
                    28..36 => "damaged, ",
                    _ => "damaged, its checksum does not fit",
                };
                assert!(message.contains(expected), "byte {place}: {message}");
            }
        }
        assert_eq!(instance.set_state(instance.deserialized(&bytes)), OK);
    }
}

#[test]
fn nothing_may_be_missing_or_added() {
    for (fmu, bytes) in small_states() {
        let instance = fmu.instance();
        for length in 0..bytes.len() {
            assert!(instance.refused(&bytes[..length]).contains("damaged, "), "{length} bytes");
        }
        for more in [1, 2, 16, 1000] {
            for filling in [0, 1, 0xff] {
                let mut longer = bytes.clone();
                longer.resize(bytes.len() + more, filling);
                assert!(instance.refused(&longer).contains(&format!("{} bytes", longer.len())));
            }
        }
        let twice = [&bytes[..], &bytes[..]].concat();
        instance.refused(&twice);
        instance.refused(&bytes[1..]);
        let mut turned = bytes.clone();
        turned[36..].reverse();
        instance.refused(&turned);
        // A length that would be all of memory.
        let mut vast = bytes.clone();
        vast[28..36].fill(0xff);
        instance.refused(&vast);
    }
}

#[test]
fn a_state_of_another_fmu_is_named_as_such() {
    let (ones, others) = (Fmu::both(SCENE), Fmu::both(&SCENE.replace("gap = 0.002", "gap = 0.003")));
    for (one, other) in ones.iter().zip(&others) {
        let (from, to) = (one.instance(), other.instance());
        from.start();
        let message = to.refused(&from.serialized(from.recorded()));
        assert!(message.contains(&one.guid) && message.contains(&other.guid), "{message}");
    }
}

#[test]
fn refused_bytes_leave_the_instance_and_its_snapshots_as_they_were() {
    for fmu in Fmu::both(SCENE) {
        let instance = fmu.instance();
        instance.start();
        instance.run(0.0, 0.01, 10);
        let mut state: State = instance.recorded();
        let (before, mut bytes) = (state, instance.serialized(state));
        let outputs = instance.outputs();
        bytes[40] ^= 1;
        assert_ne!(instance.deserialize_from(bytes.as_ptr(), bytes.len(), &raw mut state), OK);
        assert_eq!(state, before);
        assert_eq!(instance.outputs(), outputs);
        assert_eq!(instance.set_state(state), OK);
        assert_eq!(instance.outputs(), outputs);
    }
}

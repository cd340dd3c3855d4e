//! States: recorded, restored, freed, and as bytes.

use super::edge::{edge, misaligned};
use super::rows::{Row, row};
use super::target::Target;
use crate::support::{OK, State, fmi2FreeFMUstate, fmi2GetFMUstate};
use std::ffi::c_int;
use std::ptr::{null, null_mut, without_provenance_mut};

/// Columns: instantiated, initialization, step complete, terminated, error, no instance.
const ALWAYS: &str = "oooooe";
const NEVER: &str = "eeeeee";

/// How a call comes by the pointer to a state.
type Source = fn(&Target<'_>) -> State;

/// Pointers that name no state of the instance, as far as they can be told.
const WRONG: [(&str, Source); 6] = [
    ("foreign", |_| without_provenance_mut(0xdead_beef)),
    ("odd", |_| without_provenance_mut(1)),
    ("of all ones", |_| without_provenance_mut(usize::MAX)),
    ("the component itself", |t| t.instance.component),
    ("freed", |t| {
        let state = t.instance.recorded();
        assert_eq!(t.instance.free_state(edge(&[state])), OK);
        state
    }),
    ("of another instance", |t| {
        let other = t.fmu.instance();
        let state = other.recorded();
        std::mem::forget(other); // alive until the process ends
        state
    }),
];

pub fn rows() -> Vec<Row> {
    let wrong = WRONG.into_iter().flat_map(|(what, source)| with_state(what, NEVER, source));
    let own = with_state("own", ALWAYS, |t| t.instance.recorded());
    wrong.chain(own).chain(null_states()).chain(serializing()).chain(bytes()).collect()
}

/// Each function that is given a state.
fn with_state(what: &str, expected: &'static str, state: Source) -> Vec<Row> {
    let name = |function: &str| format!("{function}: a state, {what}");
    vec![
        row(&name("fmi2GetFMUstate"), expected, move |t| t.of_place(fmi2GetFMUstate, edge(&[state(t)]))),
        row(&name("fmi2SetFMUstate"), expected, move |t| t.set_state(state(t))),
        row(&name("fmi2FreeFMUstate"), expected, move |t| t.of_place(fmi2FreeFMUstate, edge(&[state(t)]))),
        row(&name("fmi2SerializedFMUstateSize"), expected, move |t| t.size(state(t), edge(&[0]))),
        row(&name("fmi2SerializeFMUstate"), expected, move |t| {
            let size = own_bytes(t).len();
            t.serialize(state(t), edge(&vec![0; size]), size)
        }),
        row(&name("fmi2DeSerializeFMUstate"), expected, move |t| {
            let bytes = own_bytes(t);
            t.deserialize(edge(&bytes), bytes.len(), edge(&[state(t)]))
        }),
    ]
}

fn own_bytes(t: &Target<'_>) -> Vec<u8> {
    t.instance.serialized(t.instance.recorded())
}

fn null_states() -> Vec<Row> {
    vec![
        row("fmi2GetFMUstate: no place", NEVER, |t| t.of_place(fmi2GetFMUstate, null_mut())),
        row("fmi2GetFMUstate: a misaligned place", NEVER, |t| {
            t.of_place(fmi2GetFMUstate, misaligned::<usize>().cast())
        }),
        row("fmi2GetFMUstate: a place without a state", ALWAYS, |t| t.of_place(fmi2GetFMUstate, edge(&[null_mut()]))),
        row("fmi2GetFMUstate: a thousand times", ALWAYS, |t| {
            let record = |_| t.of_place(fmi2GetFMUstate, edge(&[null_mut()]));
            (0..1000).map(record).max().unwrap_or_default()
        }),
        row("fmi2SetFMUstate: null", NEVER, |t| t.set_state(null_mut())),
        row("fmi2FreeFMUstate: no place", ALWAYS, |t| t.of_place(fmi2FreeFMUstate, null_mut())),
        row("fmi2FreeFMUstate: a place without a state", ALWAYS, |t| t.of_place(fmi2FreeFMUstate, edge(&[null_mut()]))),
        row("fmi2FreeFMUstate: the same state from two places", NEVER, |t| {
            let state = t.instance.recorded();
            t.of_place(fmi2FreeFMUstate, edge(&[state]));
            t.of_place(fmi2FreeFMUstate, edge(&[state]))
        }),
        row("fmi2SerializedFMUstateSize: null", NEVER, |t| t.size(null_mut(), edge(&[0]))),
        row("fmi2SerializedFMUstateSize: no place", NEVER, |t| t.size(t.instance.recorded(), null_mut())),
        row("fmi2SerializeFMUstate: null", NEVER, |t| t.serialize(null_mut(), edge(&[0; 64]), 64)),
    ]
}

fn serializing() -> Vec<Row> {
    let name = |what: &str| format!("fmi2SerializeFMUstate: {what}");
    let size = |what: &str, change: fn(usize) -> usize| {
        row(&name(what), NEVER, move |t| {
            let state = t.instance.recorded();
            let size = change(t.instance.serialized(state).len());
            t.serialize(state, edge(&vec![0; size]), size)
        })
    };
    let mut rows = vec![
        size("one byte too few", |size| size - 1),
        size("one byte too many", |size| size + 1),
        size("a megabyte too many", |size| size + (1 << 20)),
        row(&name("nothing, null"), NEVER, |t| t.serialize(t.instance.recorded(), null_mut(), 0)),
        row(&name("null of the right size"), NEVER, |t| {
            let state = t.instance.recorded();
            t.serialize(state, null_mut(), t.instance.serialized(state).len())
        }),
    ];
    rows.extend([usize::MAX, usize::MAX / 2, 1 << 40].map(|size| {
        row(&name(&format!("{size} bytes")), NEVER, move |t| t.serialize(t.instance.recorded(), edge(&[0]), size))
    }));
    rows
}

fn bytes() -> Vec<Row> {
    let name = |what: &str| format!("fmi2DeSerializeFMUstate: {what}");
    let take = |t: &Target<'_>, bytes: &[u8]| -> c_int { t.deserialize(edge(bytes), bytes.len(), edge(&[null_mut()])) };
    let changed = |what: &str, change: fn(&mut Vec<u8>)| {
        row(&name(what), NEVER, move |t| {
            let mut bytes = own_bytes(t);
            change(&mut bytes);
            take(t, &bytes)
        })
    };
    let rubbish = |what: &str, bytes: &'static [u8]| row(&name(what), NEVER, move |t| take(t, bytes));
    let mut rows = vec![
        row(&name("own bytes"), ALWAYS, move |t| take(t, &own_bytes(t))),
        row(&name("bytes of another instance"), ALWAYS, move |t| {
            let other = t.fmu.instance();
            take(t, &other.serialized(other.recorded()))
        }),
        row(&name("nothing, null"), NEVER, |t| t.deserialize(null(), 0, edge(&[null_mut()]))),
        row(&name("null"), NEVER, |t| t.deserialize(null(), 64, edge(&[null_mut()]))),
        row(&name("no place"), NEVER, |t| {
            let bytes = own_bytes(t);
            t.deserialize(edge(&bytes), bytes.len(), null_mut())
        }),
        row(&name("a misaligned place"), NEVER, |t| {
            let bytes = own_bytes(t);
            t.deserialize(edge(&bytes), bytes.len(), misaligned::<usize>().cast())
        }),
        rubbish("one byte", b"p"),
        rubbish("zeros", &[0; 4096]),
        rubbish("ones", &[0xff; 4096]),
        rubbish("the magic alone", b"pounding"),
        changed("cut short", |bytes| bytes.truncate(bytes.len() - 1)),
        changed("half", |bytes| bytes.truncate(bytes.len() / 2)),
        changed("one byte more", |bytes| bytes.push(0)),
        changed("a bit turned in the middle", |bytes| bytes[100] ^= 1),
        changed("a length of everything", |bytes| bytes[28..36].fill(0xff)),
    ];
    rows.extend([usize::MAX, usize::MAX / 2, 1 << 40].map(|size| {
        row(&name(&format!("{size} bytes")), NEVER, move |t| t.deserialize(edge(&[0]), size, edge(&[null_mut()])))
    }));
    rows
}

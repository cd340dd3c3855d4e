//! The beginning and the end of an instance.

use super::rows::Case;
use super::target::{Phase, Target};
use crate::support::*;
use pounding::FmiVersion;
use std::ffi::{CStr, CString, c_char};

pub fn cases() -> Vec<Case> {
    let ends = Phase::all(FmiVersion::V2).iter().map(|&phase| {
        Case::new(format!("fmi2FreeInstance, in {phase:?}"), move |shared| {
            let target = Target::new(shared.fmu(FmiVersion::V2), phase);
            if phase == Phase::NoInstance {
                target.free();
            }
        })
    });
    beginnings().into_iter().chain(locations()).chain(ends).chain([versions()]).collect()
}

/// Whether `fmi2Instantiate` gives an instance if a good call is changed like this; a refusal has a message where there
/// is anyone to tell it to.
fn case(name: &str, gives_one: bool, change: impl Fn(&mut Arguments) + 'static) -> Case {
    Case::new(format!("fmi2Instantiate: {name}"), move |shared| {
        let fmu = shared.fmu(FmiVersion::V2);
        let mut arguments = Arguments::of(fmu);
        change(&mut arguments);
        let (instance, log) = fmu.instantiate(&arguments);
        assert_eq!(instance.is_some(), gives_one, "{log:?}");
        if let Some(instance) = instance {
            instance.start();
            instance.run(0.0, 0.1, 2);
        } else if arguments.with_callbacks && arguments.with_logger {
            assert!(!log.is_empty(), "refused without a message");
        }
    })
}

fn text(bytes: &[u8]) -> Option<CString> {
    Some(CString::new(bytes).unwrap())
}

fn beginnings() -> Vec<Case> {
    let name = |what: &str, gives_one, bytes: &'static [u8]| {
        case(&format!("instanceName {what}"), gives_one, move |a| a.name = text(bytes))
    };
    let guid =
        |what: &str, bytes: &'static [u8]| case(&format!("fmuGUID {what}"), false, move |a| a.guid = text(bytes));
    let kind = |kind, gives_one| case(&format!("fmuType {kind}"), gives_one, move |a| a.kind = kind);
    let logging = |on, gives_one| case(&format!("loggingOn {on}"), gives_one, move |a| a.logging_on = on);
    let megabyte: &'static [u8] = vec![b'n'; 1 << 20].leak();
    vec![
        case("null callbacks", false, |a| a.with_callbacks = false),
        case("null logger", true, |a| a.with_logger = false),
        case("null logger and a wrong GUID", false, |a| (a.with_logger, a.guid) = (false, text(b"{0}"))),
        case("everything null", false, |a| (a.name, a.guid, a.location) = (None, None, None)),
        case("instanceName null", false, |a| a.name = None),
        case("fmuGUID null", false, |a| a.guid = None),
        name("empty", false, b""),
        name("of a megabyte", true, megabyte),
        name("a path", true, b"/a path/to.fmu"),
        name("with conversions of printf", true, b"%s%n%9999999d#r1#"),
        guid("empty", b""),
        guid("of another FMU", b"{00000000-0000-0000-0000-000000000000}"),
        guid("no UTF-8", b"{\xff\xfe}"),
        guid("of a megabyte", megabyte),
        kind(0, false),
        kind(1, true),
        kind(2, false),
        kind(i32::MIN, false),
        logging(0, true),
        logging(1, true),
        logging(2, false),
        logging(-1, false),
    ]
}

fn locations() -> Vec<Case> {
    let location = |what: &str, bytes: &'static [u8]| {
        case(&format!("fmuResourceLocation {what}"), false, move |a| a.location = text(bytes))
    };
    let deep: &'static [u8] = format!("file:///{}", "a/".repeat(1 << 19)).into_bytes().leak();
    vec![
        case("fmuResourceLocation null", false, |a| a.location = None),
        location("empty", b""),
        location("a scheme alone", b"file:"),
        location("a host alone", b"file://"),
        location("the root", b"file:///"),
        location("of a megabyte", deep),
        location("with an escaped zero", b"file:///%00/resources"),
        location("of cut escapes", b"file:///%/%2/%zz"),
        location("no UTF-8", b"file:///\xff\xfe/resources"),
        location("on another machine", b"file://example.org/resources"),
        location("of another scheme", b"http://localhost/resources"),
        location("a device", b"file:///dev/zero"),
        location("a file", b"file:///proc/self/exe"),
        location("with conversions of printf", b"file:///%25s%25n/%s%n"),
    ]
}

fn versions() -> Case {
    Case::new("what version and platform there are".to_owned(), |_| {
        for (function, expected) in [
            (fmi2GetVersion as extern "C" fn() -> *const c_char, c"2.0"),
            (fmi2GetTypesPlatform, c"default"),
            (fmi3GetVersion, c"3.0"),
        ] {
            // SAFETY: a constant string.
            assert_eq!(unsafe { CStr::from_ptr(function()) }, expected);
        }
    })
}

//! The `fmuResourceLocation` that a master passes, as the file path that it means.
//!
//! Masters write it as `file:/x`, `file:///x`, `file://localhost/x` or `file:////x` or pass the plain path, with
//! percent escapes or with the characters themselves. Escapes stand for bytes: a path need not be UTF-8.
//!
//! On Windows a folder of another machine has a path too: `file://server/share/x` and `file:////server/share/x` are
//! `\\server\share\x`.

use percent_encoding::percent_decode;
use std::path::PathBuf;

/// The paths that a location may mean, the likeliest first; none if it points to another machine and has no path here.
pub(super) fn paths(location: &[u8]) -> Vec<PathBuf> {
    candidates(location, cfg!(windows)).into_iter().filter_map(|bytes| to_path(&bytes)).collect()
}

/// The bytes of the paths, as Windows or everybody else reads them.
fn candidates(location: &[u8], windows: bool) -> Vec<Vec<u8>> {
    let (is_uri, path) = match strip_scheme(location) {
        Some(path) if windows => (true, path_on_windows(&with_slashes(path))),
        Some(path) => (true, local_path(path)),
        None => (false, Some(location.to_vec())),
    };
    let Some(verbatim) = path else { return Vec::new() };
    let decoded = percent_decode(&verbatim).collect::<Vec<u8>>();
    let mut candidates = if is_uri { vec![decoded, verbatim] } else { vec![verbatim, decoded] };
    candidates.dedup();
    candidates
}

fn strip_scheme(location: &[u8]) -> Option<&[u8]> {
    let (scheme, rest) = location.split_at_checked(b"file:".len())?;
    scheme.eq_ignore_ascii_case(b"file:").then_some(rest)
}

/// What stands behind the scheme, as a path with at most one leading slash.
fn local_path(rest: &[u8]) -> Option<Vec<u8>> {
    let (host, path) = host_and_path(rest);
    // file://C:/x: a slash too few, seen in the wild.
    let path = if is_drive(host) { &rest[b"//".len()..] } else { path };
    (is_this_machine(host) || is_drive(host)).then(|| path[leading_slashes(path).saturating_sub(1)..].to_vec())
}

/// The same on Windows: /C:/x is the drive C, and what belongs to a server is `\\server\share\x`.
fn path_on_windows(rest: &[u8]) -> Option<Vec<u8>> {
    let (host, path) = host_and_path(rest);
    let behind = &path[leading_slashes(path)..];
    if !is_this_machine(host) && !is_drive(host) {
        return (!behind.is_empty()).then(|| on_server(&rest[b"//".len()..]));
    }
    if is_this_machine(host) && leading_slashes(path) > 1 && !is_drive(behind) {
        return Some(on_server(behind));
    }
    let path = local_path(rest)?;
    Some(path.strip_prefix(b"/").filter(|drive| is_drive(drive)).unwrap_or(&path).to_vec())
}

/// `server/share/x` as Windows writes it.
fn on_server(path: &[u8]) -> Vec<u8> {
    let backslashes = path.iter().map(|&byte| if byte == b'/' { b'\\' } else { byte });
    br"\\".iter().copied().chain(backslashes).collect()
}

/// Backslashes separate on Windows, in what masters write behind `file:` too.
fn with_slashes(path: &[u8]) -> Vec<u8> {
    path.iter().map(|&byte| if byte == b'\\' { b'/' } else { byte }).collect()
}

/// The two parts of `//host/path`; without the two slashes everything is path.
fn host_and_path(rest: &[u8]) -> (&[u8], &[u8]) {
    let Some(after) = rest.strip_prefix(b"//") else { return (&[], rest) };
    after.split_at(after.iter().position(|&byte| byte == b'/').unwrap_or(after.len()))
}

fn leading_slashes(path: &[u8]) -> usize {
    path.iter().take_while(|&&byte| byte == b'/').count()
}

fn is_this_machine(host: &[u8]) -> bool {
    host.is_empty() || host.eq_ignore_ascii_case(b"localhost")
}

/// Starts with a drive letter and a colon, which may be escaped.
fn is_drive(path: &[u8]) -> bool {
    match path {
        [letter, b':', ..] | [letter, b'%', b'3', b'A' | b'a', ..] => letter.is_ascii_alphabetic(),
        _ => false,
    }
}

#[cfg(unix)]
fn to_path(bytes: &[u8]) -> Option<PathBuf> {
    use std::os::unix::ffi::OsStrExt;
    Some(PathBuf::from(std::ffi::OsStr::from_bytes(bytes)))
}

#[cfg(not(unix))]
fn to_path(bytes: &[u8]) -> Option<PathBuf> {
    std::str::from_utf8(bytes).ok().map(PathBuf::from)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn first(location: &str) -> Option<PathBuf> {
        paths(location.as_bytes()).into_iter().next()
    }

    #[cfg(unix)]
    #[test]
    fn every_way_to_write_a_local_directory() {
        for location in [
            "file:/tmp/a%20b/resources",
            "file:///tmp/a%20b/resources",
            "file://localhost/tmp/a%20b/resources",
            "file://LOCALHOST/tmp/a%20b/resources",
            "file:////tmp/a%20b/resources",
            "FILE:///tmp/a%20b/resources",
            "file:///tmp/a b/resources",
            "/tmp/a b/resources",
        ] {
            // As text: paths are equal whatever their number of slashes.
            assert_eq!(first(location).unwrap_or_default().to_str(), Some("/tmp/a b/resources"), "{location}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn escapes_are_bytes_and_what_is_no_escape_stays() {
        use std::os::unix::ffi::OsStrExt;
        let path = first("file:///tmp/%FF%e4/100%/%zz").unwrap_or_default();
        assert_eq!(path.as_os_str().as_bytes(), b"/tmp/\xff\xe4/100%/%zz");
    }

    #[cfg(unix)]
    #[test]
    fn the_other_reading_comes_second() {
        let both = |location: &str| paths(location.as_bytes());
        assert_eq!(both("file:///a%20b"), [PathBuf::from("/a b"), PathBuf::from("/a%20b")]);
        assert_eq!(both("/a%20b"), [PathBuf::from("/a%20b"), PathBuf::from("/a b")]);
        assert_eq!(both("/ab"), [PathBuf::from("/ab")]);
    }

    #[cfg(not(windows))]
    #[test]
    fn another_machine_is_none() {
        assert_eq!(first("file://server/share/resources"), None);
    }

    #[cfg(windows)]
    #[test]
    fn drives_and_servers() {
        for location in ["file:///C:/x y", "file:/C:/x%20y", "file:///C%3A/x%20y", "file://C:/x y", "C:/x y"] {
            assert_eq!(first(location), Some(PathBuf::from("C:/x y")), "{location}");
        }
        for location in ["file://server/share/x%20y", "file:////server/share/x y", r"\\server\share\x y"] {
            assert_eq!(first(location), Some(PathBuf::from(r"\\server\share\x y")), "{location}");
        }
    }

    fn read(location: &str, windows: bool) -> Option<String> {
        candidates(location.as_bytes(), windows).first().map(|bytes| String::from_utf8_lossy(bytes).into_owned())
    }

    #[test]
    fn on_windows_a_server_has_a_path() {
        for location in [
            "file://server/share/a%20b/resources",
            "FILE://server/share/a b/resources",
            "file:////server/share/a%20b/resources",
            "file://localhost//server/share/a%20b/resources",
            "file://///server/share/a%20b/resources",
            r"file:\\server\share\a b\resources",
            r"file:///\\server\share\a b\resources",
            r"\\server\share\a b\resources",
        ] {
            assert_eq!(read(location, true).as_deref(), Some(r"\\server\share\a b\resources"), "{location}");
        }
        for (location, path) in [
            ("file://my%2Dserver/share/100%25", r"\\my-server\share\100%"),
            ("file://192.168.0.1/share/x", r"\\192.168.0.1\share\x"),
            ("file:////server/C$/x", r"\\server\C$\x"),
            ("file:////?/C:/x", r"\\?\C:\x"),
            (r"\\?\C:\x", r"\\?\C:\x"),
        ] {
            assert_eq!(read(location, true).as_deref(), Some(path), "{location}");
        }
    }

    #[test]
    fn on_windows_drives_stay_drives() {
        for location in [
            "file:C:/x y",
            "file:/C:/x%20y",
            "file://C:/x y",
            "file:///C:/x%20y",
            "file:////C:/x%20y",
            "file://localhost/C:/x%20y",
            r"file:///C:\x y",
            "file:///C%3A/x%20y",
            "C:/x y",
        ] {
            assert_eq!(read(location, true).as_deref(), Some("C:/x y"), "{location}");
        }
    }

    #[test]
    fn a_server_without_a_share_has_no_path() {
        for location in ["file://server", "file://server/", "file://server//"] {
            assert_eq!(read(location, true), None, "{location}");
        }
    }

    #[test]
    fn elsewhere_servers_have_no_path_and_drives_are_plain_names() {
        for (location, path) in [
            ("file://server/share/x", None),
            ("file:////server/share/x", Some("/server/share/x")),
            (r"file:\\server\share\x", Some(r"\\server\share\x")),
            ("file:///C:/x", Some("/C:/x")),
            ("file://C:/x", Some("C:/x")),
        ] {
            assert_eq!(read(location, false).as_deref(), path, "{location}");
        }
    }
}

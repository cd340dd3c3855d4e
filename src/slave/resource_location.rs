//! The `fmuResourceLocation` that a master passes, as the file path that it means.
//!
//! Masters write it as `file:/x`, `file:///x`, `file://localhost/x` or `file:////x` or pass the plain path, with
//! percent escapes or with the characters themselves. Escapes stand for bytes: a path need not be UTF-8.

use percent_encoding::percent_decode;
use std::path::PathBuf;

/// The paths that a location may mean, the likeliest first; none if it points to another machine.
pub fn paths(location: &[u8]) -> Vec<PathBuf> {
    let (is_uri, path) = match strip_scheme(location) {
        Some(path) => (true, local_path(path)),
        None => (false, Some(location.to_vec())),
    };
    let Some(verbatim) = path else { return Vec::new() };
    let decoded = percent_decode(&verbatim).collect::<Vec<u8>>();
    let mut candidates = if is_uri { vec![decoded, verbatim] } else { vec![verbatim, decoded] };
    candidates.dedup();
    candidates.into_iter().filter_map(|bytes| to_path(&bytes)).collect()
}

fn strip_scheme(location: &[u8]) -> Option<&[u8]> {
    let (scheme, rest) = location.split_at_checked(b"file:".len())?;
    scheme.eq_ignore_ascii_case(b"file:").then_some(rest)
}

/// What stands behind the scheme, as a path with at most one leading slash.
fn local_path(rest: &[u8]) -> Option<Vec<u8>> {
    let path = match rest.strip_prefix(b"//") {
        None => rest,
        Some(after) => {
            let end_of_host = after.iter().position(|&byte| byte == b'/').unwrap_or(after.len());
            let (host, path) = after.split_at(end_of_host);
            let is_local = host.is_empty() || host.eq_ignore_ascii_case(b"localhost");
            match (is_local, is_drive(host)) {
                (true, _) => path,
                (false, true) => after, // file://C:/x: a slash too few, seen in the wild
                (false, false) => return None,
            }
        }
    };
    let slashes = path.iter().take_while(|&&byte| byte == b'/').count();
    let path = &path[slashes.saturating_sub(1)..];
    // /C:/x is the drive C on Windows. Elsewhere it stays what it says.
    let drive = path.strip_prefix(b"/").filter(|drive| cfg!(windows) && is_drive(drive));
    Some(drive.unwrap_or(path).to_vec())
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

    #[test]
    fn another_machine_is_none() {
        assert_eq!(first("file://server/share/resources"), None);
    }

    #[cfg(windows)]
    #[test]
    fn drives() {
        for location in ["file:///C:/x y", "file:/C:/x%20y", "file:///C%3A/x%20y", "file://C:/x y", "C:/x y"] {
            assert_eq!(first(location), Some(PathBuf::from("C:/x y")), "{location}");
        }
    }

    #[cfg(not(windows))]
    #[test]
    fn drives_are_plain_names_elsewhere() {
        assert_eq!(first("file:///C:/x"), Some(PathBuf::from("/C:/x")));
    }
}

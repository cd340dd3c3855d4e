//! Formats that are known and not read: told by their first lines, with the way to what can be read.

/// Lines that are looked at.
const LINES: usize = 20;

/// What a file is, and what to do.
pub(super) fn told(text: &str) -> Option<&'static str> {
    let first = text.lines().next().unwrap_or_default().to_ascii_lowercase();
    if first.starts_with("response and fourier amplitude spectra") {
        return Some("CSMIP volume 3, spectra: expected the accelerogram, in the file of the volume 2 or 1 beside it");
    }
    let has = |line: &str, words: [&str; 2]| words.iter().all(|word| line.contains(word));
    let is_usace = text.lines().take(LINES).any(|line| has(line, ["NO OF POINTS=", "UNITS=CM/SEC**2, CM/SEC, AND CM"]));
    is_usace.then_some(
        "USACE, acceleration, velocity and displacement one after the other: expected the acceleration only, as many numbers \
         as NO OF POINTS says, with step = ... and unit = \"cm/s2\"",
    )
}

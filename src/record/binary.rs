//! Files that are no text: told by their first bytes, with the way to one that can be read.

/// What a file is that begins with certain bytes, and what to do with it.
const BEGINNINGS: [(&[u8], &str); 5] = [
    (b"PK\x03\x04", "an archive or a workbook: expected the file in it, or the sheet saved as CSV"),
    (b"\xd0\xcf\x11\xe0", "a workbook: expected the sheet saved as CSV"),
    (b"\x1f\x8b", "compressed by gzip: expected the file in it"),
    (b"\x89HDF\r\n\x1a\n", "HDF5, a format without one layout: expected its samples saved as CSV, time_s,accel_m_s2"),
    (b"%PDF", "a PDF: expected the numbers as text"),
];

/// What a file is that no reader of text can take, and what to do.
pub(super) fn told(bytes: &[u8]) -> Option<String> {
    if let Some((_, told)) = BEGINNINGS.iter().find(|(begin, _)| bytes.starts_with(begin)) {
        return Some((*told).to_owned());
    }
    let format = if is_miniseed(bytes) {
        "miniSEED"
    } else if is_sac(bytes) {
        "SAC"
    } else {
        return None;
    };
    // Counts need the instrument's response, which the file does not hold.
    Some(format!(
        "{format}, a binary format whose numbers may be counts: convert it with ObsPy, trace = obspy.read(FILE)[0], after \
         trace.remove_response(inventory, output=\"ACC\") where they are: numpy.savetxt(OUT, numpy.c_[trace.times(), trace.data], \
         delimiter=\",\", header=\"time_s,accel_m_s2\", comments=\"\")"
    ))
}

/// A sequence number of six digits, the quality of the data and a blank, or the two letters of version 3.
fn is_miniseed(bytes: &[u8]) -> bool {
    let is_second = bytes.get(..8).is_some_and(|head| {
        head[..6].iter().all(|byte| byte.is_ascii_digit() || *byte == b' ')
            && b"DRQMVASTI".contains(&head[6])
            && head[7] == b' '
    });
    is_second && bytes.len() >= 48 && bytes.contains(&0) || bytes.starts_with(b"MS\x03")
}

/// Number 76 of its header of 158 words of four bytes is its version, 6 or 7, in either order of bytes.
fn is_sac(bytes: &[u8]) -> bool {
    const HEADER: usize = 632;
    const VERSION: usize = 4 * 76;
    let word = bytes.get(VERSION..VERSION + 4).filter(|_| bytes.len() >= HEADER);
    word.is_some_and(|word| matches!(word, [0, 0, 0, 6 | 7] | [6 | 7, 0, 0, 0]))
}

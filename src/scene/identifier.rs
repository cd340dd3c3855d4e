//! Names that may stand for a C identifier, as FMI wants of a model.

/// Keywords of C11 and C23, set apart by blanks.
const KEYWORDS: &str = "\
    alignas alignof auto bool break case char const constexpr continue default do double else enum extern false \
    float for goto if inline int long nullptr register restrict return short signed sizeof static static_assert \
    struct switch thread_local true typedef typeof typeof_unqual union unsigned void volatile while _Alignas \
    _Alignof _Atomic _BitInt _Bool _Complex _Decimal128 _Decimal32 _Decimal64 _Generic _Imaginary _Noreturn \
    _Static_assert _Thread_local";

/// The name is part of file names, with extensions and by some importers with prefixes: file systems end at 255 bytes.
const LONGEST: usize = 128;

/// Says what was expected where the name is no C identifier, or too long for the name of a file.
pub(super) fn check(name: &str) -> Result<(), &'static str> {
    let starts_well = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    if !starts_well || !name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') {
        return Err("a C identifier: letters, digits and _, no digit first");
    }
    if name.len() > LONGEST {
        return Err("a C identifier of at most 128 characters");
    }
    if KEYWORDS.split(' ').any(|keyword| keyword == name) {
        return Err("a C identifier that is not a keyword of C");
    }
    Ok(())
}

//! Text that is not TOML: what was probably meant, where that can be told from the line.

/// What was expected on a line that the parser does not understand; its own words where nothing better is known.
pub(super) fn expected(line: &str, message: &str) -> String {
    hint(without_comment(line).trim(), message).unwrap_or_else(|| format!("valid TOML, but {message}"))
}

/// A line up to a # that is in no text. Folders of Windows may end a text with a \ that hides its closing quote.
fn without_comment(line: &str) -> &str {
    let mut quote = None;
    for (place, c) in line.char_indices() {
        match (quote, c) {
            (None, '#') => return &line[..place],
            (None, '"' | '\'') => quote = Some(c),
            (Some(open), _) if open == c => quote = None,
            _ => {}
        }
    }
    line
}

fn hint(line: &str, message: &str) -> Option<String> {
    if line.starts_with("[contact]") || line.starts_with("[[contact]]") {
        return Some("[[contact]], with two brackets on either side, above every contact".to_owned());
    }
    let (key, value) = line.split_once('=').map(|(key, value)| (key.trim(), value.trim()))?;
    // Where \U or \x begins an escape, digits are missing; before a quote it hides the end of the text.
    let is_escape = ["escape", "unicode"].iter().any(|word| message.contains(word)) || value.ends_with("\\\"");
    if is_escape && value.contains('\\') {
        let right = value.replace('\\', "/");
        return Some(format!("/ between folders, {key} = {right}, or single quotes: in \"...\" a \\ begins an escape"));
    }
    let digits = value.find(|c: char| !(c.is_ascii_digit() || matches!(c, '+' | '-' | '.' | 'e' | 'E' | '_')))?;
    let (number, rest) = value.split_at(digits);
    number.trim_end_matches('e').parse::<f64>().ok()?;
    match rest.strip_prefix(',') {
        Some(decimals) if decimals.starts_with(|c: char| c.is_ascii_digit()) => {
            Some(format!("a decimal point, {key} = {number}.{decimals}, not a comma"))
        }
        None if rest.trim_start().starts_with(|c: char| c.is_alphabetic() || c == '%') => {
            let is_kn_t = rest.trim_start().starts_with("kN") || rest.trim() == "t";
            let more = if is_kn_t { "; units = \"kN-t\" at the top takes t and kN throughout" } else { "" };
            Some(format!("a number alone, {key} = {number}: units are fixed, see the documentation of the key{more}"))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::expected;

    #[test]
    fn nothing_is_guessed_where_nothing_is_known() {
        for line in
            ["", "gap", "gap = ", "gap = [1,2", "gap = -", "= 3", "gap = 1979-05-27x", "gap = 3,", "gap = \"3,4"]
        {
            assert_eq!(expected(line, "some words"), "valid TOML, but some words", "{line}");
        }
    }
}

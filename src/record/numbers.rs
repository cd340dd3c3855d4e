//! Numbers as Fortran writes them, apart or in fixed columns.

/// A number as Fortran writes it: `.1234E-02`, `-0.5D-03`, and `.1234-102` where the exponent has three digits.
pub(super) fn fortran_number(text: &str) -> Option<f64> {
    if let Ok(value) = text.parse() {
        return Some(value);
    }
    let with_e = text.replace(['d', 'D'], "E");
    with_e.parse().ok().or_else(|| {
        let sign = with_e.rfind(['+', '-']).filter(|&place| place > 0)?;
        let (mantissa, exponent) = with_e.split_at_checked(sign)?;
        format!("{mantissa}E{exponent}").parse().ok()
    })
}

/// The numbers of a field without blanks: one, or negative ones that touch the number before them, `.1E-01-.2E-01`.
pub(super) fn numbers_of(field: &str) -> Option<Vec<f64>> {
    if let Some(value) = fortran_number(field) {
        return Some(vec![value]);
    }
    let ends_number = |byte: u8| byte.is_ascii_digit() || byte == b'.';
    let mut values = Vec::new();
    let mut start = 0;
    for (place, pair) in (1..).zip(field.as_bytes().windows(2)) {
        if pair[1] == b'-' && ends_number(pair[0]) {
            values.push(fortran_number(field.get(start..place)?)?);
            start = place;
        }
    }
    values.push(fortran_number(field.get(start..)?)?);
    Some(values)
}

/// The numbers of a line that blanks or minus signs set apart; an error is the text that is none.
pub(super) fn numbers_apart(line: &str) -> Vec<Result<f64, String>> {
    let read = |field: &str| {
        numbers_of(field).map_or_else(|| vec![Err(field.to_owned())], |found| found.into_iter().map(Ok).collect())
    };
    line.split_ascii_whitespace().flat_map(read).collect()
}

/// How numbers stand in a line by a Fortran format such as `(8f10.3)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Columns {
    /// Numbers in a full line.
    pub count: usize,
    /// Characters of each.
    pub width: usize,
}

impl Columns {
    /// The first format in a text, in brackets: `(8f10.3)`, `(10I8)`, `(1P6E13.5)`.
    pub(super) fn find(text: &str) -> Option<Columns> {
        text.match_indices('(').find_map(|(place, _)| Columns::read(text.get(place + 1..)?))
    }

    fn read(text: &str) -> Option<Columns> {
        let (count, rest) = leading_number(text.trim_start());
        let (count, rest) = match rest.strip_prefix(['p', 'P']) {
            Some(rest) => leading_number(rest.trim_start_matches(',')),
            None => (count, rest),
        };
        let rest = rest.strip_prefix(['f', 'F', 'e', 'E', 'd', 'D', 'g', 'G', 'i', 'I'])?;
        let (width, rest) = leading_number(rest);
        let is_whole = rest.starts_with('.') || rest.starts_with(')');
        let columns = Columns { count: count.unwrap_or(1), width: width? };
        (is_whole && (1..=1000).contains(&columns.count) && (2..=100).contains(&columns.width)).then_some(columns)
    }

    /// The numbers of a line: those that blanks set apart, and where they touch each from its columns. An error is the
    /// text that is no number.
    pub(super) fn values(self, line: &str, number: fn(&str) -> Option<f64>) -> Vec<Result<f64, String>> {
        let read = |field: &str| number(field).ok_or_else(|| field.to_owned());
        let wrong = |fields: &[Result<f64, String>]| fields.iter().filter(|field| field.is_err()).count();
        let apart: Vec<_> = line.split_whitespace().map(read).collect();
        if wrong(&apart) == 0 {
            return apart;
        }
        let fields = line.trim_end().as_bytes().chunks(self.width).map(String::from_utf8_lossy);
        let fixed: Vec<_> = fields.map(|field| read(field.trim())).collect();
        if wrong(&fixed) <= wrong(&apart) { fixed } else { apart }
    }
}

fn leading_number(text: &str) -> (Option<usize>, &str) {
    let digits = text.bytes().take_while(u8::is_ascii_digit).count();
    let (number, rest) = text.split_at(digits);
    (number.parse().ok(), rest)
}

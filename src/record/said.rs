//! What lines above the samples say: the unit of the accelerations, the step, how many samples there are.
//!
//! A unit counts where a unit stands: in brackets, behind `in`, `unit`, `units of` or the word for the acceleration, at the end of
//! a column's name, or by itself between commas. A `G` or `Gal` that is a name among words does not.

use super::numbers::fortran_number;
use super::unit::Unit;

/// Words of a unit: `cm / s 2`.
const MOST_WORDS: usize = 4;

/// What a phrase says of the unit.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum SaidUnit {
    /// This one.
    Known(Unit),
    /// A unit with a factor beside it, as the file writes it: `g x 100`.
    Scaled(String),
}

/// Every unit that a line names, in its order.
pub(super) fn units(line: &str) -> Vec<SaidUnit> {
    let line = &line.to_lowercase();
    let mut found: Vec<SaidUnit> = factors_at_brackets(line).collect();
    if !found.is_empty() {
        return found;
    }
    let of_phrases = phrases(line).into_iter().filter_map(of_phrase);
    for unit in of_phrases.chain(of_names(line).map(SaidUnit::Known)) {
        if !found.contains(&unit) {
            found.push(unit);
        }
    }
    found
}

/// Pieces of a line, in lower case, that would be a unit: what stands in brackets, behind a word that announces it, and by itself.
fn phrases(line: &str) -> Vec<&str> {
    let mut found: Vec<&str> =
        line.split(['(', '[', '{']).skip(1).filter_map(|rest| rest.split([')', ']', '}']).next()).collect();
    for word in ["in units of", "units of", "units", "unit", "in"] {
        for (place, _) in line.match_indices(word) {
            let (before, after) = (&line[..place], &line[place + word.len()..]);
            let begins = !before.ends_with(|c: char| c.is_alphanumeric());
            let ends = after.starts_with(|c: char| c.is_whitespace() || ":=".contains(c));
            let behind_longer =
                before.trim_end().ends_with("in") && word == "units of" || after.trim_start().starts_with("units");
            if begins && ends && !behind_longer {
                found.push(piece(after.trim_start_matches(|c: char| c.is_whitespace() || ":=".contains(c))));
            }
        }
    }
    // `cm/s2; dt = 0.005`, `Acceleration, g`, a unit in a line of its own.
    let pieces = || line.split([',', ';', '\t']).map(bare);
    let speaks_of_samples = |piece: &str| {
        let words = ["time", "acc", "dt", "step", "npts", "interval", "points", "samples", "hz"];
        piece.is_empty() || Unit::read(piece).is_some() || words.iter().any(|word| piece.contains(word))
    };
    if pieces().all(speaks_of_samples) {
        found.extend(pieces().filter(|piece| Unit::read(piece).is_some()));
    }
    // `Acc g`, `Acceleration cm/s2`.
    for piece in pieces().filter(|piece| !piece.contains(['(', '['])) {
        if let Some((name, unit)) = piece.rsplit_once(|c: char| c.is_whitespace())
            && name.split_whitespace().next_back().is_some_and(|word| word.starts_with("acc"))
        {
            found.push(unit);
        }
    }
    found
}

/// Units in brackets beside which a factor stands: `Acceleration (g) x 100`, `Acc * 1000 [g]`.
fn factors_at_brackets(line: &str) -> impl Iterator<Item = SaidUnit> {
    let places = line.match_indices(['(', '[']);
    places.filter_map(|(place, _)| {
        let (before, inside) = (&line[..place], &line[place + 1..]);
        let (unit, after) = inside.split_once([')', ']'])?;
        let before = before.split([',', ';', '\t', ')', ']']).next_back()?;
        let after = after.split([',', ';', '\t', '(', '[']).next()?.split_whitespace().next();
        // `x 1000 [g]` and `10^-3 (g)`, but not a name such as `090 (g)` or `Acc X (g)`.
        let mut last = before.split_whitespace().rev();
        let (last, second) = (last.next().unwrap_or_default(), last.next().unwrap_or_default());
        let is_name = last == "x" || fortran_number(last).is_some() && !is_factor(second);
        let has_factor = after.is_some_and(is_factor) || !is_name && (is_factor(last) || is_factor(second));
        let factor = format!("{} ({unit}) {}", before.trim(), after.unwrap_or_default());
        (has_factor && of_phrase(unit).is_some()).then(|| SaidUnit::Scaled(factor.trim().to_owned()))
    })
}

/// A piece without what sets it apart from others.
fn bare(piece: &str) -> &str {
    piece.trim_matches(|c: char| c.is_whitespace() || "\"'#%!|:".contains(c))
}

/// Up to what ends a phrase.
fn piece(text: &str) -> &str {
    text.split([',', ';', ')', ']', '(', '[', '\t', '"', ':']).next().unwrap_or_default().trim()
}

/// What a phrase says: a unit that may have words behind it, or one with a factor. A value with its unit, `0.3 g`, says nothing.
fn of_phrase(phrase: &str) -> Option<SaidUnit> {
    let phrase = phrase.trim();
    if let Some(unit) = Unit::read(phrase) {
        return Some(SaidUnit::Known(unit));
    }
    let words: Vec<&str> = phrase.split_whitespace().collect();
    let named = |count: usize| Unit::read(words.get(..count)?.concat().trim_end_matches('.'));
    if let Some((count, unit)) = (1..=MOST_WORDS).rev().find_map(|count| Some((count, named(count)?))) {
        return match words.get(count) {
            Some(next) if is_factor(next) => Some(SaidUnit::Scaled(phrase.to_owned())),
            // `in G Street` is no unit.
            Some(next) if is_name(unit) && !goes_on(next) => None,
            _ => Some(SaidUnit::Known(unit)),
        };
    }
    // `1000 x g`, `x 10^-4 g`: factors before the unit, with at least one that is no plain number.
    let factors = words.iter().take_while(|word| is_factor(word) || fortran_number(word).is_some()).count();
    let is_value = words[..factors].iter().all(|word| fortran_number(word).is_some());
    let unit = words.get(factors).and_then(|word| Unit::read(word));
    let is_glued = words.iter().any(|word| {
        word.split_once(['*', '×', 'x']).is_some_and(|(a, b)| {
            let is_number = |text: &str| fortran_number(text).is_some() || text.starts_with("10^");
            Unit::read(a).is_some() && is_number(b) || Unit::read(b).is_some() && is_number(a)
        })
    });
    (factors > 0 && !is_value && unit.is_some() || is_glued).then(|| SaidUnit::Scaled(phrase.to_owned()))
}

/// Units whose words are names as well, G and Gal.
fn is_name(unit: Unit) -> bool {
    matches!(unit, Unit::Gravity | Unit::Centimetres | Unit::MilliGravity)
}

/// Whether a sentence that has named a unit may go on with a word.
fn goes_on(word: &str) -> bool {
    let words = [
        "at", "unit", "units", "vs", "versus", "and", "with", "every", "for", "per", "from", "over", "equally",
        "spaced", "-", "=",
    ];
    words.contains(&word.trim_matches('.')) || fortran_number(word).is_some()
}

/// Whether a word multiplies what stands beside it.
fn is_factor(word: &str) -> bool {
    let marks = ["x", "*", "×", "/", "%", "times", "percent", "milli", "micro", "kilo"];
    marks.contains(&word)
        || word.starts_with("10^")
        || word.starts_with("10**")
        || word.starts_with(['*', '×', '/'])
        || word.strip_prefix('x').is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
        || word.split_once('/').is_some_and(|(a, b)| fortran_number(a).is_some() && fortran_number(b).is_some())
}

/// Units that are words of their own, or the end of a name such as `accel_m_s2` and `a/g`; `g` and `gal` only at the end of the
/// name of an acceleration, since they are names as well. What follows a number is a value with its unit.
fn of_names(line: &str) -> impl Iterator<Item = Unit> {
    let apart = |c: char| c.is_whitespace() || "()[]{},;:=\"'#%!|".contains(c);
    let mut follows_number = false;
    line.split(apart).filter(|word| !word.is_empty()).filter_map(move |word| {
        let is_value = std::mem::replace(&mut follows_number, fortran_number(word).is_some());
        let unit = of_word(word)?;
        (!is_value).then_some(unit)
    })
}

fn of_word(word: &str) -> Option<Unit> {
    if let Some(unit) = Unit::read(word) {
        return (!is_name(unit) || word.contains(['2', '/'])).then_some(unit);
    }
    // a_g is how many write the acceleration of the ground.
    let ends = word.match_indices(['_', '/']).map(|(place, _)| (place, word.get(place + 1..).unwrap_or_default()));
    let may_be_name = |unit: &Unit| is_name(*unit) && (word == "a_g" || !word.starts_with('a'));
    ends.filter_map(|(_, end)| Unit::read(end).filter(|unit| end.contains(['2', '/']) || !may_be_name(unit))).next()
}

/// Words that announce the step, s, and those that announce the samples in a second, Hz.
const STEPS: [&str; 8] =
    ["dt", "delta t", "time step", "timestep", "step", "sampling interval", "time interval", "interval"];
const RATES: [&str; 5] = ["sampling rate", "sampling frequency", "sampling freq", "sample rate", "fs"];

/// s, where a line says it: `dt = 0.005`, `DT: 0.01 SEC`, `sampling interval = 10 ms`, `Sampling rate: 200 Hz`.
pub(super) fn step(line: &str) -> Option<f64> {
    let line = line.to_lowercase();
    let steps = STEPS.iter().find_map(|key| number_behind(&line, key));
    // A division is rounded once.
    let step = steps.map(|(step, unit)| if unit.starts_with("ms") { step / 1e3 } else { step });
    step.or_else(|| {
        let (rate, unit) = RATES.iter().find_map(|key| number_behind(&line, key))?;
        (unit.is_empty() || unit.starts_with("hz") || unit.starts_with("s")).then_some(1.0 / rate)
    })
}

/// The number > 0 behind a key of a line in lower case, and what stands behind it or between them in brackets. A mark stands
/// between, `:` or `=` or such a unit, but for `dt`: `Step 2 of 3` says nothing.
fn number_behind<'t>(line: &'t str, key: &str) -> Option<(f64, &'t str)> {
    let places = line.match_indices(key).map(|(place, _)| (&line[..place], &line[place + key.len()..]));
    let is_key = |(before, _): &(&str, &str)| !before.ends_with(|c: char| c.is_alphanumeric());
    places.filter(is_key).find_map(|(_, after)| {
        let after = after.trim_start();
        let (unit, rest) = match after.strip_prefix(['(', '[']).and_then(|rest| rest.split_once([')', ']'])) {
            Some((inside, rest)) => (inside.trim(), rest),
            None => ("", after),
        };
        let number = rest.trim_start_matches(|c: char| c.is_whitespace() || ":=".contains(c));
        let has_mark = key == "dt" || !unit.is_empty() || rest.trim_start().starts_with([':', '=']);
        let end = number.find(|c: char| !(c.is_ascii_digit() || ".+-ed".contains(c))).unwrap_or(number.len());
        let (number, behind) = number.split_at(end);
        let value = fortran_number(number.trim_end_matches(['e', 'd', '.'])).filter(|value| *value > 0.0)?;
        (has_mark && value.is_finite()).then_some((value, if unit.is_empty() { behind.trim_start() } else { unit }))
    })
}

/// Samples and step where a line holds nothing else, or their names as well: `4684 0.0100`, `400 0.01 NPTS, DT`.
pub(super) fn count_and_step(line: &str) -> Option<(usize, f64)> {
    let words: Vec<&str> =
        line.split(|c: char| c.is_whitespace() || ",;=:".contains(c)).filter(|word| !word.is_empty()).collect();
    let numbers: Vec<&str> = words.iter().copied().filter(|word| fortran_number(word).is_some()).collect();
    let is_name =
        |word: &&str| ["npts", "dt", "sec", "s", "n", "points", "nsteps", "#"].contains(&word.to_lowercase().as_str());
    let [count, step] = numbers[..] else { return None };
    let all = words.iter().all(|word| fortran_number(word).is_some() || is_name(word));
    let step = fortran_number(step).filter(|step| *step > 0.0 && *step < 10.0)?;
    Some((count.parse().ok().filter(|count| all && *count >= 2)?, step))
}

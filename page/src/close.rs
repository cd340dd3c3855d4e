//! The name that may have been meant, as the Python module finds it: by the share of letters in matching blocks (Ratcliff and
//! Obershelp), of which `difflib` asks 0.6.

const LEAST: f64 = 0.6;

/// The first name that goes on where `found` ends, else the closest one.
pub fn meant<'n>(found: &str, names: impl Iterator<Item = &'n str> + Clone) -> Option<&'n str> {
    if let Some(longer) = names.clone().find(|name| !found.is_empty() && name.starts_with(found)) {
        return Some(longer);
    }
    let word: Vec<char> = found.chars().collect();
    let alike = names.map(|name| (share(&name.chars().collect::<Vec<_>>(), &word), name));
    let close = alike.filter(|(share, _)| *share >= LEAST);
    close.max_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(other.1))).map(|(_, name)| name)
}

/// Letters of both words in matching blocks over all.
fn share(one: &[char], other: &[char]) -> f64 {
    let all = one.len() + other.len();
    if all == 0 { 1.0 } else { 2.0 * matching(one, other) as f64 / all as f64 }
}

/// Letters in the longest block that both have, the first of those, and likewise before and behind it.
fn matching(one: &[char], other: &[char]) -> usize {
    let (mut best, mut lengths) = ((0, 0, 0), vec![0; other.len() + 1]);
    for (i, letter) in one.iter().enumerate() {
        // Of the blocks that end here and at each letter of the other word.
        for j in (0..other.len()).rev() {
            lengths[j + 1] = if other[j] == *letter { lengths[j] + 1 } else { 0 };
        }
        for (j, &length) in lengths.iter().enumerate().skip(1) {
            if length > best.2 {
                best = (i + 1 - length, j - length, length);
            }
        }
    }
    let (i, j, length) = best;
    if length == 0 {
        return 0;
    }
    length + matching(&one[..i], &other[..j]) + matching(&one[i + length..], &other[j + length..])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of `difflib.SequenceMatcher(None, one, other, autojunk=False).ratio()`.
    #[test]
    fn shares_are_those_of_difflib() {
        for (one, other, expected) in RATIOS {
            let letters = |word: &str| word.chars().collect::<Vec<_>>();
            assert_eq!(share(&letters(one), &letters(other)), expected, "{one} {other}");
        }
    }

    #[test]
    fn the_longer_one_or_the_closest() {
        let names = ["left.mass[1]", "left.stiffness[1]", "contact[1].gap", "contact[1].gap_more"];
        for (found, expected) in [
            ("contact[1].ga", Some("contact[1].gap")),
            ("contact[1].gapp", Some("contact[1].gap")),
            ("left.mas[1]", Some("left.mass[1]")),
            ("xyz", None),
            ("", None),
        ] {
            assert_eq!(meant(found, names.into_iter()), expected, "{found}");
        }
    }

    const RATIOS: [(&str, &str, f64); 8] = [
        ("contact[1].gap", "contact[1].gapp", 0.9655172413793104),
        ("left.mass[1]", "left.mas[1]", 0.9565217391304348),
        ("abxcd", "abcd", 0.8888888888888888),
        ("private", "volatile", 0.5333333333333333),
        ("aba", "bab", 0.6666666666666666),
        ("", "", 1.0),
        ("a", "b", 0.0),
        ("left.stiffness[2]", "right.stifness[2]", 0.7647058823529411),
    ];
}

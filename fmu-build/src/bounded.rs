//! Texts from an FMU, which may have many and long ones: as many as a person reads.

use serde::{Deserialize, Serialize};

const MOST: usize = 50;
const LONGEST: usize = 2000;

/// The first texts of a list, and how many more there were.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Bounded {
    texts: Vec<String>,
    more: usize,
}

impl Bounded {
    /// Adds a text.
    pub fn push(&mut self, text: &str) {
        if self.texts.len() < MOST { self.texts.push(shortened(text)) } else { self.more += 1 }
    }

    /// Adds what another list has, and what it has left out.
    pub fn append(&mut self, mut other: Bounded) {
        self.texts.append(&mut other.texts);
        self.more += other.more + self.texts.len().saturating_sub(MOST);
        self.texts.truncate(MOST);
    }

    /// The texts; the last one says how many have been left out.
    pub fn listed(&self) -> Vec<String> {
        let more = (self.more > 0).then(|| format!("and {} more", self.more));
        self.texts.iter().cloned().chain(more).collect()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.texts.is_empty()
    }
}

impl From<Vec<String>> for Bounded {
    fn from(texts: Vec<String>) -> Bounded {
        let mut bounded = Bounded::default();
        texts.iter().for_each(|text| bounded.push(text));
        bounded
    }
}

fn shortened(text: &str) -> String {
    match text.char_indices().nth(LONGEST) {
        None => text.to_owned(),
        Some((end, _)) => format!("{} ... ({} bytes)", &text[..end], text.len()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_and_long_texts_are_cut_and_counted() {
        let mut all = Bounded::from(vec!["a".to_owned(); MOST - 1]);
        all.append(Bounded::from(vec!["ü".repeat(3 * LONGEST); MOST + 2]));
        let texts = all.listed();
        assert_eq!(texts.len(), MOST + 1);
        assert_eq!(texts[MOST - 1], format!("{} ... ({} bytes)", "ü".repeat(LONGEST), 6 * LONGEST));
        assert_eq!(texts[MOST], format!("and {} more", MOST + 1));
        assert_eq!(Bounded::from(vec!["b".to_owned(); MOST]).listed(), vec!["b".to_owned(); MOST]);
    }
}

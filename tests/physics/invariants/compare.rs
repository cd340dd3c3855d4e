//! How two runs of what should be one motion are compared: to the last bit, or but for rounding.

use super::case::{Case, History, Shown};
use pounding::engine::Episode;
use std::collections::HashMap;

/// Episodes of less than this part of the largest impulse are rebounds that die out: how many there are is a matter of
/// rounding.
const NEGLIGIBLE: f64 = 1e-9;

/// Two histories, the second of a case that was made from the first one's, which may show less.
pub struct Pair<'h> {
    pub case: &'h Case,
    pub plain: &'h History,
    pub changed: &'h Case,
    pub other: &'h History,
}

impl Pair<'_> {
    /// Each output of the changed case with its place among those of the first.
    fn outputs(&self) -> Vec<(&Shown, usize)> {
        let places: HashMap<&str, usize> =
            self.case.shown.iter().enumerate().map(|(place, shown)| (shown.name.as_str(), place)).collect();
        self.changed.shown.iter().map(|shown| (shown, places[shown.name.as_str()])).collect()
    }

    /// The same bits of all outputs at all times, and of all episodes; but that a zero may have another sign.
    pub fn have_same_bits(&self) -> Result<(), String> {
        let outputs = self.outputs();
        for ((time, one), other) in self.plain.times.iter().zip(&self.plain.readings).zip(&self.other.readings) {
            if self.changed.is_exact_at(*time) {
                let one: Vec<f64> = outputs.iter().map(|(_, place)| one[*place] + 0.0).collect();
                let other: Vec<f64> = other.iter().map(|other| other + 0.0).collect();
                same_bits(&self.changed.shown, *time, &one, &other)?;
            }
        }
        let late = f64::EPSILON * self.changed.start.abs();
        let other: Vec<Episode> = self
            .plain
            .episodes
            .iter()
            .zip(&self.other.episodes)
            .map(|(one, other)| at_times_of(one, other, late))
            .collect();
        same_episodes(&self.plain.episodes, if late > 0.0 { &other } else { &self.other.episodes })
    }

    /// The same but for so much, relative to the largest value of its kind: all outputs at all times, and all episodes.
    pub fn are_close(&self, allowed: f64) -> Result<(), String> {
        let (outputs, sizes) = (self.outputs(), self.sizes());
        for ((time, one), other) in self.plain.times.iter().zip(&self.plain.readings).zip(&self.other.readings) {
            for ((shown, place), other) in outputs.iter().zip(other) {
                let (one, size) = (one[*place], sizes[kind(&shown.name)]);
                let error = (one - other).abs() / size;
                if error > if shown.unit.is_some() { allowed } else { 0.0 } {
                    return Err(format!("{} at {time} s: {one:e} and {other:e}, off by {error:.1e}", shown.name));
                }
            }
        }
        self.episodes_are_close(allowed)
    }

    /// The largest magnitude of each kind of output.
    fn sizes(&self) -> HashMap<&str, f64> {
        let mut sizes = HashMap::new();
        for reading in &self.plain.readings {
            for (shown, value) in self.case.shown.iter().zip(reading) {
                let size = sizes.entry(kind(&shown.name)).or_insert(f64::MIN_POSITIVE);
                *size = f64::max(*size, value.abs());
            }
        }
        // What is left of the account is a share of the energies already.
        sizes.insert("residual", 1.0);
        sizes
    }

    fn episodes_are_close(&self, allowed: f64) -> Result<(), String> {
        let largest =
            |of: fn(&Episode) -> f64| self.plain.episodes.iter().map(of).fold(f64::MIN_POSITIVE, |a, b| a.max(b.abs()));
        let impulse = largest(|episode| episode.impulse);
        let sizes: [(&str, fn(&Episode) -> f64, f64); 5] = [
            ("start", |episode| episode.start, self.case.duration),
            ("approach velocity", |episode| episode.approach_velocity, largest(|episode| episode.approach_velocity)),
            ("peak force", |episode| episode.peak_force, largest(|episode| episode.peak_force)),
            ("impulse", |episode| episode.impulse, impulse),
            ("dissipated energy", |episode| episode.dissipated_energy, largest(|episode| episode.dissipated_energy)),
        ];
        for contact in 0..self.case.scene.contacts.len() {
            let listed = |history: &History| {
                let is_listed = |e: &&Episode| e.contact == contact && e.impulse.abs() > NEGLIGIBLE * impulse;
                let mut listed: Vec<Episode> = history.episodes.iter().filter(is_listed).copied().collect();
                listed.sort_by(|a, b| a.start.total_cmp(&b.start));
                listed
            };
            let (one, other) = (listed(self.plain), listed(self.other));
            if one.len() != other.len() {
                return Err(format!("contact {}: {} and {} episodes", contact + 1, one.len(), other.len()));
            }
            for (one, other) in one.iter().zip(&other) {
                let off =
                    |(_, of, size): &&(&str, fn(&Episode) -> f64, f64)| (of(one) - of(other)).abs() > allowed * size;
                if let Some((what, of, size)) = sizes.iter().find(off) {
                    let error = (of(one) - of(other)).abs() / size;
                    return Err(format!("{what} of an episode, off by {error:.1e}: {one:?} and {other:?}"));
                }
            }
        }
        Ok(())
    }
}

/// The kind of an output, by its name: the last part of it, without numbers.
fn kind(name: &str) -> &str {
    if name.starts_with("energy.") && name != "energy.residual" {
        return "energy";
    }
    let last = name.rsplit('.').next().unwrap_or(name);
    last.split('[').next().unwrap_or(last)
}

/// The same bits of two readings.
pub fn same_bits(shown: &[Shown], time: f64, one: &[f64], other: &[f64]) -> Result<(), String> {
    let differs = |((_, one), other): &((&Shown, &f64), &f64)| one.to_bits() != other.to_bits();
    match shown.iter().zip(one).zip(other).find(differs) {
        Some(((shown, one), other)) => Err(format!("{} at {time} s: {one:e} and {other:e}", shown.name)),
        None => Ok(()),
    }
}

/// An episode with the times of another one, where they differ by no more than so much: by the rounding of late times.
fn at_times_of(one: &Episode, other: &Episode, late: f64) -> Episode {
    let near = |one: f64, other: f64| if (one - other).abs() <= late { one } else { other };
    let mut near_one = *other;
    (near_one.start, near_one.peak_time) = (near(one.start, other.start), near(one.peak_time, other.peak_time));
    near_one.end = one.end.zip(other.end).map(|(one, other)| near(one, other)).or(other.end);
    near_one
}

pub fn same_episodes(one: &[Episode], other: &[Episode]) -> Result<(), String> {
    match one.iter().zip(other).find(|(one, other)| one != other) {
        Some((one, other)) => Err(format!("{one:?} and {other:?}")),
        None if one.len() != other.len() => Err(format!("{} and {} episodes", one.len(), other.len())),
        None => Ok(()),
    }
}

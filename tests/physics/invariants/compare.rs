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
    /// Each output of the changed case, with its place there and among those of the first.
    fn outputs(&self) -> Vec<(usize, &Shown, usize)> {
        let places: HashMap<&str, usize> =
            self.case.shown.iter().enumerate().map(|(place, shown)| (shown.name.as_str(), place)).collect();
        self.changed.shown.iter().enumerate().map(|(here, shown)| (here, shown, places[shown.name.as_str()])).collect()
    }

    /// The same bits of all outputs at all times, and of all episodes; but that a zero may have another sign.
    pub fn have_same_bits(&self) -> Result<(), String> {
        self.are_read_alike()?;
        let outputs = self.outputs();
        for ((time, one), other) in self.plain.times.iter().zip(&self.plain.readings).zip(&self.other.readings) {
            if self.changed.is_exact_at(*time) {
                let one: Vec<f64> = outputs.iter().map(|(_, _, place)| one[*place] + 0.0).collect();
                let other: Vec<f64> = other.iter().map(|other| other + 0.0).collect();
                same_bits(&self.changed.shown, *time, &one, &other)?;
            }
        }
        let late = f64::EPSILON * self.changed.start.abs();
        let near = |(place, other): (usize, &Episode)| match self.plain.episodes.get(place) {
            Some(one) => at_times_of(one, other, late),
            None => *other,
        };
        let other: Vec<Episode> = self.other.episodes.iter().enumerate().map(near).collect();
        same_episodes(&self.plain.episodes, &other)
    }

    /// That both are read as often.
    fn are_read_alike(&self) -> Result<(), String> {
        let [one, other] = [self.plain, self.other].map(|history| (history.times.len(), history.readings.len()));
        if one == other { Ok(()) } else { Err(format!("{one:?} and {other:?} times and readings")) }
    }

    /// The same but for so much, relative to the largest value of its kind: all outputs at all times, and all episodes.
    pub fn are_close(&self, allowed: f64) -> Result<(), String> {
        self.are_read_alike()?;
        let outputs = self.worst_of_outputs(|_| true);
        let worst = self.worst_of_episodes()?.max(outputs);
        if worst.error <= allowed { Ok(()) } else { Err(format!("off by {:.1e}: {}", worst.error, worst.what)) }
    }

    /// The worst of some outputs, relative to the largest value of its kind; a count or a flag that differs is off by infinity.
    pub fn worst_of_outputs(&self, is_asked: impl Fn(&Shown) -> bool) -> Worst {
        let (mut outputs, sizes, mut worst) = (self.outputs(), self.sizes(), Worst::default());
        outputs.retain(|(_, shown, _)| is_asked(shown));
        for ((time, one), other) in self.plain.times.iter().zip(&self.plain.readings).zip(&self.other.readings) {
            for (here, shown, place) in &outputs {
                let (one, other) = (one[*place], other[*here]);
                let is_real = shown.unit.is_some();
                let size = if is_real { sizes[kind(&shown.name)] } else { f64::MIN_POSITIVE };
                let error = (one - other).abs() / size;
                worst = worst.or(error, || format!("{} at {time} s: {one:e} and {other:e}", shown.name));
            }
        }
        worst
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

    /// The worst of all episodes, each relative to the largest value of its kind; an error, where there are others.
    pub fn worst_of_episodes(&self) -> Result<Worst, String> {
        let largest =
            |of: fn(&Episode) -> f64| self.plain.episodes.iter().map(of).fold(f64::MIN_POSITIVE, |a, b| a.max(b.abs()));
        let parts: [Part; 4] = [
            ("approach velocity", |episode| episode.approach_velocity),
            ("peak force", |episode| episode.peak_force),
            ("impulse", |episode| episode.impulse),
            ("dissipated energy", |episode| episode.dissipated_energy),
        ];
        let mut worst = Worst::default();
        for contact in 0..self.case.scene.contacts.len() {
            let [one, other] = [self.plain, self.other].map(|history| self.listed(history, contact));
            if one.len() != other.len() {
                return Err(format!("contact {}: {} and {} episodes", contact + 1, one.len(), other.len()));
            }
            for (one, other) in one.iter().zip(&other) {
                let told = |what: &str| format!("{what} of {one:?}, and {other:?}");
                worst = worst.or((one.start - other.start).abs() / self.case.duration, || told("start"));
                for (what, of) in parts {
                    worst = worst.or((of(one) - of(other)).abs() / largest(of), || told(what));
                }
            }
        }
        Ok(worst)
    }

    /// The episodes of a contact that count, in the order in which they begin.
    fn listed(&self, history: &History, contact: usize) -> Vec<Episode> {
        let impulse = self.plain.episodes.iter().fold(0.0, |largest: f64, episode| largest.max(episode.impulse.abs()));
        let counts = |episode: &&Episode| episode.contact == contact && episode.impulse.abs() > NEGLIGIBLE * impulse;
        let mut listed: Vec<Episode> = history.episodes.iter().filter(counts).copied().collect();
        listed.sort_by(|a, b| a.start.total_cmp(&b.start));
        listed
    }
}

/// A quantity of an episode, and its name.
type Part = (&'static str, fn(&Episode) -> f64);

/// The largest difference, and of what it is.
#[derive(Default)]
pub struct Worst {
    pub error: f64,
    pub what: String,
}

impl Worst {
    /// NaN is worse than all.
    fn or(self, error: f64, what: impl FnOnce() -> String) -> Worst {
        if self.error.is_nan() || error <= self.error { self } else { Worst { error, what: what() } }
    }

    fn max(self, other: Worst) -> Worst {
        if self.error.is_nan() || other.error <= self.error { self } else { other }
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

#[test]
fn what_is_no_number_stays_the_worst() {
    let nan = || Worst::default().or(f64::NAN, || "nothing".to_owned());
    assert!(nan().or(1.0, || "one".to_owned()).error.is_nan());
    let one = || Worst { error: 1.0, what: "one".to_owned() };
    assert!(nan().max(one()).error.is_nan() && one().max(nan()).error.is_nan());
}

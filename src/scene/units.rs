//! The units in which a scene file gives masses and forces, and all that is made of them.
//!
//! Every number is converted where it is read, as a decimal number and not as a double, so that 0.00365 t is the very
//! double that 3.65 kg is. From there on all is in SI units; only messages about the file go back to its units.

/// How a scene gives masses and forces. Lengths are in m and times in s in any case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Units {
    /// kg and N.
    #[default]
    Si,
    /// t and kN: a thousand times those of the SI, and so is every unit that has one of them in it, such as kN/m.
    KilonewtonTonne,
}

impl Units {
    /// All that there are.
    pub const ALL: [Units; 2] = [Units::Si, Units::KilonewtonTonne];

    /// As scenes write it.
    pub const fn name(self) -> &'static str {
        match self {
            Units::Si => "SI",
            Units::KilonewtonTonne => "kN-t",
        }
    }

    /// The one with a name.
    pub fn from_name(name: &str) -> Option<Units> {
        Units::ALL.into_iter().find(|units| units.name() == name)
    }

    /// The name of an SI unit that has a mass or a force in it, as it is in these units: kg is t, N/m is kN/m.
    pub fn unit(self, si: &str) -> String {
        match self {
            Units::Si => si.to_owned(),
            Units::KilonewtonTonne => si.replacen("kg", "t", 1).replacen('N', "kN", 1),
        }
    }

    /// A number of the SI as it is in these units: to the digits that the scene gave it with, unless these were 16 and
    /// more.
    pub fn written(self, si: f64) -> f64 {
        // The shortest decimal number that reads as this double, with its point moved.
        shifted(&format!("{si:e}"), -self.power()).unwrap_or(si)
    }

    /// The SI number that a decimal number in these units stands for: the double nearest to it, so the same one that a
    /// scene in SI units gets by the same digits with the point moved.
    pub(super) fn read(self, decimal: &str) -> Option<f64> {
        shifted(decimal, self.power())
    }

    /// The largest number that there is, for a person.
    pub(super) const fn largest(self) -> &'static str {
        match self {
            Units::Si => "1.8e308",
            Units::KilonewtonTonne => "1.8e305",
        }
    }

    /// 10 to this power is how many SI units these are.
    const fn power(self) -> i64 {
        match self {
            Units::Si => 0,
            Units::KilonewtonTonne => 3,
        }
    }
}

/// A decimal number times a power of ten, rounded once; infinite where it is too large.
fn shifted(decimal: &str, power: i64) -> Option<f64> {
    let moved = decimal.split_once(['e', 'E']).map_or(Some((decimal, power)), |(digits, exponent)| {
        exponent.parse::<i64>().ok()?.checked_add(power).map(|exponent| (digits, exponent))
    });
    match moved {
        Some((digits, exponent)) if power != 0 && digits.ends_with(|c: char| c.is_ascii_digit()) => {
            format!("{digits}e{exponent}").parse().ok()
        }
        // Neither "inf" and "nan" nor an exponent of twenty digits changes with the unit.
        _ => decimal.parse().ok(),
    }
}

/// What is expected instead of a name that there is not, and which one may be meant.
pub(super) fn expected(found: &str) -> String {
    let found = found.to_lowercase();
    let has = |names: &[&str]| found.split(|c: char| !c.is_alphabetic()).any(|word| names.contains(&word));
    let meant = match () {
        () if has(&["kn", "t", "to", "ton", "tons", "tonne", "tonnes"]) => "; did you mean kN-t?",
        () if has(&["si", "n", "kg", "mks", "m"]) => "; did you mean SI?",
        () => "",
    };
    format!("SI (masses in kg, forces in N) or kN-t (masses in t, forces in kN); lengths are in m in both{meant}")
}

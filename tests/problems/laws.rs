//! The laws of contact, as a scene says them.

/// The numbers that the laws share.
#[derive(Clone, Copy)]
pub struct Laws {
    /// N/m, of the laws with a linear spring.
    pub spring: f64,
    /// N/m^n, of the laws of Hertz' kind.
    pub hertz: f64,
    /// n of the second `hertz`; all others have 1.5, which is what a scene means that says nothing.
    pub exponent: f64,
    pub restitution: f64,
}

impl Laws {
    pub fn stereomechanical(&self) -> String {
        format!("law = \"stereomechanical\"\nrestitution = {:?}", self.restitution)
    }

    pub fn linear(&self) -> String {
        format!("law = \"linear\"\nstiffness = {:?}", self.spring)
    }

    pub fn kelvin_voigt(&self) -> String {
        format!("law = \"kelvin_voigt\"\nstiffness = {:?}\nrestitution = {:?}", self.spring, self.restitution)
    }

    pub fn kelvin_voigt_no_tension(&self) -> String {
        format!(
            "law = \"kelvin_voigt_no_tension\"\nstiffness = {:?}\nrestitution = {:?}",
            self.spring, self.restitution
        )
    }

    pub fn hertz(&self) -> String {
        format!("law = \"hertz\"\nstiffness = {:?}", self.hertz)
    }

    pub fn hertz_of_another_exponent(&self) -> String {
        format!("{}\nexponent = {:?}", self.hertz(), self.exponent)
    }

    pub fn jankowski(&self) -> String {
        format!("law = \"jankowski\"\nstiffness = {:?}\nrestitution = {:?}", self.hertz, self.restitution)
    }

    pub fn hertz_damped(&self, formula: &str) -> String {
        let Laws { hertz, restitution, .. } = self;
        format!(
            "law = \"hertz_damped\"\nstiffness = {hertz:?}\nrestitution = {restitution:?}\n\
             damping_formula = \"{formula}\""
        )
    }

    /// All seven, `hertz` with both exponents.
    pub fn all(&self) -> [String; 8] {
        [
            self.stereomechanical(),
            self.linear(),
            self.kelvin_voigt(),
            self.kelvin_voigt_no_tension(),
            self.hertz(),
            self.hertz_of_another_exponent(),
            self.jankowski(),
            self.hertz_damped("exact"),
        ]
    }
}

/// The table of a contact between two floors, counted from 1.
pub fn contact((left, right): (usize, usize), gap: f64, law: &str) -> String {
    format!("[[contact]]\nleft_floor = {left}\nright_floor = {right}\ngap = {gap:?}\n{}\n", law.trim_end())
}

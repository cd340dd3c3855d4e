//! Two single masses, each on a spring of its own, and one contact between them.
//!
//! Free masses have an answer in closed form under every law that returns a known share of the approach velocity: when
//! they meet, how fast they part, what is lost.

/// N/m: so soft that a mass on it is free. It changes nothing in the first 20 digits.
pub const FREE: f64 = 1e-20;

/// A mass on a spring.
#[derive(Clone, Copy)]
pub struct Mass {
    /// kg.
    pub mass: f64,
    /// N/m.
    pub stiffness: f64,
    /// Share of the critical damping.
    pub damping: f64,
    /// m, at the start.
    pub displacement: f64,
    /// m/s, at the start.
    pub velocity: f64,
}

impl Mass {
    pub fn free(mass: f64, velocity: f64) -> Mass {
        Mass { velocity, ..Mass::on_spring(mass, FREE, 0.0) }
    }

    /// Undamped, let go at a displacement.
    pub fn on_spring(mass: f64, stiffness: f64, displacement: f64) -> Mass {
        Mass { mass, stiffness, damping: 0.0, displacement, velocity: 0.0 }
    }

    fn toml(&self) -> String {
        let Mass { mass, stiffness, damping, displacement, velocity } = self;
        format!(
            "mass = [{mass:?}]\nstiffness = [{stiffness:?}]\ndamping = {{ ratio = {damping:?} }}\n\
             initial_displacement = [{displacement:?}]\ninitial_velocity = [{velocity:?}]\n"
        )
    }
}

/// What is asked.
#[derive(Clone, Copy)]
pub struct TwoMasses<'t> {
    pub left: Mass,
    pub right: Mass,
    /// m.
    pub gap: f64,
    /// Keys of the contact's law; other tables may follow.
    pub law: &'t str,
    pub energy: bool,
    pub floor_forces: bool,
}

impl<'t> TwoMasses<'t> {
    /// With an account of energy and without forces on the floors.
    pub fn new(left: Mass, right: Mass, gap: f64, law: &'t str) -> TwoMasses<'t> {
        TwoMasses { left, right, gap, law, energy: true, floor_forces: false }
    }

    pub fn toml(&self) -> String {
        let TwoMasses { left, right, gap, law, energy, floor_forces } = self;
        format!(
            "name = \"TwoMasses\"\n[left]\n{}[right]\n{}[inputs]\nfloor_forces = {floor_forces}\n\
             [outputs]\nenergy = {energy}\n[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = {gap:?}\n{law}\n",
            left.toml(),
            right.toml()
        )
    }
}

/// The answers for free masses that approach each other.
impl TwoMasses<'_> {
    /// m/s.
    pub fn approach(&self) -> f64 {
        self.left.velocity - self.right.velocity
    }

    /// s, when the gap has closed.
    pub fn entry(&self) -> f64 {
        self.gap / self.approach()
    }

    /// kg, of the relative motion: m1 m2 / (m1 + m2).
    pub fn reduced_mass(&self) -> f64 {
        reduced_mass(self.left.mass, self.right.mass)
    }

    /// m/s, both velocities after an impact that returns the share e of the approach velocity.
    pub fn velocities_after(&self, e: f64) -> (f64, f64) {
        let (m1, m2, approach) = (self.left.mass, self.right.mass, self.approach());
        let left = self.left.velocity - (1.0 + e) * m2 / (m1 + m2) * approach;
        (left, self.right.velocity + (1.0 + e) * m1 / (m1 + m2) * approach)
    }

    /// N s, that such an impact exchanges.
    pub fn impulse(&self, e: f64) -> f64 {
        (1.0 + e) * self.reduced_mass() * self.approach()
    }

    /// J, that such an impact takes.
    pub fn loss(&self, e: f64) -> f64 {
        0.5 * self.reduced_mass() * (1.0 - e * e) * self.approach() * self.approach()
    }
}

/// kg, of the motion of two masses relative to each other.
pub fn reduced_mass(left: f64, right: f64) -> f64 {
    left * right / (left + right)
}

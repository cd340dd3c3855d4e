//! Work of the ground motion and of damping over a flight, as quadratic forms of the motion at its start.
//!
//! Apart from contact the velocity of a mode is linear in z = (q, v, a, s): its displacement and velocity and the ground's
//! acceleration and slope at the start. So the work of its damping, the integral of c v^2, and that of the ground motion,
//! the integral of -participation (a + s t) v, are forms z' V z and z' I z, whose coefficients depend on the length of
//! the flight alone. They are integrated over a short flight by quadrature of the exact velocity, and doubled with the
//! exact motion: W(2h) = W(h) + T' W(h) T, where z becomes T z over h. The work is found from velocities, never from the
//! energies at both ends, so that the balance of energy still tests the motion.

use super::bodies::Body;
use super::coupled_work::{ABREAST, Abreast, CoupledEnergy, CoupledWork, Flying};
use super::equations::Structure;
use super::lanes::{LANES, Lane, from_left_to_right};
use super::motion::{LinearGround, Motion, MotionMut};
use super::propagator::ModeIncrement;
use super::series::power::NodeRoom;
use crate::numerics::quadrature::TWELVE_POINTS;
use nalgebra::{Matrix4, Vector4};

/// Largest (w or c) x (length) over which the rule of 12 points integrates the work to rounding: its error is
/// 9e-39 (2 x 3)^24 = 4e-20 of the largest power.
const RULE_ANGLE: f64 = 3.0;

/// The work over a flight of one length, for all modes.
#[derive(Clone, Debug)]
pub struct FlightWork {
    /// s.
    pub length: f64,
    modes: Vec<ModeForms>,
    /// Bodies in which damping couples modes.
    coupled: Vec<CoupledWork>,
    /// Coefficients of a^2, a s and s^2 in the work of the ground motion and of damping: sums over all other modes.
    ground: [[f64; 3]; 2],
}

/// Coefficients of [`LANES`] modes, side by side.
#[derive(Clone, Copy, Debug, Default)]
struct ModeForms {
    /// Work of damping: q^2, q v, v^2.
    viscous: [Lane; 3],
    /// Work of damping: q a, q s, v a, v s.
    viscous_mixed: [Lane; 4],
    /// Work of the ground motion: a q, a v, s q, s v.
    input: [Lane; 4],
    /// w^2, 1/s2.
    omega2: Lane,
}

/// Memory for the work over flights.
#[derive(Clone, Debug)]
pub struct WorkRoom {
    /// Motions and loads of flights side by side.
    z: Vec<Abreast>,
    /// Energy dissipated by the dashpot of each link over a step, J.
    pub dashpots: Vec<f64>,
    /// The same over flights side by side.
    dashpots_abreast: Vec<Abreast>,
    /// Displacements and velocities of the modes where oscillators move in flights.
    pub modal: [Vec<f64>; 2],
    /// Motions at the nodes of a quadrature.
    pub nodes: NodeRoom,
}

impl WorkRoom {
    /// For a structure.
    pub fn new(structure: &Structure) -> WorkRoom {
        let count = structure.oscillators().map_or(0, |_| structure.lanes);
        WorkRoom {
            z: Vec::with_capacity(2 * structure.lanes + 2 * LANES),
            dashpots: vec![0.0; structure.links.len()],
            dashpots_abreast: vec![[0.0; ABREAST]; structure.links.len()],
            modal: [(); 2].map(|()| vec![0.0; count]),
            nodes: NodeRoom::new(structure),
        }
    }
}

/// What a flight does, and the energy at its start, J.
#[derive(Clone, Copy, Debug)]
pub struct FlightEnergy {
    /// Work of the ground motion.
    pub input: f64,
    /// Energy dissipated by structural damping.
    pub viscous: f64,
    /// Kinetic energy.
    pub kinetic: f64,
    /// Strain energy.
    pub strain: f64,
}

/// Which kinetic and strain energies count, J.
#[derive(Clone, Copy, Debug)]
pub struct Counts {
    /// Those above the largest energy so far.
    pub above: f64,
    /// They are at most what has been put in.
    pub at_most: f64,
}

impl FlightWork {
    /// For flights of a `length`, s.
    pub fn of(structure: &Structure, length: f64) -> FlightWork {
        let bodies = structure.bodies.iter().enumerate();
        let mut work = FlightWork {
            length,
            modes: vec![ModeForms::default(); structure.lanes / LANES],
            coupled: bodies.filter_map(|(b, body)| CoupledWork::of(structure, body, b, length)).collect(),
            ground: Default::default(),
        };
        if structure.bodies.iter().all(Body::is_coupled) {
            work.modes.clear();
            return work;
        }
        let modes = structure.omega2.iter().zip(&structure.damping).zip(&structure.participation);
        for (m, ((w2, c), participation)) in modes.enumerate() {
            if structure.couples(m) {
                continue;
            }
            let [input, viscous] = forms(w2.sqrt(), *c, *participation, length);
            work.modes[m / LANES].set(m % LANES, *w2, &input, &viscous);
            for (ground, form) in work.ground.iter_mut().zip([&input, &viscous]) {
                ground[0] += form[(2, 2)];
                ground[1] += both(form, 2, 3);
                ground[2] += form[(3, 3)];
            }
        }
        work
    }

    /// Over flights that follow each other, where damping may couple modes: `add` gets each flight's, and the energy
    /// dissipated in it by the dashpot of each link, J. It returns how much energy counts from there on; `counts` is what
    /// does in the first flight.
    pub fn over_all<'a>(
        &self,
        structure: &Structure,
        (count, flight): (usize, impl Fn(usize) -> Flying<'a>),
        mut counts: Counts,
        room: &mut WorkRoom,
        mut add: impl FnMut(&FlightEnergy, &[f64]) -> Counts,
    ) {
        for start in (0..count).step_by(ABREAST) {
            let together = start..count.min(start + ABREAST);
            let coupled = self.over_coupled(together.clone().map(&flight), room);
            for (k, (motion, load)) in together.map(&flight).enumerate() {
                let mut of_flight = self.over((motion.q.as_chunks().0, motion.v.as_chunks().0), load);
                of_flight.input += coupled.input[k];
                of_flight.viscous += coupled.viscous[k];
                of_flight.kinetic += coupled.kinetic[k];
                of_flight.strain += coupled.strain[k];
                of_flight.raise_to_oscillators(structure, motion, counts, &mut room.modal);
                room.dashpots.iter_mut().zip(&room.dashpots_abreast).for_each(|(own, all)| *own = all[k]);
                counts = add(&of_flight, &room.dashpots);
            }
        }
    }

    /// What flights side by side do in bodies in which damping couples modes; leaves the work of the dashpots of links in the
    /// room.
    fn over_coupled<'a>(
        &self,
        flights: impl Iterator<Item = Flying<'a>> + Clone,
        room: &mut WorkRoom,
    ) -> CoupledEnergy {
        let WorkRoom { z, dashpots_abreast: dashpots, .. } = room;
        dashpots.fill([0.0; ABREAST]);
        let mut sums = CoupledEnergy::default();
        for body in &self.coupled {
            sums.add(&body.over(flights.clone(), z, dashpots));
        }
        sums
    }

    /// Over one flight, in bodies in which it couples none.
    #[inline]
    pub fn over(&self, motion: (&[Lane], &[Lane]), ground: LinearGround) -> FlightEnergy {
        over_modes(self, motion, ground)
    }
}

/// See [`FlightWork::over`].
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn over_modes(work: &FlightWork, (q, v): (&[Lane], &[Lane]), ground: LinearGround) -> FlightEnergy {
    let LinearGround { acceleration: a, slope: s } = ground;
    let [mut held, mut rising, mut viscous, mut kinetic, mut strain] = [[0.0; LANES]; 5];
    for ((mode, q), v) in work.modes.iter().zip(q).zip(v) {
        let ModeForms { viscous: [qq, qv, vv], viscous_mixed: [qa, qs, va, vs], input: [aq, av, sq, sv], omega2 } =
            mode;
        for i in 0..LANES {
            let (q, v) = (q[i], v[i]);
            held[i] += aq[i] * q + av[i] * v;
            rising[i] += sq[i] * q + sv[i] * v;
            let of_q = qq[i] * q + qv[i] * v + (qa[i] * a + qs[i] * s);
            let of_v = vv[i] * v + (va[i] * a + vs[i] * s);
            viscous[i] += q * of_q + v * of_v;
            kinetic[i] += v * v;
            strain[i] += omega2[i] * q * q;
        }
    }
    let [held, rising, viscous, kinetic, strain] = [held, rising, viscous, kinetic, strain].map(from_left_to_right);
    let [of_input, of_viscous] = work.ground.map(|[aa, both, ss]| a * (aa * a + both * s) + ss * s * s);
    FlightEnergy {
        input: a * held + s * rising + of_input,
        viscous: viscous + of_viscous,
        kinetic: 0.5 * kinetic,
        strain: 0.5 * strain,
    }
}

impl FlightEnergy {
    /// Makes the energies those of the modes where oscillators move, or 0 where they do not count: theirs cost as much as the
    /// work.
    fn raise_to_oscillators(
        &mut self,
        structure: &Structure,
        motion: Motion,
        Counts { above, at_most }: Counts,
        [q, v]: &mut [Vec<f64>; 2],
    ) {
        let Some(oscillators) = structure.oscillators() else { return };
        let most = oscillators.most_energy * (self.kinetic + self.strain);
        (self.kinetic, self.strain) = match most <= above || at_most <= above {
            true => (0.0, 0.0),
            false => {
                oscillators.to_modes(motion, MotionMut { q, v });
                structure.energies(q, v)
            }
        };
    }
}

impl ModeForms {
    fn set(&mut self, i: usize, w2: f64, input: &Matrix4<f64>, viscous: &Matrix4<f64>) {
        for (lanes, (j, k)) in self.viscous.iter_mut().zip([(0, 0), (0, 1), (1, 1)]) {
            lanes[i] = if j == k { viscous[(j, k)] } else { both(viscous, j, k) };
        }
        let mixed = [(0, 2), (0, 3), (1, 2), (1, 3)];
        for (lanes, (j, k)) in self.viscous_mixed.iter_mut().zip(mixed) {
            lanes[i] = both(viscous, j, k);
        }
        for (lanes, (j, k)) in self.input.iter_mut().zip([(0, 2), (1, 2), (0, 3), (1, 3)]) {
            lanes[i] = both(input, j, k);
        }
        self.omega2[i] = w2;
    }
}

/// The coefficient of z_j z_k in a form.
fn both(form: &Matrix4<f64>, j: usize, k: usize) -> f64 {
    form[(j, k)] + form[(k, j)]
}

/// The forms of one mode over a flight, of the work of the ground motion and of damping.
fn forms(omega: f64, c: f64, participation: f64, length: f64) -> [Matrix4<f64>; 2] {
    let doublings = libm::log2(omega.max(c) * length / RULE_ANGLE).ceil().clamp(0.0, 1000.0) as i32;
    let mut h = libm::ldexp(length, -doublings);
    let mut forms = [Matrix4::zeros(); 2];
    for (x, weight) in TWELVE_POINTS {
        let (t, weight) = (x * h, weight * h);
        let at = ModeIncrement::new(omega, c, t);
        let velocity = Vector4::new(at.dvq, 1.0 + at.dvv, -participation * at.rv0, -participation * at.rv1);
        let ground = Vector4::new(0.0, 0.0, -participation, -participation * t);
        forms[0] += ground * velocity.transpose() * weight;
        forms[1] += velocity * velocity.transpose() * (c * weight);
    }
    for _ in 0..doublings {
        let onward = transition(&ModeIncrement::new(omega, c, h), participation, h);
        forms = forms.map(|form| form + onward.transpose() * form * onward);
        h *= 2.0;
    }
    forms
}

/// T: z after a flight of `h` seconds from z before it.
fn transition(over: &ModeIncrement, participation: f64, h: f64) -> Matrix4<f64> {
    let ModeIncrement { dqq, dqv, dvq, dvv, rq0, rq1, rv0, rv1 } = *over;
    let p = -participation;
    Matrix4::new(
        1.0 + dqq,
        dqv,
        p * rq0,
        p * rq1, //
        dvq,
        1.0 + dvv,
        p * rv0,
        p * rv1, //
        0.0,
        0.0,
        1.0,
        h, //
        0.0,
        0.0,
        0.0,
        1.0,
    )
}

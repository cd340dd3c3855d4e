//! Work over a flight of modes that damping couples, as quadratic forms of the motion at its start (`coupled_rates.rs`).
//!
//! Where oscillators move in flights (`flight_modes.rs`) their coordinates and rates stand in z. The work is found from
//! velocities, never from the energies at both ends, so that the balance of energy still tests the motion.

use super::bodies::Body;
use super::coupled_rates::RateMatrix;
use super::equations::Structure;
use super::form::{Form, Squares, row_times, squares};
use super::lanes::LANES;
use super::modes::ModalDamping;
use super::motion::{LinearGround, Motion};
use nalgebra::{DMatrix, RowDVector};

/// Number of flights whose work is found together: each entry of a form is read once for all.
pub(super) const ABREAST: usize = 8;

/// One number of each of them.
pub(super) type Abreast = [f64; ABREAST];

/// The motion at the start of a flight, and the ground's acceleration.
pub(super) type Flying<'a> = (Motion<'a>, LinearGround);

/// The work over a flight of one length, of one body.
#[derive(Clone, Debug)]
pub(super) struct CoupledWork {
    /// First mode and number of modes.
    offset: usize,
    count: usize,
    /// Work of all damping.
    viscous: Form,
    /// Work of the dashpots of links, each with the number of its link.
    links: Vec<(usize, DashpotWork)>,
    /// w^2 / 2 of what moves in flights, 1/s2.
    half_omega2: Vec<f64>,
    /// Work of the ground motion: rows over z that are multiplied by its acceleration and its slope.
    input: [RowDVector<f64>; 2],
}

/// The work of a dashpot.
#[derive(Clone, Debug)]
enum DashpotWork {
    /// Squares of its rate at the points of a quadrature, where these are few.
    Squares(Squares),
    Form(Form),
}

/// What several flights do, and the energies at their starts, J; where oscillators move, as if they were modes.
#[derive(Default)]
pub(super) struct CoupledEnergy {
    pub(super) input: Abreast,
    pub(super) viscous: Abreast,
    pub(super) kinetic: Abreast,
    pub(super) strain: Abreast,
}

impl CoupledEnergy {
    /// Adds those of another body.
    pub(super) fn add(&mut self, CoupledEnergy { input, viscous, kinetic, strain }: &CoupledEnergy) {
        let sums = [&mut self.input, &mut self.viscous, &mut self.kinetic, &mut self.strain];
        sums.into_iter().zip([input, viscous, kinetic, strain]).for_each(|(sums, numbers)| add(sums, numbers));
    }
}

impl DashpotWork {
    /// Of a rate, a row over the velocities of modes, whose square is the power, over z = P y instead of z.
    fn of_rate(rates: &RateMatrix, rate: &RowDVector<f64>, length: f64, over: Option<&DMatrix<f64>>) -> DashpotWork {
        match rates.squares_over(rate, length, over) {
            Some(squares) => DashpotWork::Squares(squares),
            None => DashpotWork::Form(rates.form_over(&(rate.transpose() * rate), length, over)),
        }
    }

    fn of_vectors(&self, z: &[Abreast]) -> Abreast {
        match self {
            DashpotWork::Squares(squares) => squares.of_vectors(z),
            DashpotWork::Form(form) => form.of_vectors(z),
        }
    }
}

impl CoupledWork {
    /// For flights of a `length`, s; `None` where damping couples no modes of the body.
    pub(super) fn of(structure: &Structure, body: &Body, number: usize, length: f64) -> Option<CoupledWork> {
        let ModalDamping::Coupled(damping) = &body.modes.damping else { return None };
        let (range, n) = (body.range.clone(), body.range.len());
        let rates = RateMatrix {
            omega2: &structure.omega2[range.clone()],
            participation: &structure.participation[range.clone()],
            damping,
            fastest: structure.fastest,
        };
        let to_modes = structure.oscillators().and_then(|flight| flight.map_of(range.start));
        let over = to_modes.map(|to_modes| {
            let mut over = DMatrix::identity(rates.size(), rates.size());
            over.view_mut((0, 0), (2 * n, 2 * n)).copy_from(to_modes);
            over
        });
        let of_links = structure.links.iter().enumerate().filter(|(_, link)| link.body == number && link.dashpot > 0.0);
        let links = of_links.map(|(l, link)| {
            let rate = RowDVector::from_row_slice(&link.row[range.clone()]) * link.dashpot.sqrt();
            (l, DashpotWork::of_rate(&rates, &rate, length, over.as_ref()))
        });
        let input = rates.input_over(length);
        Some(CoupledWork {
            offset: range.start,
            count: n,
            links: links.collect(),
            half_omega2: structure.in_flight().omega2[range.clone()].iter().map(|w2| 0.5 * w2).collect(),
            viscous: rates.form_over(damping, length, over.as_ref()),
            input: over.as_ref().map_or(input.clone(), |over| input.map(|row| row * over)),
        })
    }

    /// What several flights do side by side; adds that of the dashpots of links.
    pub(super) fn over<'a>(
        &self,
        flights: impl Iterator<Item = Flying<'a>>,
        z: &mut Vec<Abreast>,
        dashpots: &mut [Abreast],
    ) -> CoupledEnergy {
        let n = self.count;
        z.clear();
        z.resize((2 * n + 2).next_multiple_of(LANES), [0.0; ABREAST]);
        let (of_q, rest) = z.split_at_mut(n);
        let (of_v, of_ground) = rest.split_at_mut(n);
        for (k, (Motion { q, v }, ground)) in flights.enumerate() {
            let own = self.offset..self.offset + n;
            of_q.iter_mut().zip(&q[own.clone()]).for_each(|(z, q)| z[k] = *q);
            of_v.iter_mut().zip(&v[own]).for_each(|(z, v)| z[k] = *v);
            (of_ground[0][k], of_ground[1][k]) = (ground.acceleration, ground.slope);
        }
        for (l, work) in &self.links {
            add(&mut dashpots[*l], &work.of_vectors(z));
        }
        let [held, rising] = self.input.each_ref().map(|row| row_times(row.as_slice(), z));
        CoupledEnergy {
            input: std::array::from_fn(|k| z[2 * n][k] * held[k] + z[2 * n + 1][k] * rising[k]),
            viscous: self.viscous.of_vectors(z),
            kinetic: squares(std::iter::repeat(0.5), &z[n..2 * n]),
            strain: squares(self.half_omega2.iter().copied(), &z[..n]),
        }
    }
}

/// Adds numbers to others.
fn add(sums: &mut Abreast, numbers: &Abreast) {
    sums.iter_mut().zip(numbers).for_each(|(sum, number)| *sum += number);
}

//! Chords between both ends of a step in contact, against parabolas, which have one second derivative throughout, and
//! against what turns less.

use super::motions::{Comparison, Random, largest};
use crate::engine::bounds::chord::{bound_by_deviation, bound_by_motion, bound_by_push};

const INSTANTS: usize = 200;

/// y = top + bend/2 (t - turn)^2 + size sin(rate t), over the times 0 to h.
#[derive(Debug)]
struct Curve {
    top: f64,
    bend: f64,
    /// s.
    turn: f64,
    size: f64,
    rate: f64,
}

impl Curve {
    fn any(random: &mut Random, h: f64) -> Curve {
        let scale = random.power_of_ten(-3.0, 3.0);
        let wave = if random.between(0.0, 1.0) < 0.5 { 0.0 } else { random.between(0.0, 1.0) };
        Curve {
            top: random.between(-1.0, 1.0) * scale,
            bend: random.one_of(&[-1.0, 1.0]) * scale / (h * h),
            turn: random.between(-0.5, 1.5) * h,
            size: wave * scale,
            rate: random.between(0.1, 8.0) / h,
        }
    }

    fn value(&self, t: f64) -> f64 {
        let Curve { top, bend, turn, size, rate } = self;
        top + 0.5 * bend * (t - turn) * (t - turn) + size * (rate * t).sin()
    }

    fn slope(&self, t: f64) -> f64 {
        self.bend * (t - self.turn) + self.size * self.rate * (self.rate * t).cos()
    }

    /// The largest second derivative.
    fn most_bent(&self) -> f64 {
        self.bend.abs() + self.size * self.rate * self.rate
    }

    fn is_parabola(&self) -> bool {
        self.size == 0.0
    }
}

fn times(h: f64) -> impl Iterator<Item = f64> {
    (0..=INSTANTS).map(move |i| h * i as f64 / INSTANTS as f64)
}

#[test]
fn nothing_exceeds_its_peak_by_more_than_chords_say() {
    let mut random = Random(21);
    let (mut inside, mut closed) = (Comparison::of("chord of a motion"), 0);
    for _ in 0..20_000 {
        let h = random.power_of_ten(-4.0, 1.0);
        let curve = Curve::any(&mut random, h);
        let known = random.between(0.0, 1.0) * curve.top.abs();
        let (mut peak, mut upper) = ([known], [f64::NAN]);
        let ends = [curve.value(0.0), curve.value(h)];
        let [start, end, rate, end_rate, bent] =
            [ends[0], ends[1], curve.slope(0.0), curve.slope(h), curve.most_bent()].map(|number| [number]);
        let open = bound_by_motion([&start, &end, &rate, &end_rate, &bent], h, &mut peak, &mut upper);
        assert_eq!(open == 0, upper[0] <= peak[0]);
        assert_eq!(peak[0], known.max(ends[0].abs()).max(ends[1].abs()));
        let reached = largest(times(h).map(|t| curve.value(t)));
        let size = bent[0] * h * h + curve.top.abs();
        inside.note(reached - peak[0], (upper[0] - peak[0]).max(0.0), 1e-13 * size, &|| format!("{curve:?}, {h:e} s"));
        // A parabola that turns well before or after the step is known to go on.
        let is_outside = curve.turn < -0.01 * h || curve.turn > 1.01 * h;
        if curve.is_parabola() && is_outside {
            closed += 1;
            assert!(upper[0] <= peak[0], "{curve:?}, {h:e} s");
        }
    }
    assert!(closed > 1000);
    inside.comes_within(0.99);
}

#[test]
fn no_acceleration_exceeds_its_peak_by_more_than_chords_say() {
    let mut random = Random(22);
    let (mut whole, mut apart) = (Comparison::of("chord of a whole"), Comparison::of("chord beside forces"));
    let mut closed = 0;
    for _ in 0..20_000 {
        let h = random.power_of_ten(-4.0, 1.0);
        let (curve, has_series) = (Curve::any(&mut random, h), random.between(0.0, 1.0) < 0.5);
        let stray = [0.125 * h * h * curve.most_bent()];
        let ends = [curve.value(0.0), curve.value(h)];
        // With a series the curve is the whole, of which the forces are parts at the ends; else it is what is beside them.
        let scale = curve.top.abs() + stray[0];
        let mut force = || random.between(-1.0, 1.0) * scale;
        let (first, last, middle) = (force(), force(), force());
        let range = [first.min(last).min(middle), first.max(last).max(middle)];
        let resisted = if has_series { [ends[0] - first, ends[1] - last] } else { ends };
        let [start, end, first, last, least, most] =
            [resisted[0], resisted[1], first, last, range[0], range[1]].map(|number| [number]);
        // That of the motion alone is overwritten, that of a series lowers what is known.
        let (mut peak, mut upper) = ([0.0], [if has_series { f64::INFINITY } else { f64::NAN }]);
        let at_ends = [&start[..], &end, &first, &last];
        let open = match has_series {
            true => bound_by_deviation(at_ends, &stray, &mut peak, &mut upper),
            false => bound_by_push(at_ends, [&least, &most, &stray], &mut peak, &mut upper),
        };
        assert_eq!(open == 0, upper[0] <= peak[0]);
        let push = |t: f64| match t {
            _ if has_series => 0.0,
            0.0 => first[0],
            t if t == h => last[0],
            _ => middle,
        };
        let reached = largest(times(h).map(|t| curve.value(t) + push(t)));
        let comparison = if has_series { &mut whole } else { &mut apart };
        comparison
            .note(reached - peak[0], (upper[0] - peak[0]).max(0.0), 1e-13 * scale, &|| format!("{curve:?}, {h:e} s"));
        // The ends of a parabola that turns well before or after the step are far apart.
        if has_series && curve.is_parabola() && (curve.turn < -0.01 * h || curve.turn > 1.01 * h) {
            closed += 1;
            assert!(upper[0] <= peak[0], "{curve:?}, {h:e} s");
        }
    }
    assert!(closed > 1000);
    whole.comes_within(0.99);
    apart.comes_within(0.9);
}

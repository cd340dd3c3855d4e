//! One storey that yields while its floor is in contact: by energies, impulses and bilinear oscillators in closed form.

use crate::bilinear::Oscillator;
use crate::common::{Run, assert_close};
use crate::rows::bisect;
use crate::yielding::{OneStorey, assert_like};
use pounding::engine::BuildingId;
use pounding::scene::Scene;

/// The storey beside a wall on the right.
fn at_wall(one: &OneStorey, gap: f64, law: &str) -> Scene {
    let mut scene = one.scene();
    let text = format!(
        "name = \"Wall\"\n[left]\nmass = [1]\nstiffness = [1]\ndamping = {{ ratio = 0 }}\n[[contact]]\nleft_floor = 1\n\
         wall = \"right\"\ngap = {gap:?}\n{law}\n"
    );
    scene.contacts = crate::common::scene(&text).contacts;
    scene
}

/// The wall's energy K d^(n + 1) / (n + 1), its law, and a name.
struct Spring {
    stiffness: f64,
    exponent: f64,
}

impl Spring {
    const ALL: [Spring; 4] = [
        Spring { stiffness: 5e8, exponent: 1.0 },
        Spring { stiffness: 3e10, exponent: 1.5 },
        Spring { stiffness: 5e7, exponent: 1.5 },
        Spring { stiffness: 2e10, exponent: 1.7 },
    ];

    fn law(&self) -> String {
        let Spring { stiffness, exponent } = self;
        match exponent {
            1.0 => format!("law = \"linear\"\nstiffness = {stiffness:?}"),
            _ => format!("law = \"hertz\"\nstiffness = {stiffness:?}\nexponent = {exponent:?}"),
        }
    }

    fn energy(&self, d: f64) -> f64 {
        self.stiffness * d.max(0.0).powf(self.exponent + 1.0) / (self.exponent + 1.0)
    }
}

/// The integral of a smooth function, by Simpson's rule.
fn integral(f: impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
    let count = 20_000;
    let h = (to - from) / f64::from(count);
    let weight = |k: i32| if k == 0 || k == count { 1.0 } else { f64::from(2 + 2 * (k % 2)) };
    (0..=count).map(|k| weight(k) * f(from + f64::from(k) * h)).sum::<f64>() * h / 3.0
}

/// The gap is a little less than the yield drift (it yields in mid-contact, or in the first step after the entry), just that,
/// or more (it enters while yielding). At the turn all energy is in the springs and in V_y times the plastic drift.
#[test]
fn a_storey_that_yields_in_contact_keeps_the_energy() {
    let (w, limit, v0) = (20.0, 5e-3, 0.3);
    for spring in Spring::ALL {
        for share in [0.5, 1e-2, 1e-4, 1e-6, 1e-9, 1e-12, 0.0, -1e-12, -1e-9, -1e-4, -0.5] {
            let what = format!("{} N/m^{}, gap {share} below the limit", spring.stiffness, spring.exponent);
            let one = OneStorey { rate: v0, ..OneStorey::USUAL };
            let gap = limit * (1.0 - share);
            let rest = 0.5 * one.mass * (v0 * v0 - w * w * limit * limit);
            let lacks = |p: f64| rest - one.force * p - spring.energy(limit + p - gap);
            if lacks(0.0) < 1.0 {
                continue;
            }
            let plastic = bisect(lacks, 0.0, 0.1);
            let mut run = Run::new(&at_wall(&one, gap, &spring.law()), None);
            // Of the instant of the yield.
            let speed = |u: f64| f64::sqrt(v0 * v0 - w * w * u * u - 2.0 * spring.energy(u - gap) / one.mass);
            let yielded = match share > 0.0 {
                true => f64::asin(w * gap / v0) / w + integral(|u| 1.0 / speed(u), gap, limit),
                false => f64::asin(w * limit / v0) / w,
            };
            run.to(yielded - 1e-10);
            assert_eq!(run.storey(BuildingId::LEFT, 0).sense, 0, "before {yielded}: {what}");
            run.to(yielded + 1e-10);
            assert_eq!(run.storey(BuildingId::LEFT, 0).sense, 1, "after {yielded}: {what}");
            while run.storey(BuildingId::LEFT, 0).sense != 0 {
                let time = run.state.time();
                run.to(time + 1e-5);
            }
            let shown = run.storey(BuildingId::LEFT, 0);
            assert_close(shown.cumulative, plastic, 1e-11, &what);
            assert_close(shown.plastic, plastic, 1e-11, &what);
            assert_close(shown.ductility, 1.0 + plastic / limit, 1e-11, &what);
            let contact = run.contact(0);
            let deepest: f64 = limit + plastic - gap;
            let force = spring.stiffness * deepest.powf(spring.exponent);
            if deepest > 0.0 {
                assert_close(contact.peak_force, force, 1e-10, &what);
                assert_eq!(contact.impacts, 1, "{what}");
            }
            run.to(5.0);
            assert!(run.energy().residual.abs() < 1e-12, "{what}: {:?}", run.energy());
            assert!(run.storey(BuildingId::LEFT, 0).plastic < plastic, "thrown back: {what}");
        }
    }
}

/// While it yields the storey's force is V_y; the impulse turns it, and from there on it is an oscillator at its limit.
#[test]
fn an_impulse_unloads_a_storey() {
    for (ratio, gap, e) in [(0.0, 7e-3, 0.6), (0.0, 5e-3, 0.3), (0.1, 6e-3, 1.0), (0.02, 8e-3, 0.0), (0.1, 4e-3, 0.8)] {
        let one = OneStorey { ratio, rate: 0.3, ..OneStorey::USUAL };
        let what = format!("r = {ratio}, gap {gap}, e = {e}");
        let start = one.oscillator();
        let law = format!("law = \"stereomechanical\"\nrestitution = {e:?}");
        let mut run = Run::new(&at_wall(&one, gap, &law), None);
        let entry = bisect(|t| gap - start.at(t).drift(), 0.0, 0.04);
        let before = start.at(entry);
        run.to(entry - 1e-10);
        assert_eq!(run.storey(BuildingId::LEFT, 0).sense, i32::from(gap > 5e-3), "{what}");
        let plastic = (gap - start.limit).max(0.0);
        let elastic = gap.min(start.limit);
        let after = Oscillator { rate: -e * before.rate, sense: 0.0, elastic, plastic, ..before };
        let after = Oscillator { cumulative: plastic, furthest: plastic, ..after };
        // Until it meets the wall again.
        let mut time = entry + 1e-10;
        while after.at(time).drift() < gap - 1e-6 || time < entry + 0.01 {
            run.to(time);
            assert_like(&run, &one, &after.at(time), 1e-11, &what);
            assert_eq!(run.contact(0).impacts, 1, "{what}");
            time += 7.3e-3;
            if time > entry + 1.0 {
                break;
            }
        }
        let episode = run.episodes[0];
        assert_close(episode.start, entry, 1e-12, &what);
        assert_close(episode.approach_velocity, before.rate, 1e-11, &what);
        assert!(e > 0.0 || run.storey(BuildingId::LEFT, 0).sense == 0, "{what}");
    }
}

/// Two floors that stay together after an impulse are one mass on both storeys: bilinear, with r = k2 / (k1 + k2). They part
/// where m1 k2 u = m2 k1 (u - p).
#[test]
fn a_storey_yields_while_its_floor_is_held_by_a_rigid_pair() {
    let (m1, k1, force, m2, k2, v0) = (2e4, 8e6, 3e4, 1e4, 6e6, 0.9);
    let scene = crate::common::scene(&format!(
        "name = \"Held\"\n[left]\nmass = [{m1:?}]\nstiffness = [{k1:?}]\ndamping = {{ ratio = 0.0 }}\n\
         yield_force = [{force:?}]\ninitial_velocity = [{v0:?}]\n[right]\nmass = [{m2:?}]\nstiffness = [{k2:?}]\n\
         damping = {{ ratio = 0.0 }}\n[outputs]\nenergy = true\n[[contact]]\nleft_floor = 1\nright_floor = 1\n\
         gap = 0.0\nlaw = \"stereomechanical\"\nrestitution = 0.0\n"
    ));
    let (limit, all) = (force / k1, k1 + k2);
    let start =
        Oscillator { rate: m1 * v0 / (m1 + m2), ..Oscillator::new(f64::sqrt(all / (m1 + m2)), limit, k2 / all) };
    let switches = start.switches(1.0);
    let (turn, plastic) = (switches[1].time, switches[1].plastic);
    assert!(plastic > 3.0 * limit, "{switches:?}");
    let reaction = |now: &Oscillator| (m1 * k2 * now.drift() - m2 * k1 * now.elastic) / (m1 + m2);
    let parts = bisect(|t| reaction(&start.at(turn + t)), 0.0, 0.2) + turn;
    let reversed = switches[2].time;
    assert!(reversed < parts, "it yields the other way too, at {reversed}, before they part at {parts}");
    let mut run = Run::new(&scene, None);
    for k in 1..=300 {
        let time = parts * f64::from(k) / 301.0;
        run.to(time);
        let now = start.at(time);
        let size = limit + plastic;
        for side in [BuildingId::LEFT, BuildingId::RIGHT] {
            let error = (run.displacement(side, 0) - now.drift()).abs() / size;
            assert!(error < 1e-12, "{side:?} at {time} s: off by {error:.1e}");
        }
        let shown = run.storey(BuildingId::LEFT, 0);
        assert!((shown.plastic - now.plastic).abs() < 1e-12 * size, "{shown:?} not {now:?}");
        assert!((shown.cumulative - now.cumulative).abs() < 1e-12 * size, "{shown:?} not {now:?}");
        assert_eq!(shown.sense, now.sense as i32, "at {time} s");
        let force = run.contact(0).force;
        assert!((force - reaction(&now)).abs() < 1e-11 * k2 * size, "{force} not {} at {time} s", reaction(&now));
        assert!(run.energy().residual.abs() < 1e-12, "{:?}", run.energy());
    }
    let is_held = |time: f64| {
        let mut run = Run::new(&scene, None);
        run.to(time).contact(0).active
    };
    assert!(is_held(parts - 1e-9) && !is_held(parts + 1e-9), "they part at {parts}");
}

/// Pressed against the wall with twice the yield force it comes to rest there at its limit; let go, it swings from there.
#[test]
fn a_storey_at_its_limit_is_held_against_a_wall() {
    for (ratio, e) in [(0.0, 0.0), (0.0, 0.5), (0.05, 0.1), (0.05, 0.9)] {
        let one = OneStorey { ratio, ..OneStorey::USUAL };
        let (limit, gap) = (5e-3, 12e-3);
        let what = format!("r = {ratio}, e = {e}");
        let law = format!("law = \"stereomechanical\"\nrestitution = {e:?}");
        let mut run = Run::new(&at_wall(&one, gap, &law), None);
        run.state.set_floor_force(BuildingId::LEFT, 0, 2.0 * one.force);
        // Not longer: the force works on the rounding of a displacement that is held, once a step.
        run.to(4.0);
        let (shown, contact) = (run.storey(BuildingId::LEFT, 0), run.contact(0));
        assert!(contact.active && (run.displacement(BuildingId::LEFT, 0) - gap).abs() < 1e-15, "{what}: {contact:?}");
        assert_close(shown.plastic, gap - limit, 1e-12, &what);
        assert_eq!(shown.sense, 0, "{what}: it does not move");
        let shear = one.force + ratio * one.stiffness * (gap - limit);
        assert_close(shown.shear, shear, 1e-12, &what);
        assert_close(contact.force, 2.0 * one.force - shear, 1e-11, &what);
        assert!(run.energy().residual.abs() < 1e-12, "{what}: {:?}", run.energy());
        run.state.set_floor_force(BuildingId::LEFT, 0, 0.0);
        let start =
            Oscillator { elastic: limit, plastic: gap - limit, furthest: gap - limit, time: 4.0, ..one.oscillator() };
        let earlier = shown.cumulative;
        let start = Oscillator { cumulative: earlier, ..start };
        for time in [4.01, 4.1, 4.2, 4.3] {
            run.to(time);
            assert_like(&run, &one, &start.at(time), 1e-11, &what);
        }
    }
}

//! States of storeys that yield from the first instant on: saved there, they go on to the same bits. At other instants:
//! `invariants/`.

use crate::common::{Run, record, scene};

/// All that is shown, and the counts of what has been done.
fn seen(run: &Run) -> (Vec<u64>, u64) {
    let mut bits = run.bits();
    let energy = run.energy();
    let terms = [energy.input, energy.viscous, energy.impact, energy.strain, energy.hysteretic, energy.residual];
    bits.extend(terms.map(f64::to_bits));
    (bits, run.state.counters().events)
}

/// Storeys beyond their yield drift, held there with no rate and let go: some yield at once, others turn. A state is one of
/// its model at any time in the first steps, and goes on to the same bits.
#[test]
fn storeys_let_go_beyond_their_yield_drift_can_be_saved_at_once() {
    let mut at_once = 0;
    for k in 0..40 {
        let pushed = |floor: u32| 0.03 * (f64::from(7 * k + 3 * floor) * 1.7).sin();
        let mut scene = scene(&format!(
            "name = \"Held\"\n[left]\nmass = [1.3e4, 8.5e3, 1.3e4]\nstiffness = [1.3e7, 1e7, 1.1e7]\n\
             yield_force = [9e4, 8.1e4, inf]\ndamping = {{ ratio = 0.0 }}\ninitial_displacement = {:?}\n\
             [outputs]\nenergy = true\n",
            [1, 2, 3].map(pushed)
        ));
        scene.ground.record = Some("quiet.csv".into());
        let record = record(0.05, &[0.0, 0.0]);
        let expected = seen(Run::new(&scene, Some(&record)).to(0.05));
        let mut run = Run::new(&scene, Some(&record));
        for n in 0..20 {
            run.to(0.0002 * f64::from(n));
            at_once += i32::from(n == 1 && run.storeys().iter().any(|storey| storey.sense != 0));
            let saved = run.save();
            run.model.check_saved(&saved).unwrap_or_else(|error| panic!("scene {k}, row {n}: {error}"));
            let mut other = Run::new(&scene, Some(&record));
            other.model.restore(&saved, &mut other.state);
            assert!(seen(other.to(0.05)) == expected, "scene {k}, row {n}");
        }
    }
    assert!(at_once > 5, "a storey yields from the first instant on in {at_once} of 40 scenes");
}
